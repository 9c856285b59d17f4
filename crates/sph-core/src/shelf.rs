//! Buffers that tasks borrow and give back, so that a step asks for no memory.

use std::any::Any;
use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Buffers of any types: of each as many as tasks were ever at work side by side.
///
/// Which one a task gets depends on the threads, so that nobody reads what the last one left in it.
#[derive(Debug, Default)]
pub struct Shelf(Mutex<Vec<Box<dyn Any + Send>>>);

impl Shelf {
    fn all(&self) -> MutexGuard<'_, Vec<Box<dyn Any + Send>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A buffer that somebody has given back, or a new one.
    pub fn lend<T: Default + Send + 'static>(&self) -> Lent<'_, T> {
        let mut all = self.all();
        let place = all.iter().position(|item| item.is::<T>());
        let found = place.map(|place| all.swap_remove(place));
        let item = found.and_then(|item| item.downcast().ok());
        Lent {
            item: Some(item.unwrap_or_default()),
            shelf: self,
        }
    }
}

/// A buffer that goes back when it is dropped.
pub struct Lent<'a, T: Send + 'static> {
    /// There until then.
    item: Option<Box<T>>,
    shelf: &'a Shelf,
}

impl<T: Send + 'static> Deref for Lent<'_, T> {
    type Target = T;
    #[inline(always)]
    fn deref(&self) -> &T {
        match &self.item {
            Some(item) => item,
            None => unreachable!("it goes back when it is dropped"),
        }
    }
}

impl<T: Send + 'static> DerefMut for Lent<'_, T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut T {
        match &mut self.item {
            Some(item) => item,
            None => unreachable!("it goes back when it is dropped"),
        }
    }
}

impl<T: Send + 'static> Drop for Lent<'_, T> {
    fn drop(&mut self) {
        if let Some(item) = self.item.take() {
            self.shelf.all().push(item);
        }
    }
}

//! Buffers that tasks borrow and give back, so that a step allocates no memory.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Buffers of one kind: as many as tasks were ever at work side by side.
///
/// The one that a task gets depends on the threads, so that no task may read what the last one left in it.
#[derive(Debug)]
pub struct Pool<T>(Mutex<Vec<Box<T>>>);

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Pool(Mutex::default())
    }
}

impl<T> Pool<T> {
    fn all(&self) -> MutexGuard<'_, Vec<Box<T>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Default> Pool<T> {
    /// A buffer that was given back, or a new one.
    pub fn acquire(&self) -> PoolGuard<'_, T> {
        let found = self.all().pop();
        PoolGuard {
            item: Some(found.unwrap_or_default()),
            pool: self,
        }
    }
}

/// A buffer that goes back when it is dropped.
pub struct PoolGuard<'a, T> {
    item: Option<Box<T>>,
    pool: &'a Pool<T>,
}

impl<T> Deref for PoolGuard<'_, T> {
    type Target = T;
    #[inline(always)]
    fn deref(&self) -> &T {
        self.item.as_deref().expect("given back when dropped")
    }
}

impl<T> DerefMut for PoolGuard<'_, T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut T {
        self.item.as_deref_mut().expect("given back when dropped")
    }
}

impl<T> Drop for PoolGuard<'_, T> {
    fn drop(&mut self) {
        if let Some(item) = self.item.take() {
            self.pool.all().push(item);
        }
    }
}

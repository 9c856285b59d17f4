//! Loops on all threads with the feature `parallel`, on one without it.

#[cfg(not(feature = "parallel"))]
pub(crate) use one_thread::*;
#[cfg(feature = "parallel")]
pub(crate) use rayon::prelude::*;

/// The names of rayon.
#[cfg(not(feature = "parallel"))]
mod one_thread {
    pub(crate) trait IntoLoop: IntoIterator + Sized {
        fn into_par_iter(self) -> Self::IntoIter {
            self.into_iter()
        }
    }

    impl<T: IntoIterator> IntoLoop for T {}

    pub(crate) trait LoopOverSlice<T> {
        fn par_iter(&self) -> std::slice::Iter<'_, T>;
        fn par_sort_unstable(&mut self)
        where
            T: Ord;
        fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
    }

    impl<T> LoopOverSlice<T> for [T] {
        fn par_iter(&self) -> std::slice::Iter<'_, T> {
            self.iter()
        }
        fn par_sort_unstable(&mut self)
        where
            T: Ord,
        {
            self.sort_unstable();
        }
        fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K) {
            self.sort_unstable_by_key(key);
        }
    }
}

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

    pub(crate) trait SortedSlice {
        fn par_sort_unstable(&mut self);
    }

    impl<T: Ord> SortedSlice for [T] {
        fn par_sort_unstable(&mut self) {
            self.sort_unstable();
        }
    }
}

//! Results of a run at its end.

pub(crate) mod advice;
pub(crate) mod balance;
pub(crate) mod reference_plots;
pub(crate) mod references;
pub(crate) mod report;
pub(crate) mod scene_picture;
pub(crate) mod summary;

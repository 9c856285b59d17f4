//! Particles as a model that is run: steps, rows, fields, checkpoints.

pub(crate) mod checkpoint;
pub(crate) mod counters;
pub(crate) mod course;
pub(crate) mod model;
pub(crate) mod next_step;
pub(crate) mod output;
pub(crate) mod pieces;
pub(crate) mod ranked;
pub(crate) mod run;
pub(crate) mod series;
pub(crate) mod stepper;
pub(crate) mod trial;
pub(crate) mod watches;

//! What happens in a step: evaluation, kicks, drifts, and going back.

pub(crate) mod clocks;
pub(crate) mod dilatation;
pub(crate) mod elastic;
pub(crate) mod flow;
pub(crate) mod guard;
pub(crate) mod held_back;
pub(crate) mod implicit;
pub(crate) mod kept_rates;
pub(crate) mod outlets;
pub(crate) mod seepage;
pub(crate) mod snapshot;
pub(crate) mod sorting;
pub(crate) mod stages;
pub(crate) mod sub_steps;

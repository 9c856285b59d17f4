//! The share of a flow with which a process begins.

use std::sync::Arc;

use sph_boundary::Wall;
use sph_core::StepError;
use sph_neighbours::WallSet;
use sph_neighbours::decomposition::{PartError, Transport};
use sph_solver::{Flow, SolverError};

/// The part of a flow that a process begins with.
pub enum Share<const D: usize> {
    /// All of it.
    Whole,
    /// The part of a rank: lists are built and forces found for this alone.
    Part(Arc<dyn Transport>),
    /// Columns, plugins and walls; places, and no state: for one that comes from elsewhere.
    Blank,
    /// Columns and plugins alone, without a particle, among walls that stand already: for a gathered state.
    Columns(Option<Box<(Box<dyn Wall<D>>, WallSet<D>)>>),
}

/// Refuses scenes that cannot be divided between ranks.
pub fn refuse_the_indivisible<const D: usize>(
    flow: &Flow<D>,
    ranks: usize,
) -> Result<(), SolverError> {
    if let Some(why) = flow.indivisible() {
        return Err(SolverError::at("", why));
    }
    let particles = flow.world.free.len();
    let why = format!("{ranks} ranks for {particles} particles: some would own nothing");
    match ranks > particles {
        true => Err(SolverError::at("", why)),
        false => Ok(()),
    }
}

/// Confirms that all ranks are ready, which all must call.
pub fn all_ready<T, E: From<StepError>>(
    ranks: &dyn Transport,
    ready: Result<T, E>,
) -> Result<T, E> {
    let mut failed = [f64::from(u8::from(ready.is_err()))];
    let told = ranks.largest(&mut failed).map_err(PartError::from);
    let ready = ready?;
    told.map_err(StepError::from)?;
    match failed[0] > 0.0 {
        true => Err(StepError::from(PartError::Elsewhere).into()),
        false => Ok(ready),
    }
}

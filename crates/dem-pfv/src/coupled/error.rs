//! Errors of the coupling, with their reasons.

use thiserror::Error;

use crate::OutOfRange;
use crate::coupled::StepLimit;
use crate::flow::FlowError;
use crate::grains::GrainError;
use crate::triangulation::TriangulationError;

/// Grains, fluids, conditions or steps with which nothing can be computed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CoupledError {
    /// The grains, their contacts or walls.
    #[error(transparent)]
    Grains(#[from] GrainError),
    /// The flow; spheres are numbered as the grains.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// The mesh of the pores; spheres are numbered as the grains.
    #[error(transparent)]
    Mesh(#[from] TriangulationError),
    /// A number of meshes, where the flow sees plane walls only.
    #[error("there are {0} meshes of triangles; fluid would flow through them, use plane walls")]
    Meshes(usize),
    /// An axis that is periodic, where the flow has no periodic rooms.
    #[error("axis {0} is periodic; the flow needs a box of six walls")]
    Periodic(usize),
    /// Other numbers of conditions and of walls.
    #[error("there are conditions for {0} walls and {1} walls")]
    Sides(usize, usize),
    /// A number out of range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// A wall whose condition means nothing.
    #[error("the condition at wall {0} {1}")]
    BadCondition(usize, &'static str),
    /// A step (s) for which the scheme is not stable; nothing was moved.
    #[error(
        "the step {0} s is above the limit {limit} s, which grain {grain} sets \
         (contacts alone {elastic} s, drag alone {viscous} s)",
        limit = .1.step, grain = .1.grain, elastic = .1.elastic, viscous = .1.viscous
    )]
    StepTooLarge(f64, StepLimit),
    /// A saved state whose parts do not fit together.
    #[error("the saved state cannot be resumed: {0}")]
    BadState(&'static str),
}

impl CoupledError {
    /// The first grain that it names.
    pub fn grain(&self) -> Option<usize> {
        match self {
            Self::Grains(error) => error.grains().first().copied(),
            Self::StepTooLarge(_, limit) => Some(limit.grain),
            Self::Flow(FlowError::Overlap(grain, ..) | FlowError::InWall(grain, ..)) => {
                Some(*grain)
            }
            _ => None,
        }
    }
}

//! Errors of the coupling, with their reasons.

use thiserror::Error;

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
    /// The flow sees plane walls only.
    #[error(
        "there are {meshes} meshes of triangles; fluid would flow through them, use plane walls"
    )]
    Meshes {
        /// Number of meshes.
        meshes: usize,
    },
    /// The flow has no periodic rooms.
    #[error("axis {axis} is periodic; the flow needs a box of six walls")]
    Periodic {
        /// 0, 1 or 2.
        axis: usize,
    },
    /// One side per wall is needed.
    #[error("there are conditions for {sides} walls and {walls} walls")]
    Sides {
        /// Given.
        sides: usize,
        /// Needed.
        walls: usize,
    },
    /// A number out of range.
    #[error("{what} is {value}; it must be {valid}")]
    BadNumber {
        /// Name of the quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The allowed values.
        valid: &'static str,
    },
    /// A condition at a wall that means nothing.
    #[error("the condition at wall {wall} {problem}")]
    BadCondition {
        /// The wall.
        wall: usize,
        /// The fault.
        problem: String,
    },
    /// A step for which the scheme is not stable; nothing was moved.
    #[error(
        "the step {step} s is above the limit {limit} s, which grain {grain} sets \
         (contacts alone {elastic} s, drag alone {viscous} s)"
    )]
    StepTooLarge {
        /// Asked for, s.
        step: f64,
        /// Largest one, s.
        limit: f64,
        /// 2/ω of the contacts, s.
        elastic: f64,
        /// 2/λ of the drag, s.
        viscous: f64,
        /// The grain that moves most in the mode of strongest drag.
        grain: usize,
    },
    /// A saved state whose parts do not fit together.
    #[error("the saved state cannot be resumed: {problem}")]
    BadState {
        /// The fault.
        problem: String,
    },
}

/// Refuses a number unless it is `fine` and finite.
pub(crate) fn number(
    what: &'static str,
    value: f64,
    valid: &'static str,
    fine: bool,
) -> Result<(), CoupledError> {
    match fine && value.is_finite() {
        true => Ok(()),
        false => Err(CoupledError::BadNumber { what, value, valid }),
    }
}

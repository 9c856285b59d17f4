//! Errors of the pore flow, with their reasons.

use sparse::SparseError;
use sph_core::RegistryError;
use thiserror::Error;

use crate::OutOfRange;

/// Spheres, walls or conditions through which no flow can be computed. Lengths are in m.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FlowError {
    /// Another number of walls than six.
    #[error("pore flow needs the six walls of a box; the triangulation has {0} walls")]
    NoBox(usize),
    /// Two walls that are neither parallel nor at right angles.
    #[error("walls {0} and {1} meet at an angle that is not a right one")]
    ObliqueWalls(usize, usize),
    /// A list that has not the length it should have.
    #[error("there are {given} {what}; {needed} are needed")]
    Length {
        /// Name of the list.
        what: &'static str,
        /// Given.
        given: usize,
        /// Needed.
        needed: usize,
    },
    /// Two spheres that overlap deeply: the depth, and the allowed one in terms of the smaller radius.
    #[error("spheres {0} and {1} overlap by {2} m, more than {3} of the smaller radius")]
    Overlap(usize, usize, f64, f64),
    /// A sphere that reaches far into a wall: the depth, and the allowed one in terms of the radius.
    #[error("sphere {0} reaches {2} m into wall {1}, more than {3} of its radius")]
    InWall(usize, usize, f64, f64),
    /// A number that is out of range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// The cells beside a throat whose conductance is negative or not a number.
    #[error("the throat between cells {0:?} has the conductance {1} m⁴")]
    BadConductance([usize; 2], f64),
    /// One of the cells without any way to a pressure that is given.
    #[error(
        "no pressure is given in the pores around cell {0}: all walls that they reach are closed, \
         and pressures would be known but for a constant; give one pressure, or a compressible fluid"
    )]
    NoPressure(usize),
    /// A cell in which a pressure is given now and was not when the system was made, or the other way round.
    #[error("cell {0} changed between a given and an unknown pressure; make a new system")]
    ConditionsChanged(usize),
    /// The system of the pressures could not be solved.
    #[error("pressures: {0}")]
    Unsolved(#[from] SparseError),
    /// A conductance that cannot be found by name, or built.
    #[error(transparent)]
    Plugin(#[from] RegistryError),
}

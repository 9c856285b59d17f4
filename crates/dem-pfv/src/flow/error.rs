//! Errors of the pore flow, with their reasons.

use sparse::SparseError;
use sph_core::RegistryError;
use thiserror::Error;

/// Spheres, walls or conditions through which no flow can be computed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FlowError {
    /// There are no walls.
    #[error("pore flow needs the six walls of a box; the triangulation has {walls} walls")]
    NoBox {
        /// Given.
        walls: usize,
    },
    /// Two walls are neither parallel nor at right angles.
    #[error("walls {first} and {second} meet at an angle that is not a right one")]
    ObliqueWalls {
        /// A wall.
        first: usize,
        /// Another.
        second: usize,
    },
    /// A list has not the length it should have.
    #[error("there are {given} {what}; {needed} are needed")]
    Length {
        /// Name of the list.
        what: &'static str,
        /// Given.
        given: usize,
        /// Needed.
        needed: usize,
    },
    /// Two spheres overlap deeply.
    #[error(
        "spheres {first} and {second} overlap by {overlap} m, more than {deepest} of the smaller radius"
    )]
    Overlap {
        /// A sphere.
        first: usize,
        /// Another.
        second: usize,
        /// Depth of the overlap, m.
        overlap: f64,
        /// Allowed, in terms of the smaller radius.
        deepest: f64,
    },
    /// A sphere reaches far into a wall.
    #[error(
        "sphere {sphere} reaches {overlap} m into wall {wall}, more than {deepest} of its radius"
    )]
    InWall {
        /// The sphere.
        sphere: usize,
        /// The wall.
        wall: usize,
        /// Depth, m.
        overlap: f64,
        /// Allowed, in terms of the radius.
        deepest: f64,
    },
    /// A number that must be positive is not.
    #[error("{what} is {value}; it must be positive and finite")]
    NotPositive {
        /// Name of the quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A conductance is negative or not a number.
    #[error("the throat between cells {cells:?} has the conductance {value} m⁴")]
    BadConductance {
        /// The cells on both sides.
        cells: [usize; 2],
        /// g µ.
        value: f64,
    },
    /// Cells without any way to a pressure that is given.
    #[error(
        "no pressure is given in the pores around cell {cell}: all walls that they reach are closed, \
         and pressures would be known but for a constant; give one pressure, or a compressible fluid"
    )]
    NoPressure {
        /// One of them.
        cell: usize,
    },
    /// Pressures are given in other cells than when the system was made.
    #[error("cell {cell} changed between a given and an unknown pressure; make a new system")]
    ConditionsChanged {
        /// One of them.
        cell: usize,
    },
    /// The system of the pressures could not be solved.
    #[error("pressures: {0}")]
    Unsolved(#[from] SparseError),
    /// A conductance that cannot be found by name, or built.
    #[error(transparent)]
    Plugin(#[from] RegistryError),
    /// A parameter of a conductance out of range.
    #[error("the {what} of the conductance {name:?} is {value}; it must be {valid}")]
    BadParameter {
        /// The conductance.
        name: &'static str,
        /// The parameter.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid range.
        valid: &'static str,
    },
}

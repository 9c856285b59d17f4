//! Errors of grains, with their reasons.

use sph_core::RegistryError;
use thiserror::Error;

use crate::OutOfRange;
use crate::grains::{Partner, Unrest};

/// Grains, walls, laws or steps with which nothing can be computed. Lengths are in m, times in s, stresses in Pa.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GrainError {
    /// Nothing to move.
    #[error("there are no grains; at least one is needed")]
    NoGrains,
    /// More grains than the lists can number, and the most.
    #[error("there are {0} grains; at most {1} can be numbered")]
    TooMany(usize, usize),
    /// A grain of which a quantity that must be positive is not.
    #[error("grain {0} has the {1} {2}; it must be positive and finite")]
    NotPositive(usize, &'static str, f64),
    /// A grain of which a place, a velocity or a force is infinite or not a number.
    #[error("grain {0} has the {1} {2:?}; it must be finite")]
    NotFinite(usize, &'static str, [f64; 3]),
    /// Two grains that overlap deeply, and the depth.
    #[error("grains {0} and {1} overlap by {2:.3e} m, more than a tenth of the smaller radius")]
    Overlap(usize, usize, f64),
    /// A grain in a wall or beyond it.
    #[error(
        "grain {grain} reaches {overlap:.3e} m into wall {wall}, more than a tenth of its radius; \
         its centre is {distance:.3e} m from the wall"
    )]
    InWall {
        /// The grain.
        grain: usize,
        /// The wall.
        wall: usize,
        /// Depth, m.
        overlap: f64,
        /// Signed distance of its centre, negative beyond the wall, m.
        distance: f64,
    },
    /// A grain in a triangle of a mesh.
    #[error(
        "grain {grain} reaches {overlap:.3e} m into triangle {triangle} of mesh {mesh}, \
         more than a tenth of its radius"
    )]
    InMesh {
        /// The grain.
        grain: usize,
        /// The mesh.
        mesh: usize,
        /// The triangle.
        triangle: usize,
        /// Depth, m.
        overlap: f64,
    },
    /// A grain that overlaps another body too deep for a step.
    #[error(
        "grain {grain} at ({:.4e}, {:.4e}, {:.4e}) m overlaps {body} by {overlap:.3e} m, {share:.2} of its radius; \
         contacts hold up to {most} of the smaller radius: give the contact law a larger `modulus`, or take shorter steps",
        at[0], at[1], at[2]
    )]
    TooDeep {
        /// The grain.
        grain: usize,
        /// Its centre, m.
        at: [f64; 3],
        /// The body that it overlaps.
        body: Partner,
        /// Depth, m.
        overlap: f64,
        /// Depth over the radius of the grain.
        share: f64,
        /// Depth over the smaller radius that a step may have.
        most: f64,
    },
    /// A grain outside the periodic box: its number, the axis, its coordinate, the ends of the period.
    #[error("grain {0} is at {2} m on axis {1}, outside the period from {from} to {to} m", from = .3[0], to = .3[1])]
    OutsidePeriod(usize, usize, f64, [f64; 2]),
    /// An axis whose period is so short that a grain could touch another one from two sides, and the least one.
    #[error("the period {1} m of axis {0} is too short; it must exceed {2} m")]
    ShortPeriod(usize, f64, f64),
    /// A wall without a direction or a place, or that is turned towards a periodic axis.
    #[error("wall {0} {1}")]
    BadWall(usize, String),
    /// A mesh with a triangle that is none.
    #[error("triangle {1} of mesh {0} {2}")]
    BadMesh(usize, usize, String),
    /// A contact law that cannot be found by name, or built.
    #[error(transparent)]
    Plugin(#[from] RegistryError),
    /// A wall, a mesh or grains that name a law by a number that none has, and how many there are.
    #[error("{0} {1} follows contact law {2}, but there are {3}")]
    NoLaw(&'static str, usize, usize, usize),
    /// A law whose memory exceeds the room of a contact.
    #[error("contact law {0} remembers {1} numbers per contact; there is room for {2}")]
    Memory(usize, usize, usize),
    /// A parameter of a law or a number of the whole system that is out of range.
    #[error(transparent)]
    Number(#[from] OutOfRange),
    /// A step that the stiffest contacts do not bear.
    #[error("the step {step} s is above the critical one, {critical} s, which grain {grain} sets")]
    StepTooLarge {
        /// Given, s.
        step: f64,
        /// Allowed, s.
        critical: f64,
        /// The grain with the largest ratio of stiffness to mass.
        grain: usize,
    },
    /// A wall that is pressed and whose area is not known.
    #[error(
        "the area of wall {0} is not known: give it, or close the box with walls along the axes"
    )]
    NoArea(usize),
    /// A saved state that does not fit together.
    #[error("the saved state cannot be resumed: {0}")]
    BadState(&'static str),
    /// A grain of a cloud without a place: its number, its radius, the tries.
    #[error("no place is left for grain {0} of radius {1} m after {2} tries")]
    NoRoom(usize, f64, usize),
    /// A growth that did not end: its steps, the unbalanced force ratio, the mean stress.
    #[error("growth did not end within {0} steps: unbalanced force ratio {1}, mean stress {2} Pa")]
    NotReached(u64, f64, f64),
    /// Grains that did not come to rest within so many steps.
    #[error("the grains are not at rest after {0} steps: {1}")]
    NotSettled(u64, Unrest),
}

impl GrainError {
    /// The grains that it names.
    pub fn grains(&self) -> Vec<usize> {
        match *self {
            Self::Overlap(first, second, _) => vec![first, second],
            Self::NotPositive(grain, ..)
            | Self::NotFinite(grain, ..)
            | Self::InWall { grain, .. }
            | Self::InMesh { grain, .. }
            | Self::TooDeep { grain, .. }
            | Self::OutsidePeriod(grain, ..)
            | Self::StepTooLarge { grain, .. } => vec![grain],
            _ => Vec::new(),
        }
    }
}

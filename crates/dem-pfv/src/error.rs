//! Errors, with their reasons.

use std::fmt::{self, Display};

use serde::{Deserialize, Serialize};
use sparse::SparseError;
use sph_core::RegistryError;
use thiserror::Error;

/// A number out of its range: the quantity, its value and the valid ones.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{0}")]
pub struct OutOfRange(String);

/// Checks a number; `what` is the quantity with its verb, "the step is".
///
/// # Errors
/// Unless it is `fine` and finite.
pub fn require(what: impl Display, value: f64, valid: &str, fine: bool) -> Result<(), OutOfRange> {
    match fine && value.is_finite() {
        true => Ok(()),
        false => Err(OutOfRange(format!("{what} {value}; it must be {valid}"))),
    }
}

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
    /// A list that has not the length it should have: its name, its length, the length that it needs.
    #[error("there are {1} {0}; {2} are needed")]
    Length(&'static str, usize, usize),
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
}

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
    /// A grain in a wall or beyond it: its number and the wall's, the depth, and the signed distance of its centre, negative
    /// beyond the wall.
    #[error(
        "grain {0} reaches {2:.3e} m into wall {1}, more than a tenth of its radius; \
         its centre is {3:.3e} m from the wall"
    )]
    InWall(usize, usize, f64, f64),
    /// A grain in a triangle of a mesh, and the depth.
    #[error("grain {0} reaches {2:.3e} m into {1}, more than a tenth of its radius")]
    InMesh(usize, Partner, f64),
    /// A grain that overlaps another body too deep for a step: its number, its centre, the other body, the depth, and
    /// the depth over its radius.
    #[error(
        "grain {0} at ({x:.4e}, {y:.4e}, {z:.4e}) m overlaps {2} by {3:.3e} m, {4:.2} of its radius; \
         contacts hold up to {most} of the smaller radius: give the contact law a larger `modulus`, or take shorter steps",
        x = .1[0], y = .1[1], z = .1[2], most = DEEPEST
    )]
    TooDeep(usize, [f64; 3], Partner, f64, f64),
    /// A grain outside the periodic box: its number, the axis, its coordinate, the ends of the period.
    #[error("grain {0} is at {2} m on axis {1}, outside the period from {from} to {to} m", from = .3[0], to = .3[1])]
    OutsidePeriod(usize, usize, f64, [f64; 2]),
    /// An axis whose period is so short that a grain could touch another one from two sides, and the least one.
    #[error("the period {1} m of axis {0} is too short; it must exceed {2} m")]
    ShortPeriod(usize, f64, f64),
    /// A wall without a direction or a place, or that is turned towards a periodic axis.
    #[error("wall {0} {1}")]
    BadWall(usize, String),
    /// A mesh or a triangle out of order: the numbers of both, and the reason.
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
    /// A step that the stiffest contacts do not bear, the critical one, and the grain with the largest ratio of stiffness to
    /// mass.
    #[error("the step {0} s is above the critical one, {1} s, which grain {2} sets")]
    StepTooLarge(f64, f64, usize),
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
            | Self::InWall(grain, ..)
            | Self::InMesh(grain, ..)
            | Self::TooDeep(grain, ..)
            | Self::OutsidePeriod(grain, ..)
            | Self::StepTooLarge(.., grain) => vec![grain],
            _ => Vec::new(),
        }
    }
}

/// Causes of unrest of grains.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Unrest {
    /// The mean resultant force on a grain, over the mean contact force: [`unbalanced_force`](crate::grains::GrainSystem::unbalanced_force).
    #[error("the unbalanced force ratio is {0:.3e}")]
    Unbalanced(f64),
    /// A grain whose weight nothing balances: it falls, or something hits it.
    #[error("nothing carries grain {0}")]
    NotCarried(usize),
    /// A piston whose load nothing balances.
    #[error("no grain carries the piston, wall {0}")]
    Piston(usize),
    /// The mean speed of the grains, that of their surfaces by spin added, m/s.
    #[error("the grains move with {0:.3e} m/s in the mean")]
    Moving(f64),
}

/// Spheres or walls that have no regular triangulation, by their numbers. Lengths are in m.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// A sphere whose centre or radius is infinite or not a number, or whose radius is negative.
    #[error(
        "sphere {0} has the centre {1:?} m and the radius {2} m; \
         numbers must be finite and radii not negative"
    )]
    BadSphere(usize, [f64; 3], f64),
    /// A wall whose inward normal has no direction, or whose offset is no place.
    #[error("wall {0} has the normal {1:?} and the offset {2} m; the normal must be of length 1")]
    BadWall(usize, [f64; 3], f64),
    /// Fewer spheres than are needed: one between walls, four without.
    #[error("there are {0} spheres; at least {1} are needed")]
    TooFew(usize, usize),
    /// Without walls, all centres lie in one plane.
    #[error("all centres lie in one plane; without walls such spheres have no triangulation")]
    Flat,
    /// Two spheres with the same centre, the lower number first.
    #[error("spheres {0} and {1} have the same centre {2:?} m")]
    Duplicate(usize, usize, [f64; 3]),
    /// A sphere that is nowhere the one of least power: others overlap it deeply.
    #[error("sphere {0} is hidden by others: its centre lies inside one of them, or nearly so")]
    Hidden(usize),
    /// A sphere whose centre is on a wall or behind it, and its signed distance.
    #[error("the centre of sphere {0} is {2} m from wall {1}; it must lie inside")]
    Outside(usize, usize, f64),
    /// Two walls that have so many corners in common: they leave a way out, or no room at all.
    #[error("the walls do not close a room: walls {0} and {1} meet in {2} corners instead of two")]
    Open(usize, usize, usize),
    /// A wall that touches the room nowhere.
    #[error("wall {0} has no part in the room of the others; leave it out")]
    IdleWall(usize),
    /// Four walls that meet in a point, as at the tip of a pyramid.
    #[error("walls {0:?} meet in one point; at most three may")]
    FourWallsMeet([usize; 4]),
}

/// Valid values of numbers.
pub(crate) const POSITIVE: &str = "positive and finite";
pub(crate) const AT_LEAST_0: &str = "at least 0";
pub(crate) const BELOW_1: &str = "at least 0 and below 1";

/// The second body of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// A grain.
    Grain(usize),
    /// A wall.
    Wall(usize),
    /// A triangle of a mesh: the mesh's number and its own.
    Triangle(usize, usize),
}

impl Display for Partner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Grain(grain) => write!(f, "grain {grain}"),
            Self::Wall(wall) => write!(f, "wall {wall}"),
            Self::Triangle(mesh, triangle) => write!(f, "triangle {triangle} of mesh {mesh}"),
        }
    }
}

/// Limits of a step.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct StepLimit {
    /// Largest stable step Δt, s.
    pub step: f64,
    /// 2/ω, the contacts alone, s.
    pub elastic: f64,
    /// 2/λ, the drag alone, s.
    pub viscous: f64,
    /// The grain that moves most in the mode of strongest drag.
    pub grain: usize,
}

/// Share of the smaller radius that an overlap may have in a step. Contact laws hold for overlaps that are small
/// beside the radius: a floor cuts 4 % of the volume off a sphere that is sunk by a quarter of its radius.
pub(crate) const DEEPEST: f64 = 0.25;

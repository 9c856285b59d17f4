//! Errors of grains, with their reasons.

use sph_core::RegistryError;
use thiserror::Error;

/// Grains, walls, laws or steps with which nothing can be computed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GrainError {
    /// Nothing to move.
    #[error("there are no grains; at least one is needed")]
    NoGrains,
    /// More than the lists can number.
    #[error("there are {grains} grains; at most {most} can be numbered")]
    TooMany {
        /// Given.
        grains: usize,
        /// Allowed.
        most: usize,
    },
    /// A quantity of a grain that must be positive is not.
    #[error("grain {grain} has the {what} {value}; it must be positive and finite")]
    NotPositive {
        /// The grain.
        grain: usize,
        /// Name of the quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A place, a velocity or a force of a grain is infinite or not a number.
    #[error("grain {grain} has the {what} {value:?}; it must be finite")]
    NotFinite {
        /// The grain.
        grain: usize,
        /// Name of the quantity.
        what: &'static str,
        /// Its value.
        value: [f64; 3],
    },
    /// Two grains overlap deeply.
    #[error(
        "grains {first} and {second} overlap by {overlap:.3e} m, more than a tenth of the smaller radius"
    )]
    Overlap {
        /// A grain.
        first: usize,
        /// Another.
        second: usize,
        /// Depth, m.
        overlap: f64,
    },
    /// A grain is in a wall or beyond it.
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
    /// A grain is in a triangle of a mesh.
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
    /// A grain overlaps another body too deep for a step.
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
        /// The grain, wall or triangle that it overlaps.
        body: String,
        /// The number of that wall, if it is one.
        wall: Option<usize>,
        /// Depth, m.
        overlap: f64,
        /// Depth over the radius of the grain.
        share: f64,
        /// Depth over the smaller radius that a step may have.
        most: f64,
    },
    /// A grain is not in the periodic box.
    #[error(
        "grain {grain} is at {value} m on axis {axis}, outside the period from {from} to {to} m"
    )]
    OutsidePeriod {
        /// The grain.
        grain: usize,
        /// 0, 1 or 2.
        axis: usize,
        /// Its coordinate, m.
        value: f64,
        /// Lower end, m.
        from: f64,
        /// Upper end, m.
        to: f64,
    },
    /// A period in which a grain could touch another one from two sides.
    #[error("the period {length} m of axis {axis} is too short; it must exceed {least} m")]
    ShortPeriod {
        /// 0, 1 or 2.
        axis: usize,
        /// Given, m.
        length: f64,
        /// Needed, m.
        least: f64,
    },
    /// A wall without a direction or a place, or that is turned towards a periodic axis.
    #[error("wall {wall} {problem}")]
    BadWall {
        /// Its number.
        wall: usize,
        /// The fault.
        problem: String,
    },
    /// A mesh with a triangle that is none.
    #[error("triangle {triangle} of mesh {mesh} {problem}")]
    BadMesh {
        /// The mesh.
        mesh: usize,
        /// The triangle.
        triangle: usize,
        /// The fault.
        problem: String,
    },
    /// A parameter of a contact law is out of range.
    #[error("the contact law {law} has the {what} {value}; it must be {valid}")]
    BadLaw {
        /// The law.
        law: &'static str,
        /// Name of the quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid values.
        valid: &'static str,
    },
    /// A contact law that cannot be found by name, or built.
    #[error(transparent)]
    Plugin(#[from] RegistryError),
    /// A wall or a mesh names a law by a number that none has.
    #[error("{what} {number} follows contact law {law}, but there are {laws}")]
    NoLaw {
        /// Wall, mesh, or grains.
        what: &'static str,
        /// Number of the item, as the setup counts.
        number: usize,
        /// The law that it names.
        law: usize,
        /// Laws given.
        laws: usize,
    },
    /// The memory of a law exceeds the space of a contact.
    #[error("contact law {law} remembers {wanted} numbers per contact; there is room for {room}")]
    Memory {
        /// Its number.
        law: usize,
        /// Wanted.
        wanted: usize,
        /// Given.
        room: usize,
    },
    /// A number of the whole system is out of range.
    #[error("the {what} is {value}; it must be {valid}")]
    BadNumber {
        /// Name of the quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid values.
        valid: &'static str,
    },
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
    /// A wall is pressed but its area is not known.
    #[error(
        "the area of wall {wall} is not known: give it, or close the box with walls along the axes"
    )]
    NoArea {
        /// The wall.
        wall: usize,
    },
    /// A saved state that does not fit together.
    #[error("the saved state cannot be resumed: {problem}")]
    BadState {
        /// The fault.
        problem: String,
    },
    /// No place is left for a grain of a cloud.
    #[error("no place is left for grain {grain} of radius {radius} m after {tries} tries")]
    NoRoom {
        /// The grain.
        grain: usize,
        /// Its radius, m.
        radius: f64,
        /// Random places tried.
        tries: usize,
    },
    /// A preparation did not end.
    #[error(
        "{what} did not end within {steps} steps: unbalanced force ratio {unbalanced}, mean stress {stress} Pa"
    )]
    NotReached {
        /// Kind of the item.
        what: &'static str,
        /// Steps made.
        steps: u64,
        /// The rest.
        unbalanced: f64,
        /// Reached, Pa.
        stress: f64,
    },
    /// Grains did not come to rest.
    #[error("the grains are not at rest after {steps} steps: {unrest}")]
    NotSettled {
        /// Steps made.
        steps: u64,
        /// The condition of rest that does not hold.
        unrest: crate::grains::Unrest,
    },
}

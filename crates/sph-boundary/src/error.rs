//! Errors of walls, and of kernels at walls.

#[cfg(feature = "plugins")]
use sph_core::number::plain;

use crate::geometry::wall_end::WallEnd;

/// Most pairs of edges or triangles that are held against each other: a second or two of work.
pub(crate) const MOST_PAIRS: usize = 200_000_000;

/// A refused wall, motion or kernel.
///
/// `wall` and `other` are names; points, edges and triangles count from 0 as in the input, edge k of a triangle going
/// from its corner k to the next. Lengths are in metres.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
#[non_exhaustive]
pub enum BoundaryError {
    /// A bed that rises so far that the walls in it have no height left.
    #[error(
        "the bed `{wall}` has risen by {rise:.3} m, and walls that stand in it stretch over {height} m: give `[wall.{wall}.erodible]` a larger `stretch`"
    )]
    Buried {
        wall: String,
        rise: f64,
        height: f64,
    },
    /// A bed of too many places.
    #[error("the bed `{wall}` has {places} places, more than {most}: give it a larger `cell`")]
    ManyPlaces {
        wall: String,
        places: f64,
        most: usize,
    },
    /// Fluid at a body that is too light for it.
    #[error(
        "fluid acts on the body `{wall}`, which has less than a fiftieth of its density: one particle of it would throw the \
         body; give it more `density`"
    )]
    Light { wall: String },
    /// A coordinate that is infinite or not a number.
    #[error("wall `{wall}`: point {point} has a coordinate that is not finite")]
    NotFinite { wall: String, point: usize },
    /// Two consecutive points at the same place.
    #[error(
        "wall `{wall}`: edge {edge} has zero length, points {edge} and {next} are both at \
         {at}"
    )]
    ZeroLengthEdge {
        wall: String,
        edge: usize,
        next: usize,
        at: Place,
    },
    /// A closed wall that encloses nothing and is not a plate drawn forth and back.
    #[error(
        "wall `{wall}` is closed but encloses no area, and edge {edge} is not retraced in the \
         opposite direction as it would be on a plate of zero thickness"
    )]
    ZeroArea { wall: String, edge: usize },
    /// Two edges or triangles that cross.
    #[error(
        "{what} {number} of wall `{wall}` crosses {what} {other_number} of wall `{other}` near {at}"
    )]
    Crossing {
        what: &'static str,
        wall: String,
        number: usize,
        other: String,
        other_number: usize,
        at: Place,
    },
    /// Edges or triangles that lie across each other's boxes by the million.
    #[error(
        "from wall `{wall}` on, more than {MOST_PAIRS} pairs of {what} are so near each other that they must be \
         compared: draw it with fewer long slanted {what} side by side"
    )]
    Tangled { what: &'static str, wall: String },
    /// Two ends meet whose directions of travel disagree about where the fluid is.
    #[error(
        "the {end} end of wall `{wall}` meets the {other_end} end of wall `{other}` at {at}: \
         their directions of travel put the fluid on opposite sides, reverse one of them"
    )]
    OpposedWalls {
        wall: String,
        end: WallEnd,
        other: String,
        other_end: WallEnd,
        at: Place,
    },
    /// More than two ends at one place.
    #[error(
        "{count} ends of walls meet at {at}, the first of wall `{wall}`: only two can be \
         joined"
    )]
    AmbiguousJoint {
        wall: String,
        count: usize,
        at: Place,
    },
    /// A particle whose support reaches past the end of an open wall.
    #[error(
        "the {end} end of wall `{wall}` at {at} is free and particle {particle} is {distance} \
         m away, within the kernel radius {radius} m: close the wall or extend it"
    )]
    FreeEndInReach {
        wall: String,
        end: WallEnd,
        at: Place,
        particle: usize,
        distance: f64,
        radius: f64,
    },
    /// A plate folded back onto itself.
    #[error("plate `{wall}` turns too sharply at point {point} to be given a thickness")]
    SharpPlate { wall: String, point: usize },
    /// The number of poses or groups is not the number of walls.
    #[error("{given} {what}(s) given for {walls} wall(s)")]
    Count {
        what: &'static str,
        given: usize,
        walls: usize,
    },
    /// Two joined walls given different motions.
    #[error("walls `{wall}` and `{other}` are joined at {at} and cannot move differently")]
    JointTornApart {
        wall: String,
        other: String,
        at: Place,
    },
    /// A wall that as a whole is or does what it cannot.
    #[error("wall `{wall}` {why}")]
    Unfit { wall: String, why: String },
    /// A motion with a number that is not finite or a table that does not ascend.
    #[error(
        "the motion of wall `{wall}` is not sound: all numbers must be finite, periods positive, an axis longer than zero, and the times of a table ascending"
    )]
    Motion { wall: String },
    /// A corner that does not exist.
    #[error("wall `{wall}`: triangle {triangle} has the corner {point}, there are {count} points")]
    MissingPoint {
        wall: String,
        triangle: usize,
        point: u32,
        count: usize,
    },
    /// A triangle without area, or with two corners at one place.
    #[error("wall `{wall}`: triangle {triangle} at {at} has no area")]
    NoArea {
        wall: String,
        triangle: usize,
        at: Place,
    },
    /// A triangle so thin that its normal is rounding.
    #[error(
        "wall `{wall}`: triangle {triangle} at {at} is a needle: {altitude} m high on an edge of \
         {edge} m"
    )]
    Needle {
        wall: String,
        triangle: usize,
        at: Place,
        altitude: f64,
        edge: f64,
    },
    /// More elements than can be meant.
    #[error(
        "the walls would be cut into about {estimate} triangles, {limit} at most: `{wall}` alone \
         needs {own}; check the unit of length or use a coarser spacing"
    )]
    TooManyElements {
        wall: String,
        own: u64,
        estimate: u64,
        limit: u64,
    },
    /// One triangle given twice.
    #[error("wall `{wall}`: triangles {triangle} and {other} at {at} have the same corners")]
    Repeated {
        wall: String,
        triangle: usize,
        other: usize,
        at: Place,
    },
    /// Two faces of a wall on each other, with opposite normals.
    #[error(
        "wall `{wall}`: triangles {triangle} and {other} lie on each other near {at} with opposite \
         normals: give the plate a thickness, or draw bodies that touch as walls of their own"
    )]
    NoThickness {
        wall: String,
        triangle: usize,
        other: usize,
        at: Place,
    },
    /// Two triangles that travel their common edge in the same direction.
    #[error(
        "wall `{wall}`: triangles {triangle} and {other} meet in an edge at {at} but put the fluid \
         on opposite sides: one of them is flipped"
    )]
    Flipped {
        wall: String,
        triangle: usize,
        other: usize,
        at: Place,
    },
    /// An edge of more than two triangles.
    #[error(
        "wall `{wall}`: {count} triangles meet in one edge at {at}, the first is {triangle}: the \
         surface is not a manifold there, draw the bodies as walls of their own"
    )]
    NotManifold {
        wall: String,
        triangle: usize,
        count: usize,
        at: Place,
    },
    /// Two triangles in one plane that cover each other and face the same way.
    #[error(
        "triangle {triangle} of wall `{wall}` and triangle {other_triangle} of wall `{other}` \
         cover each other near {at}: that piece is drawn twice"
    )]
    DrawnTwice {
        wall: String,
        triangle: usize,
        other: String,
        other_triangle: usize,
        at: Place,
    },
    /// A wall that other walls cover altogether, or that bounds no fluid.
    #[error(
        "nothing is left of wall `{wall}`: other walls cover all of it, or face away from its edges: turn the one that faces the other way, leave the wall out, or give a plate of two sides a thickness"
    )]
    Covered { wall: String },
    /// Walls that meet in an edge with the fluid on different sides.
    #[error(
        "walls `{wall}` and `{other}` meet in an edge at {at} but put the fluid on opposite sides: \
         reverse the triangles of one of them"
    )]
    Opposed {
        wall: String,
        other: String,
        at: Place,
    },
    /// A planar piece that could not be cut into triangles.
    #[error("the planar piece of wall `{wall}` at {at} cannot be cut into triangles: {reason}")]
    NotMeshed {
        wall: String,
        at: Place,
        reason: String,
    },
    /// Two walls of one group given different motions.
    #[error("walls `{wall}` and `{other}` move together and cannot be given different motions")]
    TornApart { wall: String, other: String },
    /// A particle whose support reaches past an edge that no other triangle continues.
    #[error(
        "wall `{wall}` is open: {edges} edge(s) without a neighbour surround an opening of \
         {} m around {centre}, and at {at} one of them is {} m from particle {particle}, within the \
         kernel radius {} m: {}", plain(*.extent), plain(*.distance), plain(*.radius),
         remedy(.met)
    )]
    FreeEdgeInReach {
        wall: String,
        edges: usize,
        extent: f64,
        centre: Place,
        met: Option<Box<str>>,
        at: Place,
        particle: usize,
        distance: f64,
        radius: f64,
    },
    /// A number that must be positive and finite.
    #[error("{name} must be positive and finite, got {value}")]
    NotPositive { name: &'static str, value: f64 },
    /// Breaks or pieces of the kernel that do not fit.
    #[error("kernel is not a piecewise polynomial with a positive integral: {reason}")]
    Kernel { reason: String },
}

impl BoundaryError {
    pub(crate) fn unfit(wall: impl Into<String>, why: impl Into<String>) -> Self {
        let (wall, why) = (wall.into(), why.into());
        Self::Unfit { wall, why }
    }

    pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<(), Self> {
        match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(Self::NotPositive { name, value }),
        }
    }
}

#[cfg(not(feature = "plugins"))]
fn plain(x: f64) -> String {
    x.to_string()
}

fn remedy(met: &Option<Box<str>>) -> String {
    match met {
        Some(other) => format!(
            "wall `{other}` meets it there and does not continue it: turn the one that faces the other way"
        ),
        None => "close the wall or extend it".to_string(),
    }
}

/// A position, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Place(pub Box<[f64]>);

impl<const D: usize> From<[f64; D]> for Place {
    fn from(at: [f64; D]) -> Self {
        Place(at.into())
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Rounding of computed places is not shown.
        let size = self.0.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let unit = 10f64.powi(6 - size.max(f64::MIN_POSITIVE).log10().ceil() as i32);
        let rounded = |x: &f64| match (x * unit).round() / unit {
            rounded if rounded.is_finite() => rounded + 0.0,
            _ => *x,
        };
        let all: Vec<String> = self.0.iter().map(|x| rounded(x).to_string()).collect();
        write!(f, "({})", all.join(", "))
    }
}

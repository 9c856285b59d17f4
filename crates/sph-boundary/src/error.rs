//! Errors of walls, and of kernels at walls.

use std::fmt::Display;

use crate::geometry::polyline::WallEnd;

/// Most pairs of edges or triangles that are held against each other: a second or two of work.
pub(crate) const MOST_PAIRS: usize = 200_000_000;

/// Of walls, motions and kernels that may be refused.
pub(crate) type Result<T, E = BoundaryError> = std::result::Result<T, E>;

/// A refused wall, motion or kernel.
///
/// Messages name walls in backquotes; points, edges and triangles count from 0 as in the input, edge k of a triangle
/// going from its corner k to the next. Lengths are in metres.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
#[non_exhaustive]
pub enum BoundaryError {
    /// Walls that are or do what they cannot, in words.
    #[error("{0}")]
    Refused(String),
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
    /// A motion with a number that is not finite or a table that does not ascend.
    #[error(
        "the motion of wall `{wall}` is not sound: all numbers must be finite, periods positive, an axis longer than \
         zero, and the times of a table ascending"
    )]
    Motion { wall: String },
    /// A number that must be positive and finite.
    #[error("{name} must be positive and finite, got {value}")]
    NotPositive { name: &'static str, value: f64 },
    /// Breaks or pieces of the kernel that do not fit.
    #[error("kernel is not a piecewise polynomial with a positive integral: {reason}")]
    Kernel { reason: String },
}

impl BoundaryError {
    /// Of a wall as a whole.
    pub(crate) fn unfit(wall: impl Display, why: impl Display) -> Self {
        Self::Refused(format!("wall `{wall}` {why}"))
    }

    /// Of a point, an edge or a triangle of a wall.
    pub(crate) fn of_part(wall: impl Display, why: impl Display) -> Self {
        Self::Refused(format!("wall `{wall}`: {why}"))
    }

    pub(crate) fn check_positive(name: &'static str, value: f64) -> Result<()> {
        match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(Self::NotPositive { name, value }),
        }
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

impl Display for Place {
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

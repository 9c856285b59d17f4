//! Errors of walls, and of kernels at walls.

use std::fmt::Display;

/// Most pairs of edges or triangles that are held against each other: a second or two of work.
pub(crate) const MOST_PAIRS: usize = 200_000_000;

/// Of walls, motions and kernels that may be refused.
pub(crate) type Result<T, E = BoundaryError> = std::result::Result<T, E>;

/// A refused wall, motion or kernel, in words.
///
/// Messages name walls in backquotes; points, edges and triangles count from 0 as in the input, edge k of a triangle
/// going from its corner k to the next. Lengths are in metres.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct BoundaryError(pub(crate) String);

impl BoundaryError {
    /// A motion with a number that is not finite or a table that does not ascend.
    pub fn motion(wall: impl Display) -> Self {
        Self(format!(
            "the motion of wall `{wall}` is not sound: all numbers must be finite, periods positive, an axis longer \
             than zero, and the times of a table ascending"
        ))
    }

    /// Of a wall as a whole.
    pub(crate) fn unfit(wall: impl Display, why: impl Display) -> Self {
        Self(format!("wall `{wall}` {why}"))
    }

    /// Of a point, an edge or a triangle of a wall.
    pub(crate) fn of_part(wall: impl Display, why: impl Display) -> Self {
        Self(format!("wall `{wall}`: {why}"))
    }

    /// Two edges or triangles that cross, each of a wall and with its number there.
    pub(crate) fn crossing(what: &str, [a, b]: [(&str, usize); 2], at: impl Into<Place>) -> Self {
        let ((wall, number), (other, other_number), at) = (a, b, at.into());
        Self(format!(
            "{what} {number} of wall `{wall}` crosses {what} {other_number} of wall `{other}` near {at}"
        ))
    }

    /// Edges or triangles that lie across each other's boxes by the million.
    pub(crate) fn tangled(what: &str, wall: &str) -> Self {
        Self(format!(
            "from wall `{wall}` on, more than {MOST_PAIRS} pairs of {what} are so near each other that they must be \
             compared: draw it with fewer long slanted {what} side by side"
        ))
    }

    /// Breaks or pieces of the kernel that do not fit.
    pub(crate) fn kernel(reason: impl Display) -> Self {
        Self(format!(
            "kernel is not a piecewise polynomial with a positive integral: {reason}"
        ))
    }

    pub(crate) fn not_positive(name: &str, value: f64) -> Self {
        Self(format!("{name} must be positive and finite, got {value}"))
    }

    pub(crate) fn check_positive(name: &str, value: f64) -> Result<()> {
        match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(Self::not_positive(name, value)),
        }
    }
}

/// A position, m.
pub(crate) struct Place(Box<[f64]>);

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

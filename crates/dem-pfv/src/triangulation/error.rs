//! Errors of the triangulation, with their reasons.

use thiserror::Error;

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

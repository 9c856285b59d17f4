//! Errors of the triangulation, with their reasons.

use thiserror::Error;

/// Spheres or walls that have no regular triangulation.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TriangulationError {
    /// A coordinate or a radius is infinite or not a number, or a radius is negative.
    #[error(
        "sphere {sphere} has the centre {centre:?} m and the radius {radius} m; \
         numbers must be finite and radii not negative"
    )]
    BadSphere {
        /// Its number.
        sphere: usize,
        /// Its centre, m.
        centre: [f64; 3],
        /// Its radius, m.
        radius: f64,
    },
    /// A wall without a direction or a place.
    #[error(
        "wall {wall} has the normal {normal:?} and the offset {offset} m; the normal must be of length 1"
    )]
    BadWall {
        /// Its number.
        wall: usize,
        /// Its inward normal.
        normal: [f64; 3],
        /// Its distance from the origin along the normal, m.
        offset: f64,
    },
    /// There is nothing to triangulate.
    #[error("there are {spheres} spheres; at least {needed} are needed")]
    TooFew {
        /// Given.
        spheres: usize,
        /// One between walls, four without.
        needed: usize,
    },
    /// Without walls, all centres lie in one plane.
    #[error("all centres lie in one plane; without walls such spheres have no triangulation")]
    Flat,
    /// Two spheres have the same centre.
    #[error("spheres {first} and {second} have the same centre {centre:?} m")]
    Duplicate {
        /// The lower number.
        first: usize,
        /// The higher number.
        second: usize,
        /// The centre, m.
        centre: [f64; 3],
    },
    /// A sphere is nowhere the one of least power: others overlap it deeply.
    #[error(
        "sphere {sphere} is hidden by others: its centre lies inside one of them, or nearly so"
    )]
    Hidden {
        /// Its number.
        sphere: usize,
    },
    /// A centre is on a wall or behind it.
    #[error("the centre of sphere {sphere} is {distance} m from wall {wall}; it must lie inside")]
    Outside {
        /// The sphere.
        sphere: usize,
        /// The wall.
        wall: usize,
        /// Signed distance of the centre from the wall, m.
        distance: f64,
    },
    /// The walls leave a way out, or no room at all.
    #[error(
        "the walls do not close a room: walls {first} and {second} meet in {corners} corners instead of two"
    )]
    Open {
        /// A wall.
        first: usize,
        /// Another.
        second: usize,
        /// Corners that both have a part in.
        corners: usize,
    },
    /// A wall touches the room nowhere.
    #[error("wall {wall} has no part in the room of the others; leave it out")]
    IdleWall {
        /// Its number.
        wall: usize,
    },
    /// Four walls meet in a point, as at the tip of a pyramid.
    #[error("walls {walls:?} meet in one point; at most three may")]
    FourWallsMeet {
        /// Their numbers.
        walls: [usize; 4],
    },
}

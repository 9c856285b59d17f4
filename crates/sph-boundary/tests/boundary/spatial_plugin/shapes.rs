//! Walls to draw.

use sph_boundary::{Drawing, Surface};

use crate::surface::shapes;
pub use crate::surface::shapes::{block, tank};

/// A flat square of the plane z = 0, the fluid above it.
pub fn floor(low: f64, high: f64) -> Surface {
    shapes::floor([low; 2], [high; 2])
}

/// A square pyramid that stands on the plane z = 0, the fluid around it.
pub fn pyramid(half: f64, height: f64) -> Surface {
    shapes::pyramid([0.0; 2], half, 0.0, height)
}

/// The upright prism over a polygon in the plane of x and z, drawn out along y, the fluid around it.
///
/// The polygon is star-shaped from its first corner and clockwise.
pub fn prism(name: &str, polygon: &[[f64; 2]], y: [f64; 2]) -> Surface {
    let mut prism = shapes::prism(name, polygon, y, true);
    prism.points.iter_mut().for_each(|p| p.swap(1, 2));
    prism
}

pub fn wall(surface: Surface) -> Drawing {
    Drawing::Surface(surface)
}

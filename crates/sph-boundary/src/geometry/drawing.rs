//! The drawing of a wall in a scene.

use crate::{Polyline, Surface};

/// Geometry of a wall.
#[derive(Clone, Debug)]
pub enum Drawing {
    /// In two dimensions.
    Line(Polyline),
    /// In three dimensions.
    Surface(Surface),
}

impl Drawing {
    /// Name of the wall.
    pub fn name(&self) -> &str {
        match self {
            Self::Line(line) => &line.name,
            Self::Surface(surface) => &surface.name,
        }
    }

    /// Its points, with a given number of coordinates, m.
    pub fn points<const D: usize>(&self) -> Vec<[f64; D]> {
        match self {
            Self::Line(line) => line.points.iter().map(cut).collect(),
            Self::Surface(surface) => surface.points.iter().map(cut).collect(),
        }
    }
}

fn cut<const N: usize, const D: usize>(place: &[f64; N]) -> [f64; D] {
    std::array::from_fn(|k| place.get(k).copied().unwrap_or(0.0))
}

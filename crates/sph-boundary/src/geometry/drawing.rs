//! What a scene draws of a wall.

use crate::{Polyline, Surface};

/// How a wall is drawn.
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
}

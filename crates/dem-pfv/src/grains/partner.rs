//! The second body of a contact.

/// The second body of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Partner {
    /// A grain.
    Grain(usize),
    /// A wall.
    Wall(usize),
    /// A triangle of a mesh.
    Triangle {
        /// The mesh.
        mesh: usize,
        /// The triangle.
        triangle: usize,
    },
}

impl std::fmt::Display for Partner {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Grain(grain) => write!(f, "grain {grain}"),
            Self::Wall(wall) => write!(f, "wall {wall}"),
            Self::Triangle { mesh, triangle } => write!(f, "triangle {triangle} of mesh {mesh}"),
        }
    }
}

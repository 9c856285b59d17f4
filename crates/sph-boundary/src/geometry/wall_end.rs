//! Ends of open walls.

/// An end of an open wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WallEnd {
    /// The start of the direction of travel.
    First,
    /// The end of the direction of travel.
    Last,
}

impl std::fmt::Display for WallEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::First => "first",
            Self::Last => "last",
        })
    }
}

/// The end of a wall that nothing continues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeEnd {
    /// Index of the wall.
    pub wall: usize,
    /// Its end.
    pub end: WallEnd,
    /// Index of the node.
    pub node: usize,
}

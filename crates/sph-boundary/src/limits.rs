//! Limits of the work of walls.

/// Most pairs of edges or triangles that are held against each other: a second or two of work.
pub(crate) const MOST_PAIRS: usize = 200_000_000;
/// Most periods that walls may reach across: images are counted in a byte.
pub(crate) const MOST_PERIODS: f64 = 100.0;

//! Walls that grains make, as a scene describes them.

/// A wall whose surface is a bed of grains: the data to lay its [`Bed`](sph_core::bed::Bed). Walls that stand in the
/// bed have the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Erodible {
    /// Name of the wall whose surface is the bed.
    pub wall: String,
    /// Distance of the places at which the level is known, m.
    pub cell: f64,
    /// Start of the bed along x and y, m; −∞ for as far as the wall goes.
    pub from: [f64; 2],
    /// End of the bed, m; ∞ for as far as the wall goes.
    pub to: [f64; 2],
    /// The level under which there are no grains, m; −∞ without.
    pub rock: f64,
    /// Height over the bed within which walls that stand in it stretch, m.
    pub fade: f64,
}

impl Erodible {
    /// True if all its numbers are possible.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let ordered = (0..2).all(|k| self.from[k] < self.to[k]);
        positive(self.cell) && positive(self.fade) && ordered && self.rock < f64::INFINITY
    }
}

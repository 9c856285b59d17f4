//! Reproducible numbers.

/// A linear congruential generator (Knuth's MMIX), good enough for points.
pub struct Random(pub u64);

impl Random {
    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in a cube around the origin.
    pub fn vector(&mut self, half: f64) -> [f64; 3] {
        [0; 3].map(|_| self.between(-half, half))
    }
}

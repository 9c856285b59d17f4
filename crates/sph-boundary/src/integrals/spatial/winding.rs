//! The sum of many angles with one arc tangent.

use std::f64::consts::TAU;

/// Σ φ over rotations given by any positive multiples of cos φ and sin φ, |φ| ≤ π.
#[derive(Clone, Copy)]
pub(super) struct Winding {
    cos: f64,
    sin: f64,
    turns: f64,
}

/// Lengths between the reciprocal of this and this are not normalised.
const LONG: f64 = 1e60;

impl Winding {
    pub const NONE: Self = Self {
        cos: 1.0,
        sin: 0.0,
        turns: 0.0,
    };

    /// Adds atan2(`sin`, `cos`).
    #[inline]
    pub fn add(&mut self, cos: f64, sin: f64) {
        let size = cos.abs() + sin.abs();
        if size == 0.0 {
            return;
        }
        let c = self.cos * cos - self.sin * sin;
        let s = self.cos * sin + self.sin * cos;
        // Crossing of the half line φ = π, which belongs to the upper half plane.
        if self.sin >= 0.0 && sin >= 0.0 && s < 0.0 {
            self.turns += 1.0;
        } else if self.sin < 0.0 && sin < 0.0 && s >= 0.0 {
            self.turns -= 1.0;
        }
        let length = c.abs() + s.abs();
        let scale = if (1.0 / LONG..=LONG).contains(&length) {
            1.0
        } else {
            1.0 / length
        };
        (self.cos, self.sin) = (c * scale, s * scale);
    }

    #[inline]
    pub fn angle(&self) -> f64 {
        // −0 is in the upper half plane too.
        (self.sin + 0.0).atan2(self.cos) + TAU * self.turns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_add_up_over_several_turns() {
        for (step, count) in [
            (0.7, 40),
            (-0.7, 40),
            (3.0, 7),
            (-3.0, 7),
            (0.01, 5),
            (-0.1, 99),
        ] {
            let mut sum = Winding::NONE;
            for i in 0..count {
                let size = if i % 2 == 0 { 1e-25 } else { 1e33 };
                sum.add(size * f64::cos(step), size * f64::sin(step));
            }
            let off = (sum.angle() - step * f64::from(count)).abs();
            assert!(off < 1e-13, "{step}: {off:e}");
        }
    }

    #[test]
    fn right_angles_make_a_turn() {
        for sign in [1.0, -1.0] {
            let mut sum = Winding::NONE;
            for _ in 0..4 {
                sum.add(0.0, sign);
            }
            assert_eq!(sum.angle(), sign * TAU);
        }
        assert_eq!(Winding::NONE.angle(), 0.0);
    }
}

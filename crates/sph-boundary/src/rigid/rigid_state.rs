//! Where a rigid wall is and how it moves: its state.

use sph_core::Vect;

use crate::rigid::pose::{Pose, swept};

/// Place, orientation, velocity and angular velocity of a rigid wall, with their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidState<const D: usize> {
    /// From where it was drawn to where it is.
    pub pose: Pose<D>,
    /// The point that the translation carries and about which it turns, where it was drawn, m.
    pub centre: [f64; D],
    /// Velocity of that point, m/s.
    pub velocity: Vect<D>,
    /// Its acceleration, m/s².
    pub acceleration: Vect<D>,
    /// Unit vector of the axis, right-handed; (0, 0, 1) in the plane, zero for a wall that does not turn.
    pub axis: [f64; 3],
    /// Angular velocity about the axis, rad/s.
    pub spin: f64,
    /// Its rate, rad/s².
    pub spin_rate: f64,
}

/// Velocity and acceleration of a place of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement<const D: usize> {
    /// Velocity, m/s.
    pub velocity: Vect<D>,
    /// Acceleration, m/s².
    pub acceleration: Vect<D>,
}

/// A force and a moment that act on a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<const D: usize> {
    /// Force, N (N/m in two dimensions).
    pub force: Vect<D>,
    /// Moment about the origin, N m; only the last component in two dimensions.
    pub moment: [f64; 3],
    /// Gravity, m/s²; what it does to the wall is the mover's business.
    pub gravity: Vect<D>,
}

impl<const D: usize> Default for RigidState<D> {
    fn default() -> Self {
        RigidState {
            pose: Pose::default(),
            centre: [0.0; D],
            velocity: Vect::zeros(),
            acceleration: Vect::zeros(),
            axis: [0.0; 3],
            spin: 0.0,
            spin_rate: 0.0,
        }
    }
}

impl<const D: usize> RigidState<D> {
    /// Velocity and acceleration of a point of the wall at its present position, m:
    /// u = v + ω × r, a = v̇ + ω̇ × r + ω × (ω × r), r from the centre.
    pub fn movement(&self, point: [f64; D]) -> Movement<D> {
        let mut movement = Movement {
            velocity: self.velocity,
            acceleration: self.acceleration,
        };
        if self.spin != 0.0 || self.spin_rate != 0.0 {
            let arm =
                Vect::from(point) - Vect::from(self.centre) - Vect::from(self.pose.translation);
            let swept = |v: &Vect<D>| swept(self.axis, v);
            movement.velocity += swept(&arm) * self.spin;
            movement.acceleration +=
                swept(&arm) * self.spin_rate + swept(&swept(&arm)) * (self.spin * self.spin);
        }
        movement
    }

    /// Where the centre is now, m.
    pub fn place(&self) -> Vect<D> {
        Vect::from(self.centre) + Vect::from(self.pose.translation)
    }

    /// Turned further by a small angle about the axis through the centre, rad.
    #[must_use]
    pub fn turned_by(mut self, angle: f64) -> Self {
        if angle != 0.0 {
            let turn = Pose::turned_about(self.axis, angle, self.centre);
            let rows = turn.rotation;
            let before = self.pose.rotation;
            self.pose.rotation = std::array::from_fn(|i| {
                std::array::from_fn(|k| (0..D).map(|j| rows[i][j] * before[j][k]).sum())
            });
            self.pose.centre = self.centre;
        }
        self
    }

    /// All its numbers, for files: translation, rotation row by row, centres, velocity, acceleration, axis and spins.
    pub fn numbers(&self) -> Vec<f64> {
        let mut all = self.pose.translation.to_vec();
        all.extend(self.pose.rotation.iter().flatten());
        all.extend(self.pose.centre);
        all.extend(self.centre);
        all.extend(self.velocity.iter());
        all.extend(self.acceleration.iter());
        all.extend(self.axis);
        all.extend([self.spin, self.spin_rate]);
        all
    }

    /// How many [`numbers`](Self::numbers) a state has.
    pub const NUMBERS: usize = 5 * D + D * D + 5;

    /// From its numbers; none if there are not as many, or not finite ones.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        if numbers.len() != Self::NUMBERS || !numbers.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut rest = numbers.iter().copied();
        let mut next = || rest.next().unwrap_or_default();
        let mut state = Self::default();
        state.pose.translation = std::array::from_fn(|_| next());
        state.pose.rotation = std::array::from_fn(|_| std::array::from_fn(|_| next()));
        state.pose.centre = std::array::from_fn(|_| next());
        state.centre = std::array::from_fn(|_| next());
        state.velocity = Vect::from_fn(|_, _| next());
        state.acceleration = Vect::from_fn(|_, _| next());
        state.axis = std::array::from_fn(|_| next());
        state.spin = next();
        state.spin_rate = next();
        Some(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_give_the_state_back_and_nonsense_none() {
        let state = RigidState::<3> {
            pose: Pose::about_axis([1.0, 2.0, -0.5], 0.3, [0.1, 0.2, 0.3]),
            centre: [0.1, 0.2, 0.3],
            velocity: Vect::<3>::new(1.0, -2.0, 3.0),
            acceleration: Vect::<3>::new(0.5, 0.25, 0.125),
            axis: [0.0, 0.6, 0.8],
            spin: 4.0,
            spin_rate: -5.0,
        };
        let numbers = state.numbers();
        assert_eq!(numbers.len(), RigidState::<3>::NUMBERS);
        assert_eq!(RigidState::from_numbers(&numbers), Some(state));
        assert_eq!(RigidState::<2>::from_numbers(&numbers), None);
        let bad: Vec<f64> = numbers.iter().map(|_| f64::NAN).collect();
        assert_eq!(RigidState::<3>::from_numbers(&bad), None);
    }

    #[test]
    fn two_turns_are_the_turn_by_both_angles() {
        let start = RigidState::<2> {
            axis: [0.0, 0.0, 1.0],
            centre: [0.3, -0.2],
            ..RigidState::default()
        };
        let twice = start.turned_by(0.4).turned_by(0.7);
        let once = Pose::rotated(1.1, [0.3, -0.2]);
        let [a, b] = [twice.pose.map(), once.map()].map(|map| map([1.0, 2.0]));
        assert!((a[0] - b[0]).abs() < 1e-15 && (a[1] - b[1]).abs() < 1e-15);
    }
}

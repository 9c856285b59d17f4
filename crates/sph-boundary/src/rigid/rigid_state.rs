//! State of a rigid wall: place and velocity.

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
    /// Its acceleration in the pressure at the wall, m/s².
    pub acceleration: Vect<D>,
    /// Angular velocity ω, right-handed, rad/s; (0, 0, ω) in the plane.
    pub angular_velocity: [f64; 3],
    /// Its rate ω̇, rad/s².
    pub angular_acceleration: [f64; 3],
    /// Change of both velocities over the last step, m/s² and rad/s², of walls with movers.
    pub rate: [f64; 6],
    /// Both velocities less those that friction was last solved with, m/s and rad/s.
    pub missed: [f64; 6],
}

/// Velocity and acceleration of a place of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement<const D: usize> {
    /// Velocity, m/s.
    pub velocity: Vect<D>,
    /// Acceleration, m/s².
    pub acceleration: Vect<D>,
}

impl<const D: usize> Default for RigidState<D> {
    fn default() -> Self {
        RigidState {
            pose: Pose::default(),
            centre: [0.0; D],
            velocity: Vect::zeros(),
            acceleration: Vect::zeros(),
            angular_velocity: [0.0; 3],
            angular_acceleration: [0.0; 3],
            rate: [0.0; 6],
            missed: [0.0; 6],
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
        let (omega, rate) = (self.angular_velocity, self.angular_acceleration);
        if omega != [0.0; 3] || rate != [0.0; 3] {
            let arm =
                Vect::from(point) - Vect::from(self.centre) - Vect::from(self.pose.translation);
            let swept = |e, v: &Vect<D>| Vect::from(swept(e, (*v).into()));
            let velocity = swept(omega, &arm);
            movement.velocity += velocity;
            movement.acceleration += swept(rate, &arm) + swept(omega, &velocity);
        }
        movement
    }

    /// Change of both velocities from an earlier state over a time, m/s² and rad/s².
    pub fn rate_from(&self, earlier: &Self, dt: f64) -> [f64; 6] {
        let change = self.velocity - earlier.velocity;
        let turns = [self, earlier].map(|s| s.angular_velocity);
        std::array::from_fn(|k| match k {
            0..3 => change.get(k).copied().unwrap_or(0.0) / dt,
            _ => (turns[0][k - 3] - turns[1][k - 3]) / dt,
        })
    }

    /// Present centre, m.
    pub fn place(&self) -> Vect<D> {
        Vect::from(self.centre) + Vect::from(self.pose.translation)
    }

    /// Turned further by |φ| about the axis φ/|φ| through the centre, rad.
    #[must_use]
    pub fn turned_by(mut self, turn: [f64; 3]) -> Self {
        let angle = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
        if angle > 0.0 {
            let turn = Pose::turned_about(turn.map(|x| x / angle), angle, self.centre);
            let rows = turn.rotation;
            let before = self.pose.rotation;
            self.pose.rotation = std::array::from_fn(|i| {
                std::array::from_fn(|k| (0..D).map(|j| rows[i][j] * before[j][k]).sum())
            });
            self.pose.centre = self.centre;
        }
        self
    }

    /// All its numbers, for files: translation, rotation row by row, centres, velocity, acceleration, angular velocity and
    /// acceleration, rate, error of the expected change.
    pub fn numbers(&self) -> Vec<f64> {
        let mut state = *self;
        state.parts().concat()
    }

    fn parts(&mut self) -> [&mut [f64]; 10] {
        [
            &mut self.pose.translation,
            self.pose.rotation.as_flattened_mut(),
            &mut self.pose.centre,
            &mut self.centre,
            self.velocity.as_mut_slice(),
            self.acceleration.as_mut_slice(),
            &mut self.angular_velocity,
            &mut self.angular_acceleration,
            &mut self.rate,
            &mut self.missed,
        ]
    }

    /// Count of the [`numbers`](Self::numbers) of a state.
    pub const NUMBERS: usize = 5 * D + D * D + 18;

    /// From its numbers; none if there are not as many, or not finite ones.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        if numbers.len() != Self::NUMBERS || !numbers.iter().all(|x| x.is_finite()) {
            return None;
        }
        let mut state = Self::default();
        let places = state.parts().into_iter().flatten();
        places
            .zip(numbers)
            .for_each(|(place, number)| *place = *number);
        Some(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_give_the_state_back_and_nonsense_none() {
        let state = RigidState::<3> {
            pose: Pose::turned_about([0.0, 0.6, -0.8], 0.3, [0.1, 0.2, 0.3]),
            centre: [0.1, 0.2, 0.3],
            velocity: Vect::<3>::new(1.0, -2.0, 3.0),
            acceleration: Vect::<3>::new(0.5, 0.25, 0.125),
            angular_velocity: [0.0, 0.6, 0.8],
            angular_acceleration: [4.0, 0.5, -5.0],
            rate: [0.5, 0.25, 0.125, 4.0, 0.5, -5.0],
            missed: [0.25, 0.125, 4.0, 0.5, -5.0, 0.5],
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
            centre: [0.3, -0.2],
            ..RigidState::default()
        };
        let twice = start.turned_by([0.0, 0.0, 0.4]).turned_by([0.0, 0.0, 0.7]);
        let once = Pose::turned_about([0.0, 0.0, 1.0], 1.1, [0.3, -0.2]);
        let [a, b] = [twice.pose.map(), once.map()].map(|map| map([1.0, 2.0]));
        assert!((a[0] - b[0]).abs() < 1e-15 && (a[1] - b[1]).abs() < 1e-15);
    }
}

//! Prescribed rigid motion of a wall.

use crate::Pose;

/// Constant velocity and spin between two times; at rest before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    /// Velocity, m/s.
    pub velocity: [f64; 2],
    /// Angular velocity, counter-clockwise, rad/s.
    pub angular_velocity: f64,
    /// Centre of rotation at time 0, m; it moves along.
    pub centre: [f64; 2],
    /// Start, s.
    pub start: f64,
    /// Stop, s.
    pub stop: f64,
}

impl Default for RigidMotion {
    fn default() -> Self {
        RigidMotion {
            velocity: [0.0; 2],
            angular_velocity: 0.0,
            centre: [0.0; 2],
            start: 0.0,
            stop: f64::INFINITY,
        }
    }
}

impl RigidMotion {
    /// Whether the wall ever moves.
    pub fn moves(&self) -> bool {
        self.velocity != [0.0; 2] || self.angular_velocity != 0.0
    }

    fn elapsed(&self, time: f64) -> f64 {
        (time.min(self.stop) - self.start).max(0.0)
    }

    /// Where the wall is at a time, from where it was drawn.
    pub fn pose(&self, time: f64) -> Pose {
        let t = self.elapsed(time);
        Pose {
            translation: [t * self.velocity[0], t * self.velocity[1]],
            angle: t * self.angular_velocity,
            centre: self.centre,
        }
    }

    /// Velocity of a point of the wall at its present position, m/s.
    pub fn velocity_at(&self, point: [f64; 2], time: f64) -> [f64; 2] {
        if time < self.start || time >= self.stop {
            return [0.0; 2];
        }
        let t = self.elapsed(time);
        let arm = [0, 1].map(|k| point[k] - self.centre[k] - t * self.velocity[k]);
        [
            self.velocity[0] - self.angular_velocity * arm[1],
            self.velocity[1] + self.angular_velocity * arm[0],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_velocity_is_the_rate_of_the_pose() {
        let motion = RigidMotion {
            velocity: [0.3, -0.2],
            angular_velocity: 1.7,
            centre: [0.1, 0.4],
            start: 0.5,
            stop: 2.0,
        };
        let corner = [0.9, -0.3];
        let at = |t: f64| motion.pose(t).map()(corner);
        for t in [0.2, 0.9, 1.7, 2.5] {
            let (before, after) = (at(t - 1e-6), at(t + 1e-6));
            let velocity = motion.velocity_at(at(t), t);
            for k in 0..2 {
                let rate = (after[k] - before[k]) / 2e-6;
                assert!(
                    (rate - velocity[k]).abs() < 1e-8,
                    "t = {t}: {rate} {}",
                    velocity[k]
                );
            }
        }
    }
}

//! The face of a paddle: its gauge, and its motion besides the prescribed one.

use sph_boundary::{Drawing, MoverSetting, RigidState};
use sph_core::Vect;
use sph_neighbours::DepthGauge;

/// Unit axis about which a flap turns forward, up × along; along z in the plane.
pub(crate) fn forward<const D: usize>(along: &Vect<D>) -> [f64; 3] {
    match D {
        2 => [0.0, 0.0, -along[0]],
        _ => [-along[1], along[0], 0.0],
    }
}

/// The face of a paddle as it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Face<const D: usize> {
    along: Vect<D>,
    /// A point of it, the lowest one that moves, m.
    place: Vect<D>,
    /// Height of the still level over the hinge, m; none for a piston.
    arm: Option<f64>,
    reach: f64,
    sideways: [f64; 2],
}

impl<const D: usize> Face<D> {
    /// The foremost of a wall; none if it has no breadth.
    pub fn foremost(
        setting: &MoverSetting<'_, D>,
        along: Vect<D>,
        hinge: Option<Vect<D>>,
        level: f64,
        reach: f64,
    ) -> Option<Self> {
        let points = setting.pieces().flat_map(Drawing::points);
        let points: Vec<Vect<D>> = points.map(Vect::from).collect();
        let most = |of: &dyn Fn(&Vect<D>) -> f64| {
            let largest = points.iter().map(of).reduce(f64::max);
            largest.unwrap_or(0.0)
        };
        let front = most(&|p| p.dot(&along));
        let side = |p: &Vect<D>| match D {
            3 => p[1] * along[0] - p[0] * along[1],
            _ => 0.0,
        };
        let sideways = [-most(&|p| -side(p)), most(&side)];
        if D == 3 && sideways[1] <= sideways[0] {
            return None;
        }
        let origin = hinge.unwrap_or_else(Vect::zeros);
        Some(Face {
            along,
            place: origin + along * (front - origin.dot(&along)),
            arm: hinge.map(|h| level - h[D - 1]),
            reach,
            sideways,
        })
    }

    /// The depth gauge of the face.
    pub fn gauge(&self, now: &RigidState<D>) -> DepthGauge<D> {
        let [way, _] = self.movement(now);
        let (place, lean) = match self.arm {
            None => (self.place + self.along * way, 0.0),
            Some(arm) => (self.place, (way / arm).tan()),
        };
        DepthGauge {
            place,
            along: self.along,
            lean,
            reach: self.reach,
            sideways: self.sideways,
        }
    }

    /// Way and velocity at the still level, m and m/s; of a flap the arc.
    fn movement(&self, state: &RigidState<D>) -> [f64; 2] {
        let Some(arm) = self.arm else {
            let way = Vect::from(state.pose.translation).dot(&self.along);
            return [way, state.velocity.dot(&self.along)];
        };
        let up = state.pose.rotation.map(|row| row[D - 1]);
        let angle = Vect::from(up).dot(&self.along).atan2(up[D - 1]);
        let axis = forward(&self.along);
        let rate: f64 = (0..3).map(|k| axis[k] * state.angular_velocity[k]).sum();
        [arm * angle, arm * rate]
    }

    /// Way and velocity besides the prescribed motion.
    pub fn free_motion(&self, now: &RigidState<D>, plan: &RigidState<D>) -> [f64; 2] {
        let (now, plan) = (self.movement(now), self.movement(plan));
        [now[0] - plan[0], now[1] - plan[1]]
    }

    /// The prescribed motion, and a way, a velocity and an acceleration besides.
    pub fn moved(
        &self,
        plan: RigidState<D>,
        [way, velocity]: [f64; 2],
        acceleration: f64,
    ) -> RigidState<D> {
        let Some(arm) = self.arm else {
            let mut state = plan;
            let along = self.along * way;
            (0..D).for_each(|k| state.pose.translation[k] += along[k]);
            state.velocity += self.along * velocity;
            state.acceleration += self.along * acceleration;
            return state;
        };
        let axis = forward(&self.along);
        let mut state = plan.turned_by(axis.map(|e| e * way / arm));
        for (k, e) in axis.iter().enumerate() {
            state.angular_velocity[k] += e * velocity / arm;
            state.angular_acceleration[k] += e * acceleration / arm;
        }
        state
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An added motion can be read off again, of a piston and of a flap, along any direction.
    #[test]
    fn an_added_motion_is_read_back() {
        for arm in [None, Some(0.5)] {
            let face = Face::<3> {
                along: Vect::<3>::new(0.6, -0.8, 0.0),
                place: Vect::zeros(),
                arm,
                reach: 0.1,
                sideways: [0.0, 1.0],
            };
            let plan = face.moved(RigidState::default(), [0.02, 0.1], 0.0);
            let now = face.moved(plan, [0.01, -0.3], 2.0);
            let [way, velocity] = face.free_motion(&now, &plan);
            assert!((way - 0.01).abs() < 1e-15 && (velocity + 0.3).abs() < 1e-15);
            let top = now
                .movement((Vect::<3>::new(0.0, 0.0, 0.5)).into())
                .velocity;
            assert!((top.dot(&face.along) + 0.2).abs() < 2e-2, "{top}");
        }
    }
}

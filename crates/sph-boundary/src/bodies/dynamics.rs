//! Newton's and Euler's equations over a step.

use nalgebra::{Matrix3, Matrix6, Rotation3, UnitQuaternion, Vector3, Vector6};
use sph_core::Vect;

use crate::bodies::freedom::Freedom;
use crate::bodies::mooring::{Mooring, Pull};
use crate::bodies::prescribed::{Prescribed, moved};
use crate::bodies::spatial_vector::{blocks, padded, parts, rotation, six, solve};
use crate::{Load, RigidState};

/// A body in the equations of motion; matrices in the drawn place.
#[derive(Clone, Debug)]
pub(crate) struct Dynamics {
    pub mass: f64,
    /// Centre of mass, m.
    pub centre: Vector3<f64>,
    /// Inertia about the centre, kg m².
    pub inertia: Matrix3<f64>,
    /// Inertia A* of the layer of fluid at the surface.
    pub layer: Matrix6<f64>,
    pub free: [bool; 6],
    /// Stiffness and damping on degrees of freedom.
    pub holds: Vec<(Freedom, f64, f64)>,
    pub lines: Vec<Mooring>,
    /// The time from which on it is free, s.
    pub start: f64,
    /// Times in which it is not free again.
    pub prescribed: Vec<Prescribed>,
}

impl Dynamics {
    /// The state after a step of `dt` seconds.
    ///
    /// (M + Δt C + Δt² K) a = F − K s − C v − Δt K v over the free ones of the six, with F the force of the fluid and its
    /// moment about the centre, weight and contact; v' = v + Δt a, x' = x + Δt v'; in free flight x' = x + Δt (v + v')/2.
    pub fn next<const D: usize>(
        &self,
        now: &RigidState<D>,
        load: &Load<D>,
        time: f64,
        dt: f64,
    ) -> RigidState<D> {
        let prescribed = self.prescribed.iter().find(|p| p.holds(time));
        if prescribed.is_some() || time < self.start {
            return moved(now, prescribed.and_then(|p| p.at(time + dt)), dt);
        }
        let turn = rotation(now);
        let (inertia, mass) = self.inertia_at(&turn);
        let omega = Vector3::from(now.angular_velocity);
        let velocity = six(padded(now.velocity.as_slice()), omega);
        let gyroscopic = omega.cross(&(inertia * omega));
        let mut force = self.force(now, load) - six(Vector3::zeros(), gyroscopic);
        let mut matrix = mass;
        self.hold(now, &velocity, dt, &mut matrix, &mut force);
        let acceleration = solve(matrix, force, self.free);
        let (along, about) = parts(&acceleration);
        let mut state = *now;
        let moved = padded(now.velocity.as_slice()) + along * dt;
        state.velocity = Vect::from_fn(|k, _| moved[k]);
        // Weight alone is a constant force, of which the mean velocity makes the exact parabola.
        let weight = [load.force, load.contact_force] == [Vect::<D>::zeros(); 2];
        let flies = weight && self.holds.is_empty() && self.lines.is_empty();
        let share = if flies { 0.5 } else { 1.0 };
        let mean = now.velocity.lerp(&state.velocity, share);
        state.pose.translation = (Vect::from(now.pose.translation) + mean * dt).into();
        let (turned, omega_next) = match self.free[3..] {
            [true, true, true] if D == 3 => {
                let moment = inertia * about + gyroscopic;
                self.tumbled(&turn, inertia * omega + moment * dt, dt)
            }
            _ => (omega + about * dt, omega + about * dt),
        };
        state = state.turned_by((turned * dt).into());
        state.angular_velocity = omega_next.into();

        // The acceleration in the pressure at the wall follows that of the body.
        let turning = now.angular_acceleration.into();
        let felt = six(padded(now.acceleration.as_slice()), turning);
        let whole = six(along, (omega_next - omega) / dt);
        let frame = blocks(turn, turn);
        let layer = frame * self.layer * frame.transpose();
        let change = solve(mass + layer, mass * (whole - felt), self.free);
        let (along, about) = parts(&(felt + change));
        state.acceleration = Vect::from_fn(|k, _| along[k]);
        state.angular_acceleration = about.into();
        state
    }

    /// The inverse of mass and inertia over the free degrees at a time.
    pub fn mobility<const D: usize>(&self, now: &RigidState<D>, time: f64) -> Matrix6<f64> {
        if time < self.start || self.prescribed.iter().any(|p| p.holds(time)) {
            return Matrix6::zeros();
        }
        let (_, mass) = self.inertia_at(&rotation(now));
        let column = |k| solve(mass, Matrix6::identity().column(k).into_owned(), self.free);
        Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(column))
    }

    fn inertia_at(&self, turn: &Matrix3<f64>) -> (Matrix3<f64>, Matrix6<f64>) {
        let inertia = turn * self.inertia * turn.transpose();
        (inertia, blocks(Matrix3::identity() * self.mass, inertia))
    }

    fn force<const D: usize>(&self, now: &RigidState<D>, load: &Load<D>) -> Vector6<f64> {
        let place = padded(now.place().as_slice());
        let [fluid, contact] = [&load.force, &load.contact_force].map(|f| padded(f.as_slice()));
        let moment = Vector3::from(load.moment) + Vector3::from(load.contact_moment);
        let weight = padded(load.gravity.as_slice()) * self.mass;
        let surface = fluid + contact;
        six(surface + weight, moment - place.cross(&surface))
    }

    /// Springs, dampers and lines, taken at the end of the step.
    fn hold<const D: usize>(
        &self,
        now: &RigidState<D>,
        velocity: &Vector6<f64>,
        dt: f64,
        matrix: &mut Matrix6<f64>,
        force: &mut Vector6<f64>,
    ) {
        let turn = rotation(now);
        let shift = padded(&now.pose.translation);
        if !self.holds.is_empty() {
            let rotation = Rotation3::from_matrix_unchecked(turn);
            let angle = UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis();
            let way = six(shift, angle);
            for (freedom, stiffness, damping) in &self.holds {
                let k = freedom.index();
                let mut j = Vector6::zeros();
                j[k] = 1.0;
                let pull = stiffness * way[k] + damping * velocity[k];
                *matrix += j * j.transpose() * (dt * damping + dt * dt * stiffness);
                *force -= j * (pull + dt * stiffness * velocity[k]);
            }
        }
        for line in &self.lines {
            if let Some(pull) = self.pull(line, &turn, &shift, velocity) {
                *matrix += pull.damping * dt + pull.stiffness * (dt * dt);
                *force += pull.force - pull.stiffness * velocity * dt;
            }
        }
    }

    fn pull(
        &self,
        line: &Mooring,
        turn: &Matrix3<f64>,
        shift: &Vector3<f64>,
        velocity: &Vector6<f64>,
    ) -> Option<Pull> {
        let arm = turn * (line.to - self.centre);
        line.pull(self.centre + shift + arm, arm, velocity)
    }

    /// Force of every line on the body, and its tension at the anchor, in a state.
    pub fn pulls<const D: usize>(&self, now: &RigidState<D>) -> Vec<(Vect<D>, f64)> {
        let (turn, shift) = (rotation(now), padded(&now.pose.translation));
        let velocity = six(padded(now.velocity.as_slice()), now.angular_velocity.into());
        let of_line = |line| {
            let pull = self.pull(line, &turn, &shift, &velocity);
            pull.map_or((Vect::zeros(), 0.0), |pull| {
                (Vect::from_fn(|k, _| pull.force[k]), pull.anchor)
            })
        };
        self.lines.iter().map(of_line).collect()
    }

    /// The mean angular velocity over a step at whose end the angular momentum is L, and that at its end: the inertia
    /// turns with the body, and without a moment L stays to rounding.
    fn tumbled(
        &self,
        turn: &Matrix3<f64>,
        momentum: Vector3<f64>,
        dt: f64,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let spin = |turn: Matrix3<f64>| {
            let factors = self.inertia_at(&turn).0.cholesky();
            factors.map_or_else(|| Vector3::repeat(f64::NAN), |c| c.solve(&momentum))
        };
        let turned = |omega: Vector3<f64>, dt: f64| Rotation3::new(omega * dt).into_inner() * turn;
        let middle = spin(turned(spin(*turn), 0.5 * dt));
        (middle, spin(turned(middle, dt)))
    }
}

#[cfg(test)]
mod tests;

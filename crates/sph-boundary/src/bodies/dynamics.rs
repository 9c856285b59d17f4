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
        let inertia = turn * self.inertia * turn.transpose();
        let mass = blocks(Matrix3::identity() * self.mass, inertia);
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
        let flies = load.is_weight() && self.holds.is_empty() && self.lines.is_empty();
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
        let felt = six(
            padded(now.acceleration.as_slice()),
            now.angular_acceleration.into(),
        );
        let whole = six(along, (omega_next - omega) / dt);
        let frame = blocks(turn, turn);
        let layer = frame * self.layer * frame.transpose();
        let change = solve(mass + layer, mass * (whole - felt), self.free);
        let (along, about) = parts(&(felt + change));
        state.acceleration = Vect::from_fn(|k, _| along[k]);
        state.angular_acceleration = about.into();
        state
    }

    /// Force and moment about the centre.
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
        let mut add = |j: &Vector6<f64>, pull: f64, stiffness: f64, damping: f64, rate: f64| {
            *matrix += j * j.transpose() * (dt * damping + dt * dt * stiffness);
            *force -= j * (pull + dt * stiffness * rate);
        };
        if !self.holds.is_empty() {
            let rotation = Rotation3::from_matrix_unchecked(turn);
            let angle = UnitQuaternion::from_rotation_matrix(&rotation).scaled_axis();
            let way = six(shift, angle);
            for (freedom, stiffness, damping) in &self.holds {
                let k = freedom.index();
                let mut j = Vector6::zeros();
                j[k] = 1.0;
                let pull = stiffness * way[k] + damping * velocity[k];
                add(&j, pull, *stiffness, *damping, velocity[k]);
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
    pub fn pulls<const D: usize>(
        &self,
        now: &RigidState<D>,
    ) -> impl Iterator<Item = (Vect<D>, f64)> {
        let (turn, shift) = (rotation(now), padded(&now.pose.translation));
        let velocity = six(padded(now.velocity.as_slice()), now.angular_velocity.into());
        self.lines.iter().map(move |line| {
            let pull = self.pull(line, &turn, &shift, &velocity);
            pull.map_or((Vect::zeros(), 0.0), |pull| {
                (Vect::from_fn(|k, _| pull.force[k]), pull.anchor)
            })
        })
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
            let inertia = turn * self.inertia * turn.transpose();
            let factors = inertia.cholesky();
            factors.map_or_else(|| Vector3::repeat(f64::NAN), |c| c.solve(&momentum))
        };
        let turned = |omega: Vector3<f64>, dt: f64| Rotation3::new(omega * dt).into_inner() * turn;
        let middle = spin(turned(spin(*turn), 0.5 * dt));
        (middle, spin(turned(middle, dt)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::catenary::Catenary;

    fn body(free: [bool; 6]) -> Dynamics {
        Dynamics {
            mass: 2.0,
            centre: Vector3::new(0.1, 0.2, 0.3),
            inertia: Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5)),
            layer: Matrix6::zeros(),
            free,
            holds: Vec::new(),
            lines: Vec::new(),
            start: 0.0,
            prescribed: Vec::new(),
        }
    }

    fn at_rest<const D: usize>(body: &Dynamics) -> RigidState<D> {
        RigidState {
            centre: std::array::from_fn(|k| body.centre[k]),
            ..RigidState::default()
        }
    }

    /// About the middle axis the turn is unstable, so that the body tumbles over and over: ten times here.
    #[test]
    fn a_body_that_tumbles_keeps_its_angular_momentum_and_its_energy() {
        let body = body([true; 6]);
        let mut state = at_rest::<3>(&body);
        state.angular_velocity = [0.01, 5.0, 0.02];
        let of = |state: &RigidState<3>| {
            let (turn, omega) = (rotation(state), Vector3::from(state.angular_velocity));
            let momentum = turn * body.inertia * turn.transpose() * omega;
            (momentum, 0.5 * momentum.dot(&omega), turn)
        };
        let (momentum, energy, _) = of(&state);
        let (mut over, mut before) = (0, 1.0);
        for _ in 0..60_000 {
            state = body.next(&state, &Load::of_gravity(Vect::zeros()), 0.0, 1e-3);
            let up = of(&state).2.column(1).y;
            over += u32::from(up * before < 0.0);
            before = up;
        }
        let (now, left, turn) = of(&state);
        assert!(over >= 5, "{over} times");
        let lost = (now - momentum).norm() / momentum.norm();
        assert!(lost < 1e-11, "angular momentum: {lost:e}");
        let drift = (left / energy - 1.0).abs();
        assert!(drift < 1e-5, "energy: {drift:e}");
        let skew = (turn.transpose() * turn - Matrix3::identity()).norm();
        assert!(skew < 1e-10, "R is a rotation to {skew:e}");
    }

    #[test]
    fn locked_directions_rest_and_free_ones_follow_newton_and_euler() {
        let body = body([true, false, false, false, false, true]);
        let load = Load::<2> {
            force: Vect::<2>::new(3.0, 4.0),
            moment: [0.0, 0.0, 7.0],
            ..Load::of_gravity(Vect::<2>::new(1.0, -9.81))
        };
        let state = body.next(&at_rest(&body), &load, 0.0, 0.1);
        assert!((state.velocity[0] - 0.1 * (1.5 + 1.0)).abs() < 1e-15);
        assert_eq!(state.velocity[1], 0.0);
        // 7 − (0.1·4 − 0.2·3) about the centre.
        let about = 0.1 * (7.0 - 0.1 * 4.0 + 0.2 * 3.0) / 2.5;
        assert!((state.angular_velocity[2] - about).abs() < 1e-15);
        let early = Dynamics {
            start: 0.05,
            ..body.clone()
        };
        assert_eq!(early.next(&at_rest(&body), &load, 0.0, 0.1), at_rest(&body));
    }

    /// Free, held at what it has, driven up and free again: with F/m = 2 m/s² and steps that divide the times.
    #[test]
    fn a_body_is_free_and_prescribed_in_turns() {
        let turns = |from: f64, to: f64, course: Vec<Vec<f64>>| Prescribed { from, to, course };
        let up = vec![vec![2.0, 0.0, 1.0, 0.0], vec![3.0, 0.0, 3.0, 0.0]];
        let body = Dynamics {
            prescribed: vec![turns(1.0, 2.0, Vec::new()), turns(2.0, 3.0, up)],
            ..body([true; 6])
        };
        let load = Load::<2>::of_gravity(Vect::<2>::new(2.0, 0.0));
        let (dt, mut state) = (1.0 / 64.0, at_rest::<2>(&body));
        let mut seen = Vec::new();
        for step in 0..4 * 64 {
            state = body.next(&state, &load, f64::from(step) * dt, dt);
            if step % 64 == 63 {
                seen.push([state.velocity[0], state.velocity[1], state.acceleration[1]]);
            }
        }
        let expected = [
            [2.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 3.0, 2.0],
            [2.0, 3.0, 0.0],
        ];
        for (seen, expected) in seen.into_iter().zip(expected) {
            let off = seen
                .into_iter()
                .zip(expected)
                .map(|(a, b): (f64, f64)| (a - b).abs());
            assert!(
                off.fold(0.0, f64::max) < 1e-12,
                "{seen:?}, not {expected:?}"
            );
        }
        // Half a step beyond the mean of 1 and 3 m/s over the second that is driven, then a second at 3 m/s.
        let way = 2.0 + dt + 3.0;
        assert!((state.pose.translation[1] - way).abs() < 1e-12);
    }

    /// m = 2, k = 8: a period of π s; with steps of a tenth of it, and with steps of ten of it, it stays bounded.
    #[test]
    fn springs_have_their_period_and_never_bound_the_step() {
        let held = Dynamics {
            holds: vec![(Freedom::X, 8.0, 0.0)],
            ..body([true; 6])
        };
        let none = Load::<2>::of_gravity(Vect::zeros());
        let mut state = at_rest(&held);
        state.pose.translation[0] = 0.1;
        let steps = 20_000;
        let dt = std::f64::consts::PI / f64::from(steps);
        for _ in 0..steps {
            state = held.next(&state, &none, 0.0, dt);
        }
        let [x, _] = state.pose.translation;
        assert!((x / 0.1 - 1.0).abs() < 1e-3, "after a period at {x}");
        for _ in 0..100 {
            state = held.next(&state, &none, 0.0, 30.0);
        }
        assert!(state.pose.translation[0].abs() < 0.1);
    }

    /// F = F₀ − A ã, the force of a fluid at rest with the acceleration ã in its wall pressures. With the layer A* ≥ A
    /// the body comes to F₀/(M + A) whatever its mass; without, every body lighter than A is thrown about.
    #[test]
    fn no_body_is_too_light_for_the_layer_and_without_it_those_below_the_added_mass_are() {
        let swings = |mass: f64, added: f64, layer: f64| {
            let body = Dynamics {
                mass,
                layer: Matrix6::identity() * layer,
                ..body([true, true, false, false, false, false])
            };
            let mut state = at_rest::<2>(&body);
            for _ in 0..20_000 {
                let felt = state.acceleration[0];
                let mut load = Load::of_gravity(Vect::zeros());
                load.force[0] = 1.0 - added * felt;
                state = body.next(&state, &load, 0.0, 1e-4);
            }
            state.acceleration[0] * (mass + added)
        };
        for mass in [100.0, 1.0, 0.1, 0.01] {
            for added in [0.0, 0.3, 1.0] {
                let end = swings(mass, added, 1.0);
                assert!((end - 1.0).abs() < 1e-3, "M = {mass}, A = {added}: {end}");
            }
        }
        assert!((swings(1.1, 1.0, 0.0) - 1.0).abs() < 1e-3);
        assert!(!swings(0.9, 1.0, 0.0).is_finite() || swings(0.9, 1.0, 0.0).abs() > 10.0);
    }

    /// m = 2 on two equal chains, one to either side: its period is 2π √(m/2k), k the horizontal stiffness of one; with steps
    /// of ten periods it stays bounded.
    #[test]
    fn chains_have_their_period_and_never_bound_the_step() {
        let catenary = Catenary {
            weight: 30.0,
            axial: 2e4,
            length: 2.0,
            bed: true,
        };
        let centre = Vector3::new(0.1, 0.2, 0.0);
        let chain = |way: f64| {
            let from = centre + Vector3::new(way, -0.6, 0.0);
            Mooring::chain(from, centre, catenary, Vector3::y())
        };
        let moored = Dynamics {
            centre,
            lines: vec![chain(-1.8), chain(1.8)],
            ..body([true, false, false, false, false, false])
        };
        let stiffness = 2.0 * catenary.hang(1.8, 0.6).stiffness[0][0];
        let period = std::f64::consts::TAU * (moored.mass / stiffness).sqrt();
        let none = Load::<2>::of_gravity(Vect::zeros());
        let mut state = at_rest(&moored);
        let way = 1e-4;
        state.pose.translation[0] = way;
        let steps = 20_000;
        for _ in 0..steps {
            state = moored.next(&state, &none, 0.0, period / f64::from(steps));
        }
        let [x, _] = state.pose.translation;
        // The stiffness changes by a thousandth over the way.
        assert!((x / way - 1.0).abs() < 2e-3, "after a period at {x}");
        state.pose.translation[0] = 0.1;
        for _ in 0..200 {
            state = moored.next(&state, &none, 0.0, 10.0 * period);
            let [x, _] = state.pose.translation;
            assert!(x.abs() <= 0.1, "at {x}");
        }
    }
}

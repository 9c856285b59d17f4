//! Sums of forces, and the leap-frog.

use rayon::prelude::*;

use crate::grains::{Control, GrainError, GrainSystem, INERTIA, State, Vector, Wall, sign, wrap};
use crate::require;

/// Grains per task at least.
const TASK: usize = 512;

impl GrainSystem {
    /// Every grain sums its contacts in the order of their numbers.
    pub(crate) fn gather(&mut self) {
        let State { grains, table, .. } = &mut self.state;
        let table = &*table;
        let sums = (&mut grains.contact_force, &mut grains.contact_torque);
        sums.into_par_iter()
            .with_min_len(TASK)
            .enumerate()
            .for_each(|(grain, (force, torque))| {
                (*force, *torque) = (Vector::zeros(), Vector::zeros());
                for (slot, side) in table.slots_of(grain).filter(|(slot, _)| slot.active) {
                    *force += if side == 0 { slot.force } else { -slot.force };
                    *torque += slot.torque[side];
                }
            });
    }

    /// v += F/m Δt, x += v Δt, and the same for the rotation, with the damping of Catalano 2012, Eq. (2.15),
    /// whose sign is taken from the velocity in the middle, v + ½ F/m Δt.
    pub(crate) fn advance_grains(&mut self, step: f64) {
        let (g, period) = (&mut self.state.grains, &self.state.period);
        let (gravity, damping) = (self.state.gravity, self.state.damping);
        let damped = |load: Vector, velocity: Vector, inertia: f64| {
            load.zip_map(&velocity, |load, velocity| {
                let middle = velocity + 0.5 * step * load / inertia;
                load - damping * load.abs() * sign(middle)
            })
        };
        let moving = (&mut g.position, &mut g.velocity);
        let turning = (&mut g.spin, &mut g.orientation);
        let given = (&g.mass, &g.radius, &g.held);
        let forces = (&g.contact_force, &g.external_force);
        let torques = (&g.contact_torque, &g.external_torque);
        (moving, turning)
            .into_par_iter()
            .zip((given, forces, torques))
            .with_min_len(TASK)
            .for_each(|((moving, turning), (given, forces, torques))| {
                let ((x, v), (spin, orientation)) = (moving, turning);
                let (&mass, &radius, &held) = given;
                if !held {
                    let inertia = INERTIA * mass * radius * radius;
                    let force = forces.0 + forces.1 + gravity * mass;
                    let torque = torques.0 + torques.1;
                    *v += damped(force, *v, mass) * (step / mass);
                    *spin += damped(torque, *spin, inertia) * (step / inertia);
                }
                *x += *v * step;
                wrap(x, period);
                turn(orientation, &(*spin * step));
            });
    }

    /// Controls set the velocities of their walls.
    pub(crate) fn steer_walls(&mut self, step: f64) -> Result<(), GrainError> {
        for number in 0..self.walls.len() {
            let wall = &self.walls[number];
            let (mut area, mut height) = (0.0, 0.0);
            match wall.control {
                Control::Velocity | Control::Volume => continue,
                Control::StrainRate { .. } => height = self.height(number)?,
                Control::Stress { .. } | Control::Piston { .. } => area = self.wall_area(number)?,
            }
            let damping = self.damping;
            self.walls[number].steer(step, area, height, damping);
        }
        self.keep_volume()
    }

    /// Velocities of walls that keep the volume of the box.
    fn keep_volume(&mut self) -> Result<(), GrainError> {
        let keeps = |wall: &Wall| wall.control == Control::Volume;
        if !self.walls.iter().any(keeps) {
            return Ok(());
        }
        let (mut swept, mut room) = (0.0, 0.0);
        for (number, wall) in self.walls.iter().enumerate() {
            let area = self.wall_area(number)?;
            match keeps(wall) {
                true => room += area,
                false => swept += area * wall.velocity.dot(&wall.normal),
            }
        }
        for wall in self.walls.iter_mut().filter(|wall| keeps(wall)) {
            let along = wall.velocity.dot(&wall.normal);
            wall.velocity -= wall.normal * (along + swept / room);
        }
        Ok(())
    }

    /// Moves the grains by their velocities for a time (s) without forces, as a flow without contacts needs it.
    /// Walls, meshes and time stay. Contacts are found again at the next evaluation.
    ///
    /// # Errors
    /// A time that is not positive and finite.
    pub fn drift(&mut self, step: f64) -> Result<(), GrainError> {
        require("the step is", step, "positive", step > 0.0)?;
        let State { grains, period, .. } = &mut self.state;
        for (x, v) in grains.position.iter_mut().zip(&grains.velocity) {
            *x += v * step;
            wrap(x, period);
        }
        self.last_step += step;
        Ok(())
    }
}

/// Turns a quaternion by a small rotation: Cayley's form, scaled back to length 1.
fn turn(q: &mut [f64; 4], rotation: &Vector) {
    let [w, x, y, z] = *q;
    let half = rotation * 0.5;
    let vector = Vector::new(x, y, z);
    let scalar = w - half.dot(&vector);
    let vector = vector + half * w + half.cross(&vector);
    let length = (scalar * scalar + vector.norm_squared()).sqrt();
    *q = [scalar, vector.x, vector.y, vector.z].map(|c| c / length);
}

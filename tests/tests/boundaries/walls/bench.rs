//! Flows of scenes given as text.

use sph_core::{StepLimit, Vect, fields};
use sph_neighbours::WallForce;
use sph_particles::setup::Assembled;
use sph_tests::{evaluated, scene, step};

/// A flow that is stepped by hand.
pub struct Flowing<const D: usize>(pub Assembled<D>);

/// The flow of a scene with changes, evaluated at its start.
pub fn flowing<const D: usize>(text: &str, changes: &[&str]) -> Flowing<D> {
    Flowing(evaluated(&scene(text, changes)))
}

impl<const D: usize> Flowing<D> {
    /// One step of four fifths of the least limit, evaluated.
    pub fn step(&mut self) -> f64 {
        let parts = &mut self.0;
        let limits = parts.flow.step_limits().expect("limits");
        let dt = 0.8 * StepLimit::least(&limits).expect("a limit").dt;
        step(parts, dt);
        dt
    }

    pub fn steps(&mut self, count: usize) {
        for _ in 0..count {
            self.step();
        }
    }

    pub fn until(&mut self, time: f64) {
        while self.0.flow.world.time < time {
            self.step();
        }
    }

    pub fn positions(&self) -> &[Vect<D>] {
        self.0.flow.world.free.get(fields::POSITION).unwrap()
    }

    pub fn velocities(&self) -> &[Vect<D>] {
        self.0.flow.world.free.get(fields::VELOCITY).unwrap()
    }

    pub fn pressures(&self) -> &[f64] {
        self.0.flow.world.free.get(fields::PRESSURE).unwrap()
    }

    fn masses(&self) -> &[f64] {
        self.0.flow.world.free.get(fields::MASS).unwrap()
    }

    pub fn mass(&self) -> f64 {
        self.masses().iter().sum()
    }

    /// How many particles are behind a wall.
    pub fn escaped(&self) -> usize {
        let flow = &self.0.flow;
        flow.escaped_from(flow.walls.as_deref()).expect("a count")
    }

    /// Σ m a and Σ m |a|, N.
    pub fn momentum_rate(&self) -> (Vect<D>, f64) {
        let a = self.0.flow.world.free.get(fields::ACCELERATION).unwrap();
        let all = || a.iter().zip(self.masses());
        let sum = all().map(|(a, m)| a * *m).sum();
        (sum, all().map(|(a, m)| a.norm() * m).sum())
    }

    /// Σ m u, kg m/s.
    pub fn momentum(&self) -> Vect<D> {
        sph_tests::momentum(&self.0).0
    }

    /// Forces of the fluid on the walls with their names.
    pub fn forces(&mut self) -> Vec<(String, WallForce<D>)> {
        self.0.flow.measure_wall_forces(|_| true).expect("forces");
        let walls = &self.0.flow.world.walls;
        let all = walls.names.iter().cloned();
        all.zip(walls.forces.iter().copied()).collect()
    }

    /// Force of the fluid on one wall.
    pub fn force(&mut self, wall: &str) -> WallForce<D> {
        let mut all = self.forces().into_iter();
        all.find(|(name, _)| name == wall).expect("the wall").1
    }

    /// Weight and driving force of all the fluid, N.
    pub fn weight(&self) -> Vect<D> {
        let world = &self.0.flow.world;
        (world.gravity + world.driving) * self.mass()
    }
}

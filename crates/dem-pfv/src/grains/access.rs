//! Readings of a system of grains, and its changes from outside.

use crate::grains::{ContactLaw, GrainError, GrainSystem, Grains, Mesh, Vector, Wall};

impl GrainSystem {
    /// The grains.
    pub fn grains(&self) -> &Grains {
        &self.grains
    }

    /// The walls.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// The walls, to steer them.
    pub fn walls_mut(&mut self) -> &mut [Wall] {
        &mut self.walls
    }

    /// The meshes.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// Sets how a mesh moves: velocity (m/s) and angular velocity about its centre (rad/s).
    ///
    /// # Errors
    /// If there is no such mesh or a number is not finite.
    pub fn steer_mesh(
        &mut self,
        mesh: usize,
        velocity: Vector,
        spin: Vector,
    ) -> Result<(), GrainError> {
        let problem = "there is no such mesh".to_string();
        let none = GrainError::BadMesh {
            mesh,
            triangle: 0,
            problem,
        };
        let moved = self.meshes.get_mut(mesh).ok_or(none)?;
        (moved.velocity, moved.spin) = (velocity, spin);
        moved.check(mesh)
    }

    /// Axes along which the box repeats itself.
    pub fn period(&self) -> &crate::grains::Period {
        &self.period
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Number of times that the lists of neighbours were made.
    pub fn renewals(&self) -> u64 {
        self.renewals
    }

    /// Sets the clock to zero, as when a preparation is over. Nothing else changes.
    pub fn restart_clock(&mut self) {
        (self.time, self.steps, self.limit_due) = (0.0, 0, 0);
    }

    /// Gravity, m/s².
    pub fn gravity(&self) -> Vector {
        self.gravity
    }

    /// Sets gravity, m/s².
    pub fn set_gravity(&mut self, gravity: Vector) {
        self.gravity = gravity;
    }

    /// Sets the coefficient of non-viscous damping; zero where a fluid damps.
    ///
    /// # Errors
    /// Unless it is at least 0 and below 1.
    pub fn set_damping(&mut self, damping: f64) -> Result<(), GrainError> {
        let fine = (0.0..1.0).contains(&damping);
        crate::grains::system::number("damping", damping, "at least 0 and below 1", fine)?;
        self.damping = damping;
        Ok(())
    }

    /// Replaces a contact law, as when the friction of the preparation gives way to that of the test. What
    /// contacts remember stays.
    ///
    /// # Errors
    /// Parameters out of range; no law of that number.
    pub fn set_law(
        &mut self,
        number: usize,
        law: impl ContactLaw + 'static,
    ) -> Result<(), GrainError> {
        self.replace_law(number, Box::new(law))
    }

    /// The same for a law that was found by its name ([`crate::grains::contact_law`]).
    ///
    /// # Errors
    /// As [`GrainSystem::set_law`].
    pub fn replace_law(
        &mut self,
        number: usize,
        law: Box<dyn ContactLaw>,
    ) -> Result<(), GrainError> {
        law.check()?;
        let laws = self.laws.len();
        let slot = self.laws.get_mut(number).ok_or(GrainError::NoLaw {
            what: "grain",
            number: 0,
            law: number,
            laws,
        })?;
        *slot = law;
        self.limit = None;
        self.check()
    }

    /// Centres, m, to move grains without forces. The next evaluation finds their contacts.
    pub fn positions_mut(&mut self) -> &mut [Vector] {
        &mut self.grains.position
    }

    /// Velocities, m/s.
    pub fn velocities_mut(&mut self) -> &mut [Vector] {
        &mut self.grains.velocity
    }

    /// Angular velocities, rad/s.
    pub fn spins_mut(&mut self) -> &mut [Vector] {
        &mut self.grains.spin
    }

    /// Grains that keep their velocity whatever acts on them.
    pub fn held_mut(&mut self) -> &mut [bool] {
        &mut self.grains.held
    }

    /// Forces from outside, N, one per grain: those of a fluid. They stay until they are changed.
    pub fn external_forces_mut(&mut self) -> &mut [Vector] {
        &mut self.grains.external_force
    }

    /// Moments from outside, N m, one per grain.
    pub fn external_torques_mut(&mut self) -> &mut [Vector] {
        &mut self.grains.external_torque
    }

    /// Multiplies all radii; masses and moments of inertia follow with their third and fifth power.
    ///
    /// # Errors
    /// A factor that is not positive and finite; a period that becomes too short.
    pub fn scale_radii(&mut self, factor: f64) -> Result<(), GrainError> {
        crate::grains::system::number("factor of the radii", factor, "positive", factor > 0.0)?;
        for radius in &mut self.grains.radius {
            *radius *= factor;
        }
        self.grains.weigh();
        let largest = self.grains.radius.iter().copied().fold(0.0, f64::max);
        crate::grains::space::check(&self.period, 2.0 * largest + self.skin)
    }
}

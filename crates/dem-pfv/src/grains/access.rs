//! Readings of a system of grains, and its changes from outside.

use crate::grains::{ContactLaw, GrainError, GrainSystem, Vector};

impl GrainSystem {
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

    /// Sets the clock to zero, as when a preparation is over. Nothing else changes.
    pub fn restart_clock(&mut self) {
        (self.time, self.steps, self.limit_due) = (0.0, 0, 0);
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

    /// Replaces a contact law, as when the friction of the preparation gives way to that of the test. The memory of
    /// contacts stays.
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

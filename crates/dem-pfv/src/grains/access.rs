//! Readings of a system of grains, and its changes from outside.

use crate::grains::system::check_damping;
use crate::grains::{ContactLaw, GrainError, GrainSystem, Vector};
use crate::require;

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
        let none = || GrainError::BadMesh(mesh, 0, "there is no such mesh".into());
        let moved = self.meshes.get_mut(mesh).ok_or_else(none)?;
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
        check_damping(damping)?;
        self.damping = damping;
        Ok(())
    }

    /// Replaces a contact law, as when the friction of the preparation gives way to that of the test. The memory of
    /// contacts stays.
    ///
    /// # Errors
    /// Parameters out of range; no law of that number.
    pub fn set_law(&mut self, number: usize, law: Box<dyn ContactLaw>) -> Result<(), GrainError> {
        law.check()?;
        let laws = self.laws.len();
        let slot = self.laws.get_mut(number);
        *slot.ok_or(GrainError::NoLaw("grain", 0, number, laws))? = law;
        self.limit = None;
        self.check()
    }

    /// Multiplies all radii; masses and moments of inertia follow with their third and fifth power.
    ///
    /// # Errors
    /// A factor that is not positive and finite; a period that becomes too short.
    pub fn scale_radii(&mut self, factor: f64) -> Result<(), GrainError> {
        require(
            "the factor of the radii is",
            factor,
            "positive",
            factor > 0.0,
        )?;
        for radius in &mut self.grains.radius {
            *radius *= factor;
        }
        self.grains.weigh();
        let largest = self.grains.radius.iter().copied().fold(0.0, f64::max);
        crate::grains::space::check(&self.period, 2.0 * largest + self.skin)
    }
}

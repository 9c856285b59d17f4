//! Change of densities by the flux through faces.

use rayon::prelude::*;
use sph_core::{StepError, fields};
use sph_neighbours::World;

use crate::faces::{CLOSED, Faces};

sph_core::fields! {
    /// ρ Σ u_s·∇γ_as over open elements, as it was in the last step.
    pub OPEN_FLUX: Scalar = "open_flux", "kg/(m³ s)", "mass that open faces let into the support in the last step";
}

impl<const D: usize> Faces<D> {
    /// Advances the density constants by the fluid that passes in `dt` seconds.
    ///
    /// γ_a dρ_a/dt = m_a Σ_b θ_b u_ab·∇w_ab − ρ_a Σ_s u_as·∇γ_as with the velocity of the fluid at the face for u_s and
    /// u_v: a uniform flow changes nothing. With ρ_a = (K_a + m_a Σ w)/γ_a over particles alone,
    ///
    ///   dK_a/dt = ρ_a Σ_s u_s·∇γ_as + m_a Σ_v θ_v (u_a − u_v)·∇w_av.
    ///
    /// Where a velocity is not imposed, u_s is that of the row in front of the element, changed by the difference of
    /// the law from the mean before the face: the mean over the support has not the profile of the flow.
    ///
    /// The first sum is what γ gains as the particle goes; it is advanced to second order (Adams & Bashforth), since
    /// the error of a step stays.
    pub fn advance_densities(&self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
        let mut last = world.free.take(OPEN_FLUX)?;
        let free = &world.free;
        let (position, velocity) = (free.get(fields::POSITION)?, free.get(fields::VELOCITY)?);
        let (mass, density) = (free.get(fields::MASS)?, free.get(fields::DENSITY)?);
        // Of the step before: 0 where there was none.
        let ahead = match self.memory.dt > 0.0 {
            true => 0.5 * dt / self.memory.dt,
            false => 0.0,
        };
        let first = world.walls.points.corners;
        let limit = world.kernel.support_radius().powi(2);
        let passes: Vec<_> = (0..self.elements.len()).map(|k| self.through(k)).collect();
        let one = |i: usize, constant: &mut f64, last: &mut f64| {
            let contacts = world.walls.contacts.of_particle(i);
            let ports = world.lists.wall.candidates(i);
            if contacts.is_empty() && ports.is_empty() && *last == 0.0 {
                return;
            }
            let mut through = 0.0;
            for contact in contacts {
                let k = self.open[contact.element as usize];
                if k != CLOSED {
                    through += passes[k as usize].dot(&contact.gradient);
                }
            }
            let mut beside = 0.0;
            for &v in ports {
                let k = v as usize - first;
                let apart = position[i] - self.places[k].centre;
                let apart = world.domain.nearest_image(apart);
                let r2 = apart.norm_squared();
                if r2 >= limit {
                    continue;
                }
                let factor = world.kernel.at(r2.sqrt()).1;
                let parting = velocity[i] - passes[k];
                beside += self.lacking[k] * parting.dot(&apart) * factor;
            }
            let now = density[i] * through;
            // Nothing yet in a particle's first step.
            let change = if *last == 0.0 { 0.0 } else { now - *last };
            *constant += dt * (now + ahead * change + mass[i] * beside);
            *last = now;
        };
        let all = constant.par_iter_mut().zip(&mut last).enumerate();
        all.with_min_len(1024)
            .for_each(|(i, (constant, last))| one(i, constant, last));
        world.free.put(OPEN_FLUX, last)?;
        Ok(world.free.put(fields::DENSITY_CONSTANT, constant)?)
    }
}

//! Growth of particles that take up fluid.

use sph_core::{StepError, fields};
use sph_neighbours::World;

use super::columns::{GRAIN_VOLUME, PACKING};
use super::surface::Outlet;
use crate::seepage::{Exchange, Gains, Phase};

pub(crate) struct Swelling {
    /// ρ_w, kg/m³.
    pub density: f64,
    /// The phase that gives and takes; none if the fluid is left out.
    pub fluid: Option<Phase>,
    pub exchange: Exchange,
}

impl Swelling {
    /// Lets the particles of the soil, whose packing is that of after, grow by volumes, m^d, and the fluid give what comes in through the outlets, m^d.
    ///
    /// m' = m + ρ_w dV. The density follows the volume at which the particle has no pressure: ρ' = ρ V₀'/V₀,
    /// V₀ = G/φ.
    pub fn grow<const D: usize>(
        &self,
        world: &mut World<D>,
        growth: &[f64],
        outlets: &[Outlet],
        outflow: &[f64],
        dt: f64,
    ) -> Result<(), StepError> {
        let mut mass = world.free.take(fields::MASS)?;
        let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
        let (packing, grains, density) =
            world.free.all((PACKING, GRAIN_VOLUME, fields::DENSITY))?;
        let gamma = world.sum_renormalisation();
        for (i, &grown) in growth.iter().enumerate() {
            if grown == 0.0 {
                continue;
            }
            let sum = gamma.map_or(1.0, |g| g[i]) * density[i];
            let heavier = 1.0 + self.density * grown / mass[i];
            let volume = grains[i] / packing[i];
            constant[i] = sum * volume / (volume - grown) - heavier * (sum - constant[i]);
            mass[i] *= heavier;
        }
        world.free.put(fields::MASS, mass)?;
        world.free.put(fields::DENSITY_CONSTANT, constant)?;
        let Some(phase) = &self.fluid else {
            return Ok(());
        };
        let velocity = world.free.get(fields::VELOCITY)?;
        let mut gains = Gains::none(velocity.len());
        for (outlet, outflow) in outlets.iter().zip(outflow) {
            for &(j, share) in &outlet.fluid {
                let gain = self.density * outflow * share;
                gains.mass[j as usize] += gain;
                gains.momentum[j as usize] += velocity[j as usize] * gain;
            }
        }
        gains.apply(world)?;
        self.exchange.even_out(world, phase, dt)?;
        self.exchange.guard(world, phase)
    }
}

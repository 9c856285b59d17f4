//! Weight of a soil that the solve bears beyond its strength, where stresses are those of the end of the step.

use serde::{Deserialize, Serialize};
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

/// Mean share of the weight above which a result is not right: a fall with 0.95 g has a tenth less kinetic energy.
const MUCH: f64 = 0.05;

/// Mean share of the weight of a soil that the solve bears beyond the strength of the law.
///
/// The law dissipates ∫(η + s𝒢Δt)γ̇² dV in what is solved for, and its stress is cut to τ_y. The operator sums over pairs, and resists as well what is
/// no shear: changes of volume with 5/3 of this viscosity, and motions of neighbours that no gradient sees. None of that is cut, so that a stiff
/// soil in long steps is held by what is no friction. With the power P = Σ m(u* − uⁿ⁺¹)·uⁿ⁺¹/Δt that the solve takes, and P_law of the law,
///
/// held = (1 − P_law/P) Σ m|u* − uⁿ⁺¹| / (Δt |g| Σ m),
///
/// over all particles with a solid part, and its mean over time. At rest the stress of the step before bears the soil, and nothing is left to the solve. Ours.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct SolveArrest {
    /// Mean over time.
    pub mean: f64,
    /// Time over which the mean is taken, s.
    pub seconds: f64,
}

impl SolveArrest {
    /// Adds a kick over `dt` from u* to the velocity of now, with the viscosity of the law alone.
    ///
    /// # Errors
    /// If a column is missing.
    pub(crate) fn add<const D: usize>(
        &mut self,
        world: &World<D>,
        ahead: &[Vect<D>],
        dt: f64,
    ) -> Result<(), StepError> {
        let weight = (world.gravity + world.driving).norm();
        if weight <= 0.0 || dt <= 0.0 {
            return Ok(());
        }
        let free = &world.free;
        let (mass, volume) = (free.get(fields::MASS)?, free.get(fields::VOLUME)?);
        let velocity = free.get(fields::VELOCITY)?;
        let viscosity = free.get(fields::VISCOSITY)?;
        let stiffness = free.get(fields::ELASTIC_STIFFNESS)?;
        let rate = free.get(fields::STRAIN_RATE)?;
        let [all, taken, power, lawful] = world.sums(|i| match stiffness[i] > 0.0 {
            false => [0.0; 4],
            true => {
                let change = (ahead[i] - velocity[i]) * (mass[i] / dt);
                let eta = viscosity[i] + stiffness[i] * world.dt;
                let lawful = volume[i] * eta * rate[i] * rate[i];
                let power = change.dot(&velocity[i]);
                [mass[i] * weight, change.norm(), power, lawful]
            }
        })?;
        let held = match all > 0.0 && power > lawful {
            true => (1.0 - lawful / power) * taken / all,
            false => 0.0,
        };
        self.seconds += dt;
        self.mean += (held - self.mean) * dt / self.seconds;
        Ok(())
    }

    /// A warning about it.
    pub(crate) fn warning(&self) -> Option<String> {
        (self.mean > MUCH).then(|| {
            format!(
                "what is solved for held {:.0} % of the soil's weight beyond its strength, in the mean over time: with \
                 `elastic-force.divergence.implicit = true` stiff soils that should yield are delayed or stand; take \
                 `elastic-force.divergence.sub_steps = true` instead, with [integrator.symplectic-euler]",
                100.0 * self.mean
            )
        })
    }

    /// Reason that a finished run has no result, if too much was held.
    pub(crate) fn verdict(&self) -> Option<StepError> {
        let told = self.warning()?;
        Some(StepError::stage(
            "elasticity at the end of the step",
            format!("{told}; or allow it with `numerics.delayed_yield = true`"),
        ))
    }
}

//! The step that elastic waves allow.

use sph_contribution::Limiter;
use sph_core::{StepError, StepLimit};
use sph_neighbours::World;

/// Δt ≤ C h / √(c₀² + k𝒢/ρ₀): pressure waves in an elastic material, k being that of its
/// [force](crate::stress::ElasticForce::stiffness), 4/3 for a divergence. Ours; the thesis has none.
pub struct ElasticWaveLimit {
    /// C.
    pub courant: f64,
    /// Largest √(c₀² + k𝒢/ρ₀) over the phases with an elastic part, m/s.
    pub speed: f64,
    /// k.
    pub stiffness: f64,
}

impl ElasticWaveLimit {
    /// The longest sub-step, s: 0.8 h over the speed, about half of the 2/max k̂ at which nested differences k̂ on a lattice
    /// become unstable (1.73 to 1.76 h for `wendland-c2` at h = 2δr).
    pub fn longest_sub_step<const D: usize>(&self, world: &World<D>) -> f64 {
        0.8 * world.kernel.smoothing_length() / self.speed
    }

    /// The longest step, s.
    fn longest<const D: usize>(&self, world: &World<D>) -> f64 {
        self.courant * world.kernel.smoothing_length() / self.speed
    }
}

impl<const D: usize> Limiter<D> for ElasticWaveLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        Ok(StepLimit::new("elastic wave", self.longest(world)))
    }
    fn remedy(&self) -> Option<String> {
        let away = "`elastic-force.divergence.sub_steps = true` with [integrator.symplectic-euler] takes this bound away: \
                    the elastic force then has steps of its own within that of the flow";
        Some(away.into())
    }
    fn formula(&self) -> String {
        format!(
            "elastic wave: dt <= {} h / sqrt(c² + {:.2} G/ρ)",
            self.courant, self.stiffness
        )
    }
}

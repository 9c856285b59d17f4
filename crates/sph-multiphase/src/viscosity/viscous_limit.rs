//! The step that explicit friction allows.

use rayon::prelude::*;
use sph_contribution::Limiter;
use sph_core::{StepError, StepLimit, fields};
use sph_neighbours::World;

/// Δt ≤ C ρ h² / η, Ghaïtanellis 2017, Eq. 2.106; where viscosities depend on the flow, with the
/// largest η/ρ of the present state.
pub struct ViscousLimit {
    /// C, already divided by the operator's stiffness.
    pub coefficient: f64,
    /// Largest η/ρ₀ that the laws allow, m²/s; may be infinite.
    pub largest: f64,
    /// True if all viscosities are constant, so that it is the one of every state.
    pub constant: bool,
}

impl<const D: usize> Limiter<D> for ViscousLimit {
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        let h = world.kernel.smoothing_length();
        let kinematic_viscosity = match self.constant {
            true => self.largest,
            false => {
                let (viscosity, density) = world.free.all((fields::VISCOSITY, fields::DENSITY))?;
                let both = viscosity.par_iter().zip(density).with_min_len(1024);
                let present = both.map(|(eta, rho)| eta / rho).reduce(|| 0.0, f64::max);
                // Before the first evaluation the bounds of the laws alone are known.
                match present > 0.0 || self.largest.is_infinite() {
                    true => present,
                    false => self.largest,
                }
            }
        };
        let dt = self.coefficient * h * h / kinematic_viscosity;
        Ok(StepLimit::new("viscosity", dt))
    }
    fn remedy(&self) -> Option<String> {
        let away = "treating the viscosity implicitly (`[implicit-viscosity.backward-euler]`) takes this bound away";
        Some(away.into())
    }
    fn formula(&self) -> String {
        format!("viscosity: dt <= {} h² / ν", self.coefficient)
    }
}

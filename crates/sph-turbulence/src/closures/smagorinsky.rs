//! Smagorinsky's closure of large-eddy simulations, and the width of their filter.

use sph_contribution::{
    Contribution, Offer, OwnColumn, Refusal, Setting, StepHook, StepPhase, step_hook,
};
use sph_core::{Access, Field, Scalar, StepError, fields, parameters, plugin};
use sph_multiphase::viscosity::EddyViscosityEntry;
use sph_neighbours::World;

use super::common::{ClosureCommon, rubs};
use super::phases::{KIND, viscosities};
use super::wall_units::wall_units;
use crate::bed::RoughBed;
use crate::columns::{DAMPING_UNITS, LAST_STRAIN};

/// A length that particles have.
#[parameters]
pub enum FilterLength {
    /// The smoothing length h.
    SmoothingLength,
    /// The particle spacing δr.
    Spacing,
}

impl FilterLength {
    /// Its length, m.
    pub fn metres<const D: usize>(self, world: &World<D>) -> f64 {
        match self {
            FilterLength::SmoothingLength => world.kernel.smoothing_length(),
            FilterLength::Spacing => world.spacing,
        }
    }
}

/// Damping of the eddies near walls.
#[parameters]
pub enum Damping {
    /// Nothing.
    #[default]
    None,
    /// C_S Δ times 1 − e^{−z⁺/26}, near walls that rub.
    VanDriest,
}

/// η_t = ρ (C_S Δ f)² √(2 D:D), with the filter width Δ = `filter` · h (or δr) and f = 1, or with van Driest's damping
/// f = 1 − e^{−z⁺/26}.
///
/// D is the deviator of the strain rate, so that η_t is zero in solid rotation. z⁺ = z u*/ν with the true distance from the
/// nearest wall that rubs (`condition = "no-slip"`) and the u* that the law of the smooth wall finds there. For flows in
/// space: in the plane it is allowed and warned of.
///
/// Sources: Smagorinsky 1963; Issa 2004, Eq. 5.53 and 5.72 (C_S = 0.1, Δ = 2h); van Driest 1956 (A⁺ = 26).
///
/// ```toml
/// [eddy-viscosity.smagorinsky]
/// coefficient = 0.1
/// damping = "van-driest"
/// ```
#[plugin(EddyViscosityEntry [2, 3], "smagorinsky", "large eddies: the filter width squared times the strain rate",
    source: "Smagorinsky 1963; Issa 2004, Eq. 5.53", cfg(not(test)))]
pub struct Smagorinsky {
    /// C_S.
    #[parameter(default: 0.1, unit: "1", min: 0.0, source: "Issa 2004, Eq. 5.53")]
    pub coefficient: f64,
    /// Δ over the length that `filter_length` names.
    #[parameter(default: 2.0, unit: "1", above: 0.0, source: "Issa 2004, Eq. 5.53: 2h")]
    pub filter: f64,
    /// Length of which Δ is a multiple.
    #[parameter(default: FilterLength::SmoothingLength)]
    pub filter_length: FilterLength,
    /// Damping of the eddies near walls.
    #[parameter(default: Damping::None, source: "van Driest 1956")]
    pub damping: Damping,
    /// Of which step the strain rate is.
    #[parameter(default: StrainOf::ThisStep, source: "ours")]
    pub strain_of: StrainOf,
    /// Names of the phases that it acts on: fluids with one viscosity. To be left out where there is one.
    #[parameter(default)]
    pub phases: Vec<String>,
    /// The bed of another phase as a rough wall.
    #[parameter(default)]
    pub bed: Option<RoughBed>,
}

/// Of which step the strain rate is.
#[parameters]
pub enum StrainOf {
    /// Of this one, by a walk over the neighbours before the interactions.
    #[default]
    ThisStep,
    /// Of the one before, summed along with its interactions: cheaper, and behind by one step. None at the start.
    LastStep,
}

/// A⁺ of van Driest 1956.
const DAMPING_LENGTH: f64 = 26.0;

impl Smagorinsky {
    /// ν_t, m²/s, at a strain rate √(2 D:D), 1/s, with a filter of a width, m.
    pub fn kinematic(&self, width: f64, strain_rate: f64) -> f64 {
        (self.coefficient * width).powi(2) * strain_rate
    }

    /// f of van Driest's damping at z⁺.
    pub fn damped(z_plus: f64) -> f64 {
        -(-z_plus / DAMPING_LENGTH).exp_m1()
    }

    fn strain_rate(&self) -> Field<Scalar> {
        match self.strain_of {
            StrainOf::ThisStep => fields::STRAIN_RATE,
            StrainOf::LastStep => LAST_STRAIN,
        }
    }

    fn set<const D: usize>(&self, world: &World<D>, eddies: &mut [f64]) -> Result<(), StepError> {
        let width = self.filter * self.filter_length.metres(world);
        let density = world.free.get(fields::DENSITY)?;
        let inputs = density.iter().zip(world.free.get(self.strain_rate())?);
        for (eddy, (rho, rate)) in eddies.iter_mut().zip(inputs) {
            *eddy = rho * self.kinematic(width, *rate);
        }
        if self.damping == Damping::VanDriest {
            let units = world.free.get(DAMPING_UNITS)?;
            let all = eddies.iter_mut().zip(units);
            all.for_each(|(eddy, z)| *eddy *= Self::damped(*z).powi(2));
        }
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for Smagorinsky {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        match self.strain_of {
            StrainOf::ThisStep => Vec::new(),
            StrainOf::LastStep => vec![OwnColumn::scalar(LAST_STRAIN, |_| 0.0)],
        }
    }
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let common = ClosureCommon {
            name: "smagorinsky",
            phases: &self.phases,
            bed: self.bed.as_ref(),
            eddies_in_space: true,
            ..ClosureCommon::default()
        };
        let damped = self.damping == Damping::VanDriest;
        let access = Access::none()
            .here((fields::DENSITY, self.strain_rate()))
            .here(damped.then_some(DAMPING_UNITS));
        let own = self.clone();
        let set = move |world: &World<D>, eddies: &mut [f64]| own.set(world, eddies);
        common.offer_to(setting, ("smagorinsky", access), set, offer)?;
        if self.strain_of == StrainOf::LastStep {
            offer.hook(strain_recorder());
        }
        if !damped {
            return Ok(());
        }
        if !rubs(setting) {
            let why = "van Driest's damping is of walls of segments or triangles that rub, and there are none: it needs \
                       `[walls.usaw]` and a wall with `condition = \"no-slip\"`";
            return Err(Refusal::at_key(KIND, "damping", why));
        }
        offer.stage(wall_units(viscosities(&self.phases, setting)));
        Ok(())
    }
}

/// Keeps the strain rate of a step, which came along with its interactions, for the closure in the next one.
fn strain_recorder<const D: usize>() -> impl StepHook<D> {
    let access = Access::none().here(fields::STRAIN_RATE).writes(LAST_STRAIN);
    let (name, phases) = ("strain rate of the step", &[StepPhase::AfterKick]);
    step_hook(name, access, phases, |world: &mut World<D>, _| {
        let mut kept = world.free.take(LAST_STRAIN)?;
        kept.copy_from_slice(world.free.get(fields::STRAIN_RATE)?);
        Ok(world.free.put(LAST_STRAIN, kept)?)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Page §3.6: with h = δr it is a classical C_S = 0.2 on Δ = δr.
    #[test]
    fn twice_the_width_is_twice_the_coefficient() {
        let ours = Smagorinsky::default();
        let classical = Smagorinsky {
            coefficient: 0.2,
            filter: 1.0,
            filter_length: FilterLength::Spacing,
            ..ours.clone()
        };
        let [h, rate] = [0.01, 3.7];
        let both = [ours.kinematic(2.0 * h, rate), classical.kinematic(h, rate)];
        assert!((both[0] / both[1] - 1.0).abs() < 1e-15);
        // (0.1 · 0.02)² · 3.7.
        assert!((both[0] - 1.48e-5).abs() < 1e-19);
    }

    #[test]
    fn damping_is_linear_at_the_wall_and_nothing_far_off() {
        assert!((Smagorinsky::damped(1e-4) / (1e-4 / 26.0) - 1.0).abs() < 1e-5);
        assert!((Smagorinsky::damped(26.0) - (1.0 - (-1.0f64).exp())).abs() < 1e-15);
        assert_eq!(Smagorinsky::damped(f64::INFINITY), 1.0);
    }
}

//! Smoothers and shifting, and the step limit of smoothers.

use sph_contribution::{Contribution, Limiter, Offer, Setting, bound, contribution_kind};
use sph_core::{FlowNature, LawNature, SuitedPlugin, Work};
use sph_neighbours::{Interaction, World, lattice_sum};
use sph_rheology::state::Laws;

use crate::diffusion::{Accelerated, MeanAcceleration};

contribution_kind!(
    /// A smoother that a scene may name: a density diffusion that damps the chequerboard mode of pressure.
    pub SmootherEntry, "smoother", One, "density diffusion against pressure noise",
    .suited(smoother).advises("brezzi-pitkaranta").ordered(70).works(Work::Smoothing)
);

contribution_kind!(
    /// A shifting scheme that a scene may name. The last of its stages writes
    /// [`SHIFT_VELOCITY`](sph_core::fields::SHIFT_VELOCITY).
    pub ShiftingEntry, "shifting", One, "shifts that keep particles evenly spread",
    .suited(shifting).ordered(90).works(Work::Shifting)
);

/// The smoother of a scene that names none.
fn smoother(flow: &FlowNature, named: Option<&str>) -> Option<SuitedPlugin> {
    let suited = |name, parameters, reason| {
        Some(SuitedPlugin {
            name,
            parameters,
            reason,
        })
    };
    let pressures = "brezzi-pitkaranta";
    let noisy = "impacts at a free surface are noisy with less";
    match (named, flow.law, flow.confined) {
        (Some(_), ..) | (None, LawNature::Elastic, _) => None,
        (None, LawNature::Soil, _) => suited(
            "delta-sph",
            "",
            "soils that diffuse pressure run out too far",
        ),
        (None, LawNature::Fluid, true) => suited(pressures, "", "no surface is free"),
        (None, LawNature::Fluid, false) => suited(pressures, "strength = 0.4", noisy),
    }
}

/// The shifting of a scene that names none: particles keep to free surfaces, layers under gravity and rows of a channel
/// without, and shifts take momentum from what passes open faces or moves a body.
fn shifting(flow: &FlowNature, named: Option<&str>) -> Option<SuitedPlugin> {
    let one_fluid = flow.phases == 1 && flow.law == LawNature::Fluid;
    let stirred = flow.confined && !flow.parallel && !flow.open && !flow.heavy;
    (one_fluid && stirred && named.is_none()).then_some(SuitedPlugin {
        name: "fickian",
        parameters: "surface = 0.0",
        reason: "one fluid without weight fills its walls or periods, and no surface is free",
    })
}

/// A smoother by its term, which adds dρ/dt to [`Rates::scalar`](sph_neighbours::Rates).
pub struct Smoothing<const D: usize> {
    /// The term.
    pub term: Box<dyn Interaction<D>>,
    /// Strength δ: the diffusivity of the density over h c.
    pub strength: f64,
    /// Accelerations of which the term takes the mean, [`MEAN_ACCELERATION`](sph_core::fields::MEAN_ACCELERATION), if
    /// it does.
    pub accelerated: Option<Accelerated>,
    /// True if it evens out pressures, and not densities: there is no bound on it where the pressure is that of the end
    /// of the step.
    pub of_pressures: bool,
}

impl<const D: usize> Smoothing<D> {
    /// Offers the term, the mean of accelerations, the bound up to which it evens out instead of overshooting, and a remedy.
    pub fn offer(self, setting: &Setting<'_, D>, offer: &mut Offer<D>) {
        let laws = setting.laws;
        offer.terms.push(self.term);
        offer.changes_density = true;
        if self.strength > 0.0 && !(setting.pressure_ahead && self.of_pressures) {
            offer.limiter(diffusion_limit(self.strength, laws));
        }
        if let Some(of) = self.accelerated {
            offer.hook(MeanAcceleration::new(of, fastest(laws)));
        }
        offer.remedy = Some(format!("lower the strength in {}", offer.path));
    }
}

/// Of λΔt: 1.45 for a chequerboard on a lattice, where it may be 2, and particles are not on one.
const STABLE: f64 = 1.25;

/// The speed of sound of the fastest phase at rest, m/s.
pub(crate) fn fastest(laws: &Laws) -> f64 {
    let speeds = laws.iter().map(|l| l.reference().sound_speed);
    speeds.fold(0.0, f64::max)
}

/// λΔt ≤ 1.25 with λ = 2 D Σ_b V |F_ab| on a lattice, 7/8 of the rate at which a chequerboard dies away under the diffusivity D = δ h c:
/// Δt ≤ 1.25/(2 δ h c ΣV|F|) with the fastest phase at rest.
///
/// ΣV|F| is 3.5/h² for Wendland C2. With Δt = 0.4 h/c it binds from δ = 0.45 on; without it δ = 1 blows a tank at
/// rest up. Ours.
fn diffusion_limit<const D: usize>(strength: f64, laws: &Laws) -> impl Limiter<D> + use<D> {
    let fastest = fastest(laws);
    let formula = format!("smoother: dt <= {STABLE} / (2 {strength} h c ΣV|F|)");
    let remedy = "a smaller `strength` of the smoother lengthens the step";
    let dt = move |world: &World<D>| {
        let sum = 2.0 * world.spacing.powi(D as i32) * lattice_sum(world, |pair| -pair.factor);
        Ok(STABLE / (strength * world.kernel.smoothing_length() * fastest * sum))
    };
    bound("smoother", formula, Some(remedy), dt)
}

//! Smoothers and shifting.

use sph_contribution::{Contribution, Offer, Setting, contribution_kind};
use sph_core::{FlowNature, LawNature, SuitedPlugin, Work};
use sph_neighbours::Interaction;

use crate::diffusion::diffusion_limit::{diffusion_limit, fastest};
use crate::diffusion::{Accelerated, MeanAcceleration};

contribution_kind!(
    /// A smoother that a scene may name: a density diffusion that damps the chequerboard mode of pressure.
    pub SmootherEntry, "smoother", One, "density diffusion against pressure noise",
    .suited(smoother).ordered(70).works(Work::Smoothing)
);

contribution_kind!(
    /// A shifting scheme that a scene may name. The last of its stages writes
    /// [`SHIFT_VELOCITY`](sph_core::fields::SHIFT_VELOCITY).
    pub ShiftingEntry, "shifting", One, "shifts that keep particles evenly spread",
    .suited(shifting).ordered(90).works(Work::Shifting)
);

/// The smoother of a scene that names none.
fn smoother(flow: &FlowNature, named: Option<&str>) -> Option<SuitedPlugin> {
    let (name, parameters, reason) = match (named, flow.law, flow.confined) {
        (Some(_), ..) | (None, LawNature::Elastic, _) => return None,
        (None, LawNature::Soil, _) => (
            "delta-sph",
            "",
            "soils that diffuse pressure run out too far",
        ),
        (None, LawNature::Fluid, true) => ("brezzi-pitkaranta", "", "no surface is free"),
        (None, LawNature::Fluid, false) => (
            "brezzi-pitkaranta",
            "strength = 0.4",
            "impacts at a free surface are noisy with less",
        ),
    };
    Some(SuitedPlugin {
        name,
        parameters,
        reason,
    })
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

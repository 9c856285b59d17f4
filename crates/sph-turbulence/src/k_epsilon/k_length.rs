//! One transported scalar, and a length by the distance from walls.

use rayon::prelude::*;
use sph_contribution::{
    Contribution, Offer, OwnColumn, Refusal, Setting, StepHook, StepPhase, step_hook,
};
use sph_core::{Access, Evolved, StepError, fields, plugin};
use sph_multiphase::viscosity::EddyViscosityEntry;
use sph_neighbours::World;

use super::diffusion::{Diffusion, diffusion_limit};
use super::model::KEpsilonModel;
use super::work::{beside_bed, refuse_negative};
use crate::bed::{RoughBed, surface_share};
use crate::closures::{ClosureCommon, KIND, Kinematic, Length, acts_on, rubs, viscosities};
use crate::columns::{
    BED, FRICTION_VELOCITY, SURFACE_SHARE, TURBULENT_ENERGY, TURBULENT_ENERGY_RATE, WALL_DISTANCE,
};

/// η_t = ρ C_μ^¼ √k L, with dk/dt = div((ν + ν_t/σ_k) grad k) + P − ε, ε = C_μ^¾ k^{3/2}/L and
/// P = min(√C_μ, C_μ k S/ε) k S.
///
/// L is Prandtl's: κz, at most `longest`, or κz√(1 − z/H) in an open channel of a `depth` H; not less than a hundredth of
/// the spacing, so that a surface has some. Dissipation is that of the end of the step, and k is positive by
/// construction. Within a spacing of walls with a wall function k = u*²/√C_μ.
///
/// Sources: Prandtl 1945; Issa 2004, Eq. 5.26–5.30, 5.60–5.64, 5.66; Guimet and Laurence 2002 (production).
///
/// ```toml
/// [eddy-viscosity.k-length]
/// energy = "1e-3 m²/s²"
/// depth = "0.4 m"
/// ```
#[plugin(EddyViscosityEntry [2, 3], "k-length",
    "one transported scalar, the energy of eddies, and a length by the distance from walls",
    source: "Prandtl 1945; Issa 2004, Eq. 5.60–5.64", cfg(not(test)))]
pub struct KLength {
    /// k at the start.
    #[parameter(unit: "m²/s²", above: 0.0)]
    pub energy: f64,
    /// Von Kármán's κ.
    #[parameter(default: crate::wall::WallLaw::default().karman, unit: "1", above: 0.0, source: "Issa 2004, Eq. 6.14")]
    pub karman: f64,
    /// Depth H of an open channel.
    #[parameter(unit: "m", above: 0.0, source: "Issa 2004, Eq. 6.19")]
    pub depth: Option<f64>,
    /// L is not larger; unbounded if left out.
    #[parameter(unit: "m", above: 0.0)]
    pub longest: Option<f64>,
    /// Names of the walls that z counts from; all if left out.
    #[parameter(default)]
    pub walls: Vec<String>,
    /// Names of the phases that it acts on: fluids with one viscosity. To be left out where there is one.
    #[parameter(default)]
    pub phases: Vec<String>,
    /// The bed of another phase as a rough wall.
    pub bed: Option<RoughBed>,
    /// True if production is damped where a free surface cuts the support: P (2C − 1), C = Σ V w/γ.
    #[parameter(default)]
    pub damped_at_surfaces: bool,
}

/// L is not less than this share of the spacing.
const LEAST_LENGTH: f64 = 0.01;

impl KLength {
    fn length(&self) -> Length {
        Length {
            karman: self.karman,
            depth: self.depth,
            longest: self.longest,
        }
    }
}

/// L of a column of distances.
fn at(length: &Length, distance: f64, spacing: f64) -> f64 {
    length.at(distance).max(LEAST_LENGTH * spacing)
}

/// ε = C_μ^¾ k^{3/2}/L, m²/s³.
fn dissipation(energy: f64, length: f64) -> f64 {
    KEpsilonModel::C_MU.powf(0.75) * energy * energy.sqrt() / length
}

/// k after `dt` seconds of a share of the production at a strain rate, and dissipation.
fn after(energy: f64, length: f64, [strain_rate, share]: [f64; 2], dt: f64) -> f64 {
    let dissipated = dissipation(energy, length);
    let produced = share * KEpsilonModel::production(energy, dissipated, strain_rate);
    (energy + dt * produced) / (1.0 + dt * dissipated / energy)
}

impl KLength {
    fn set<const D: usize>(&self, world: &World<D>, eddies: &mut [f64]) -> Result<(), StepError> {
        let length = self.length();
        let (density, energy) = world.free.all((fields::DENSITY, TURBULENT_ENERGY))?;
        let distance = world.free.get(WALL_DISTANCE)?;
        for (i, eddy) in eddies.iter_mut().enumerate() {
            let length = at(&length, distance[i], world.spacing);
            *eddy = density[i] * KEpsilonModel::C_MU.powf(0.25) * energy[i].sqrt() * length;
        }
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for KLength {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let (energy, phases) = (self.energy, self.phases.clone());
        let start = move |phase: &str| if acts_on(&phases, phase) { energy } else { 0.0 };
        vec![OwnColumn::scalar(TURBULENT_ENERGY, move |b| start(b.phase)).positive()]
    }
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let common = ClosureCommon {
            name: "k-length",
            phases: &self.phases,
            bed: self.bed.as_ref(),
            distances: Some((&self.walls[..], self.length().farthest())),
            ..ClosureCommon::default()
        };
        let access = Access::none().here((fields::DENSITY, TURBULENT_ENERGY, WALL_DISTANCE));
        let own = self.clone();
        let set = move |world: &World<D>, eddies: &mut [f64]| own.set(world, eddies);
        common.offer_to(setting, ("k-length", access), set, offer)?;
        if rubs(setting) && setting.phases.len() == 1 {
            let why = "k has no value at walls that rub without a wall function: write `condition = \"free-slip\"` \
                       there and name the walls in `[wall-function.log-law]`";
            return Err(Refusal::at_key(KIND, "", why));
        }
        offer.transported.push(Evolved {
            value: TURBULENT_ENERGY,
            rate: TURBULENT_ENERGY_RATE,
        });
        if self.damped_at_surfaces {
            offer.stage(surface_share());
        }
        offer.term(Diffusion {
            sigma: [KEpsilonModel::SIGMA_K],
            wall_flux: None,
        });
        offer.limiter(diffusion_limit(setting.viscous));
        let viscosities = viscosities(&self.phases, setting);
        let damped = self.damped_at_surfaces;
        offer.hook(sources(self.length(), damped, viscosities));
        offer.remedy = Some("look at k at the start: the eddy viscosity is 0.55 √k L".into());
        Ok(())
    }
}

/// Production and dissipation of k after diffusion, and its values at walls.
///
/// `viscosities` are ν of every phase, m²/s; none of those that it does not act on.
fn sources<const D: usize>(
    length: Length,
    damped: bool,
    viscosities: Vec<Option<f64>>,
) -> impl StepHook<D> {
    let surface_share = damped.then_some(SURFACE_SHARE);
    let access = Access::none()
        .here((fields::STRAIN_RATE, fields::POSITION, fields::IDENTITY))
        .here((WALL_DISTANCE, TURBULENT_ENERGY))
        .where_there((FRICTION_VELOCITY, BED))
        .writes(TURBULENT_ENERGY)
        .here(surface_share)
        .here(Kinematic::column(&viscosities));
    let work = move |world: &mut World<D>, dt: f64| {
        let mut energy = world.free.take(TURBULENT_ENERGY)?;
        let viscosity = Kinematic::from_world(&viscosities, world)?;
        let acts = |i: usize| viscosity.at(i).is_some();
        refuse_negative(world, TURBULENT_ENERGY.name, &energy, acts)?;
        let spacing = world.spacing;
        let share = world.free.all(surface_share)?;
        let bed = world.free.all(BED).ok();
        let (rates, distance) = world.free.all((fields::STRAIN_RATE, WALL_DISTANCE))?;
        let all = energy.par_iter_mut().zip(rates).zip(distance).enumerate();
        all.with_min_len(1024).for_each(|(i, ((k, rate), z))| {
            if acts(i) {
                let share = share.map_or(1.0, |share| share[i]);
                *k = after(*k, at(&length, *z, spacing), [*rate, share], dt);
                if let Some([u, _]) = beside_bed(bed, i) {
                    *k = u * u / KEpsilonModel::C_MU.sqrt();
                }
            }
        });
        if let Ok(friction) = world.free.get(FRICTION_VELOCITY) {
            for (k, (u, z)) in energy.iter_mut().zip(friction.iter().zip(distance)) {
                if *u > 0.0 && *z < spacing {
                    *k = u * u / KEpsilonModel::C_MU.sqrt();
                }
            }
        }
        Ok(world.free.put(TURBULENT_ENERGY, energy)?)
    };
    step_hook("k-length", access, &[StepPhase::AfterKick], work)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// P = ε with S = u*/(κz) and L = κz at k = u*²/√C_μ: it stays, and ν_t = κu*z.
    #[test]
    fn the_logarithmic_layer_is_in_balance() {
        let (u, length): (f64, f64) = (0.05, 0.41 * 0.013);
        let k = u * u / KEpsilonModel::C_MU.sqrt();
        let next = after(k, length, [u / length, 1.0], 1.0);
        assert!((next / k - 1.0).abs() < 1e-12);
        assert!(
            (KEpsilonModel::C_MU.powf(0.25) * k.sqrt() * length / (u * length) - 1.0).abs() < 1e-12
        );
    }

    /// dk/dt = −C_μ^¾ k^{3/2}/L: √k = √k₀/(1 + C_μ^¾ √k₀ t/(2L)).
    #[test]
    fn without_strain_it_decays() {
        let (length, end) = (0.1, 2.0);
        let steps = 20_000;
        let k = (0..steps).fold(0.04, |k, _| {
            after(k, length, [0.0, 1.0], end / f64::from(steps))
        });
        let exact = 0.04 / (1.0 + 0.09f64.powf(0.75) * 0.2 * end / (2.0 * length)).powi(2);
        assert!((k / exact - 1.0).abs() < 1e-3, "{k}, {exact}");
    }
}

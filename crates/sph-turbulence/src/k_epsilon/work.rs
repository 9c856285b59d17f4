//! Production and dissipation within a step, and the values at walls.

use rayon::prelude::*;
use sph_contribution::{Report, StepHook, StepMoment, StepPhase};
use sph_core::{Access, Field, Scalar, StepError, fields, parameters};
use sph_neighbours::World;

use super::model::{KEpsilonModel, Variant};
use super::realisable::RealisableModel;
use crate::closures::Kinematic;
use crate::columns::{
    BED, DISSIPATION, FRICTION_VELOCITY, SURFACE_SHARE, TURBULENT_ENERGY, WALL_UNITS,
};

/// Values of k and ε within a spacing of walls with a wall function.
#[parameters]
pub enum AtWall {
    /// Both those of the logarithm: k = u*²/√C_μ, ε = u*³/(κz).
    #[default]
    Values,
    /// No flux of k passes, P = u*² u_k/(κz), and ε = u_k³/(κz), with u_k = C_μ^¼ √k.
    Flux,
    /// No flux of k passes, P = u*² u_k/(κz), and a flux of ε does, u_k⁴/(σ_ε z): neither is set.
    BothFluxes,
}

/// After diffusion: k and ε are produced and dissipated, and next to walls with a wall function they are its own.
pub(crate) struct Sources {
    pub variant: Variant,
    pub at_wall: AtWall,
    pub karman: f64,
    /// ν of every phase, m²/s; none of those that it does not act on.
    pub viscosities: Vec<Option<f64>>,
    /// True if production is damped at surfaces.
    pub damped: bool,
    /// Depth of a channel at whose surface ε is a value, m.
    pub surface_depth: Option<f64>,
}

#[derive(Clone, Copy)]
struct StrainRates {
    rate: f64,
    /// ν_t, m²/s, of the beginning of the step.
    eddies: f64,
    viscosity: f64,
    /// 2C − 1 with the concentration C: 1 inside, 0 at a surface.
    share: f64,
}

/// Of particles whose support a surface cuts by a quarter, [`SURFACE_SHARE`].
const AT_SURFACE: f64 = 0.5;

impl Sources {
    /// The column of the share of the support that is filled, if that matters.
    fn surface_share(&self) -> Option<Field<Scalar>> {
        (self.damped || self.surface_depth.is_some()).then_some(SURFACE_SHARE)
    }

    /// k and ε after a step within the flow.
    fn inside(&self, [k, e]: [f64; 2], strained: StrainRates, dt: f64) -> [f64; 2] {
        let share = if self.damped { strained.share } else { 1.0 };
        let of_eddies = || share * strained.eddies * strained.rate.powi(2);
        match self.variant {
            Variant::Standard => {
                let produced = share * KEpsilonModel::production(k, e, strained.rate);
                KEpsilonModel::produced(k, e, produced, dt)
            }
            Variant::ExplicitAlgebraic => KEpsilonModel::produced(k, e, of_eddies(), dt),
            Variant::Realisable => {
                RealisableModel::after([k, e], of_eddies(), strained.rate, strained.viscosity, dt)
            }
        }
    }

    /// k and ε after a step; `near` is u* and the distance of a wall with a wall function.
    fn after(
        &self,
        [k, e]: [f64; 2],
        strained: StrainRates,
        near: Option<[f64; 2]>,
        dt: f64,
    ) -> [f64; 2] {
        let Some([u, z]) = near else {
            let [k, e] = self.inside([k, e], strained, dt);
            return match self.surface_depth {
                Some(depth) if strained.share < AT_SURFACE => {
                    [k, KEpsilonModel::at_surface(k, depth)]
                }
                _ => [k, e],
            };
        };
        match self.at_wall {
            AtWall::Values => KEpsilonModel::at_wall(u, z, self.karman),
            AtWall::Flux => KEpsilonModel::with_flux(k, u, z, self.karman, dt),
            AtWall::BothFluxes => {
                let produced = KEpsilonModel::wall_production(k, u, z, self.karman);
                KEpsilonModel::produced(k, e, produced, dt)
            }
        }
    }
}

impl<const D: usize> StepHook<D> for Sources {
    fn name(&self) -> String {
        "k-epsilon".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here((fields::STRAIN_RATE, fields::EDDY_VISCOSITY))
            .here((fields::DENSITY, fields::POSITION, fields::IDENTITY))
            .here((TURBULENT_ENERGY, DISSIPATION))
            .where_there((FRICTION_VELOCITY, WALL_UNITS, BED))
            .writes((TURBULENT_ENERGY, DISSIPATION))
            .here(self.surface_share())
            .here(Kinematic::column(&self.viscosities))
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
        let mut energy = world.free.take(TURBULENT_ENERGY)?;
        let mut dissipation = world.free.take(DISSIPATION)?;
        let viscosity = Kinematic::from_world(&self.viscosities, world)?;
        let acts = |i: usize| viscosity.at(i).is_some();
        refuse_negative(world, TURBULENT_ENERGY.name, &energy, acts)?;
        refuse_negative(world, DISSIPATION.name, &dissipation, acts)?;
        let rates = world.free.get(fields::STRAIN_RATE)?;
        let (eddies, density) = world.free.all((fields::EDDY_VISCOSITY, fields::DENSITY))?;
        let share = world.free.all(self.surface_share())?;
        let walls = world.free.all((FRICTION_VELOCITY, WALL_UNITS)).ok();
        let bed = world.free.all(BED).ok();
        let near = |i: usize, nu: f64| {
            let of_wall = walls.and_then(|(friction, units)| {
                let distance = units[i] * nu / friction[i];
                (friction[i] > 0.0 && distance < world.spacing).then_some([friction[i], distance])
            });
            of_wall.or_else(|| beside_bed(bed, i))
        };
        let both = energy.par_iter_mut().zip(&mut dissipation).enumerate();
        both.with_min_len(1024).for_each(|(i, (k, e))| {
            let Some(nu) = viscosity.at(i) else {
                return;
            };
            let strained = StrainRates {
                rate: rates[i],
                eddies: eddies[i] / density[i],
                viscosity: nu,
                share: share.map_or(1.0, |share| share[i]),
            };
            [*k, *e] = self.after([*k, *e], strained, near(i, nu), dt);
        });
        world.free.put(TURBULENT_ENERGY, energy)?;
        Ok(world.free.put(DISSIPATION, dissipation)?)
    }
    fn report(&self, world: &World<D>) -> Report {
        rubbed(world, &self.viscosities).map_or_else(Report::default, Report::advice)
    }
}

/// u*, m/s, and the distance, m, of a particle next to a bed that is a rough wall, from the columns of such a bed.
pub(crate) fn beside_bed(columns: Option<(&[f64], &[f64])>, i: usize) -> Option<[f64; 2]> {
    let (friction, distance) = columns?;
    (friction[i] > 0.0).then(|| [friction[i], distance[i]])
}

/// Nothing is cut off: a step whose diffusion takes more than there is fails, and is taken again in shorter ones.
pub(crate) fn refuse_negative<const D: usize>(
    world: &World<D>,
    quantity: &'static str,
    values: &[f64],
    acts: impl Fn(usize) -> bool,
) -> Result<(), StepError> {
    let bad = |i: usize, v: f64| acts(i) && !(v > 0.0 && v.is_finite());
    let Some(i) = values.iter().enumerate().position(|(i, v)| bad(i, *v)) else {
        return Ok(());
    };
    let reason = "where a positive number was expected: the step is too long for its diffusion";
    Err(world.bad_value(quantity, i, values[i], reason))
}

/// A word about walls that rub a turbulent fluid without a wall function, as they may where a soil needs them to.
fn rubbed<const D: usize>(world: &World<D>, viscosities: &[Option<f64>]) -> Option<String> {
    let viscosity = Kinematic::from_world(viscosities, world).ok()?;
    let walls = &world.walls;
    let elements = &walls.elements;
    let rubs = |s: usize| {
        elements.friction_factor[s] > 0.0 && elements.wall_function.get(s) != Some(&true)
    };
    let particles = walls.contacts.particles.iter().map(|p| *p as usize);
    let mut turbulent = particles.filter(|i| viscosity.at(*i).is_some());
    let met = turbulent.find_map(|i| {
        let mut contacts = walls.contacts.of_particle(i).iter();
        contacts.find(|c| rubs(c.element as usize))
    })?;
    let name = &walls.names[elements.wall[met.element as usize] as usize];
    Some(format!(
        "k has no value at the wall `{name}`, which rubs the turbulent fluid without a wall function: its shear is that of \
         the eddies of the first row; name it in `[wall-function.log-law]`"
    ))
}

//! Production and dissipation within a step, and the values at walls.

use rayon::prelude::*;
use sph_contribution::{Report, StepHook, StepMoment, StepPhase};
use sph_core::{Access, StepError, fields, parameters};
use sph_neighbours::World;

use super::model::{KEpsilonModel, Variant};
use super::near::{BedSide, refuse_negative, rubbed};
use super::realisable::RealisableModel;
use crate::closures::phases::Kinematic;
use crate::columns::{DISSIPATION, FRICTION_VELOCITY, SURFACE_SHARE, TURBULENT_ENERGY, WALL_UNITS};

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
    /// The equations.
    pub variant: Variant,
    /// Next to walls.
    pub at_wall: AtWall,
    /// κ.
    pub karman: f64,
    /// ν of every phase, m²/s; none of those that it does not act on.
    pub viscosities: Vec<Option<f64>>,
    /// True if production is damped at surfaces.
    pub damped: bool,
    /// Depth of a channel at whose surface ε is a value, m.
    pub surface_depth: Option<f64>,
    /// True if there is a bed that is a rough wall.
    pub bed: bool,
}

/// Conditions of a particle next to a wall with a wall function.
#[derive(Clone, Copy)]
struct WallConditions {
    friction_velocity: f64,
    distance: f64,
}

/// Strain rates of a particle.
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
    /// True if the share of the support that is filled matters.
    fn sees_surfaces(&self) -> bool {
        self.damped || self.surface_depth.is_some()
    }

    /// k and ε after a step within the flow.
    fn inside(&self, [k, e]: [f64; 2], strained: StrainRates, dt: f64) -> [f64; 2] {
        let model = KEpsilonModel::default();
        let share = if self.damped { strained.share } else { 1.0 };
        let of_eddies = || share * strained.eddies * strained.rate.powi(2);
        match self.variant {
            Variant::Standard => {
                let produced = share * model.production(k, e, strained.rate);
                model.produced(k, e, produced, dt)
            }
            Variant::ExplicitAlgebraic => model.produced(k, e, of_eddies(), dt),
            Variant::Realisable => RealisableModel::default().after(
                [k, e],
                of_eddies(),
                strained.rate,
                strained.viscosity,
                dt,
            ),
        }
    }

    /// k and ε after a step.
    fn after(
        &self,
        both: [f64; 2],
        strained: StrainRates,
        near: Option<WallConditions>,
        dt: f64,
    ) -> [f64; 2] {
        let model = KEpsilonModel::default();
        let Some(near) = near else {
            let [k, e] = self.inside(both, strained, dt);
            return match self.surface_depth {
                Some(depth) if strained.share < AT_SURFACE => [k, model.at_surface(k, depth)],
                _ => [k, e],
            };
        };
        match self.at_wall {
            AtWall::Values => model.at_wall(near.friction_velocity, near.distance, self.karman),
            AtWall::Flux => {
                let [k, _] = both;
                model.with_flux(k, near.friction_velocity, near.distance, self.karman, dt)
            }
            AtWall::BothFluxes => {
                let [k, e] = both;
                let (u, z) = (near.friction_velocity, near.distance);
                model.produced(k, e, model.wall_production(k, u, z, self.karman), dt)
            }
        }
    }
}

impl<const D: usize> StepHook<D> for Sources {
    fn name(&self) -> String {
        "k-epsilon".into()
    }
    fn access(&self) -> Access {
        let access = Access::none()
            .here(fields::STRAIN_RATE)
            .here(fields::EDDY_VISCOSITY)
            .here(fields::DENSITY)
            .here(fields::POSITION)
            .here(fields::IDENTITY)
            .here(TURBULENT_ENERGY)
            .here(DISSIPATION)
            .where_there(FRICTION_VELOCITY)
            .where_there(WALL_UNITS)
            .writes(TURBULENT_ENERGY)
            .writes(DISSIPATION);
        let access = match self.sees_surfaces() {
            true => access.here(SURFACE_SHARE),
            false => access,
        };
        let access = BedSide::access(self.bed, access);
        match self.viscosities.len() {
            1 => access,
            _ => access.here(fields::PHASE),
        }
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
        let eddies = world.free.get(fields::EDDY_VISCOSITY)?;
        let density = world.free.get(fields::DENSITY)?;
        let share = match self.sees_surfaces() {
            true => world.free.get(SURFACE_SHARE)?,
            false => &[],
        };
        let walls = match world.free.has(FRICTION_VELOCITY.name) {
            true => Some((
                world.free.get(FRICTION_VELOCITY)?,
                world.free.get(WALL_UNITS)?,
            )),
            false => None,
        };
        let bed = BedSide::new(self.bed, world)?;
        let near = |i: usize, nu: f64| {
            let of_wall = walls.as_ref().and_then(|(friction, units)| {
                let distance = units[i] * nu / friction[i];
                (friction[i] > 0.0 && distance < world.spacing).then_some([friction[i], distance])
            });
            let [friction_velocity, distance] = of_wall.or_else(|| bed.at(i))?;
            Some(WallConditions {
                friction_velocity,
                distance,
            })
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
                share: share.get(i).copied().unwrap_or(1.0),
            };
            [*k, *e] = self.after([*k, *e], strained, near(i, nu), dt);
        });
        world.free.put(TURBULENT_ENERGY, energy)?;
        Ok(world.free.put(DISSIPATION, dissipation)?)
    }
    fn report(&self, world: &World<D>) -> Report {
        Report {
            advice: rubbed(world, &self.viscosities),
            ..Report::default()
        }
    }
}

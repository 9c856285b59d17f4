//! Walls whose boundary layer is finer than the particles.

use rayon::prelude::*;
use sph_contribution::{Contribution, Offer, Refusal, Report, Setting, contribution_kind};
use sph_core::{Access, Stage, StepError, Work, fields, plugin, stage};
use sph_neighbours::World;

use super::nearest;
use crate::closures::Kinematic;
use crate::{FRICTION_VELOCITY, WALL_UNITS, WallLaw};

contribution_kind!(
    /// A wall function that a scene may name.
    pub WallFunctionEntry, "wall-function", One, "the shear of walls whose boundary layer is finer than the particles",
    .works(Work::Others)
);

const KIND: &str = "wall-function";

/// τ_w = ρu*², with u* from the law of the wall at the velocity u_t and the true distance z of every particle near it:
/// u_t = u* u⁺(z u*/ν, k_s u*/ν).
///
/// The law is [`WallLaw`]: sublayer, buffer and logarithm over a smooth wall (z⁺ from 0 on), Nikuradse's over a fully
/// rough one. The shear takes the place of η u_t/z in the wall term of the viscous operator, its factor κ included, so that
/// the wall gets the force of the fluid, explicitly or with implicit viscosity, in the plane and in space, on walls that move
/// too. The walls are semi-analytical without vertices, and slip freely but for this shear; beside a phase without one
/// viscosity, as a soil, they may have a condition that is that phase's alone. In the first half spacing the distance is not
/// less than a quarter of one.
///
/// Sources: Issa 2004, §6.2.1, Eq. 6.32–6.36 (u* from a velocity near the wall); Ferrand et al. 2013 (shear on
/// semi-analytical walls); the law's own.
///
/// ```toml
/// [wall-function.log-law]
/// walls = ["bed"]
/// roughness = "10 mm"
/// ```
#[plugin(WallFunctionEntry [2, 3], "log-law",
    "the law of the wall, from the sublayer to the logarithm, smooth or rough",
    source: "Reichardt 1951; Nikuradse 1933; Issa 2004, Eq. 6.32–6.36", cfg(not(test)))]
pub struct LogLaw {
    /// Names of the walls.
    #[parameter(min_items: 1)]
    pub walls: Vec<String>,
    /// Equivalent sand roughness k_s; 0 for smooth walls. At most the spacing.
    #[parameter(default, unit: "m", min: 0.0, source: "Nikuradse 1933")]
    pub roughness: f64,
    /// Von Kármán's κ.
    #[parameter(default: WallLaw::default().karman, unit: "1", above: 0.0, source: "Issa 2004, Eq. 6.22")]
    pub karman: f64,
    /// B of smooth walls.
    #[parameter(default: WallLaw::default().smooth, unit: "1", above: 0.0, source: "Issa 2004, Eq. 6.23")]
    pub smooth_constant: f64,
    /// D of fully rough walls.
    #[parameter(default: WallLaw::default().rough, unit: "1", above: 0.0, source: "Issa 2004, Eq. 6.29")]
    pub rough_constant: f64,
}

impl LogLaw {
    fn law(&self) -> WallLaw {
        WallLaw {
            karman: self.karman,
            smooth: self.smooth_constant,
            rough: self.rough_constant,
            roughness: self.roughness,
        }
    }

    /// Mistakes of its walls.
    ///
    /// A friction of their own is that of phases that the law is not for, where there are such.
    fn check_walls<const D: usize>(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let refused = |why: String| Err(Refusal::at_key(KIND, "walls", why));
        let walls = &setting.world.walls;
        let shared = setting.viscosities.iter().any(|nu| !is_viscous(nu));
        for name in &self.walls {
            if !walls.names.contains(name) {
                return Err(Refusal::unknown(KIND, "walls", "wall", name, &walls.names));
            }
        }
        let elements = &walls.elements;
        if elements.centre.is_empty() || walls.points.in_density() {
            let why = "it acts on semi-analytical walls without vertices, whose points would rub as well: write \
                       `[walls.usaw]` with `vertices = false`";
            return refused(why.into());
        }
        for (s, wall) in elements.wall.iter().enumerate() {
            let name = &walls.names[*wall as usize];
            let rubs = elements.friction_factor[s] > 0.0
                || elements.coulomb.get(s).is_some_and(|c| c.coefficient > 0.0);
            if rubs && !shared && self.walls.contains(name) {
                return refused(format!(
                    "wall `{name}` has a friction of its own, whose place the wall function takes: write `condition = \
                     \"free-slip\"` in `[wall.{name}]`"
                ));
            }
        }
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for LogLaw {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let refused = |key: &str, why: String| Refusal::at_key(KIND, key, why);
        self.check_walls(setting)?;
        let (roughness, spacing) = (self.roughness, setting.world.spacing);
        if roughness > spacing {
            let why = format!(
                "the roughness of {roughness} m is larger than the spacing of {spacing} m, so that particles would lie \
                 within it: at most the spacing was expected; draw such a wall"
            );
            return Err(refused("roughness", why));
        }
        if !setting.viscosities.iter().any(is_viscous) {
            let why = "no phase of this scene is a viscous fluid with one viscosity, which z⁺ = z u*/ν needs: give a \
                       phase `rheology.newtonian` with a viscosity";
            return Err(refused("", why.into()));
        }
        offer.goals.push(fields::WALL_FRICTION.any());
        let viscous = |nu: &Option<f64>| nu.filter(|_| is_viscous(nu));
        let viscosities = setting.viscosities.iter().map(viscous).collect();
        offer.stage(wall_shear(self.law(), self.walls.clone(), viscosities));
        let read = Access::none().here(WALL_UNITS).here(FRICTION_VELOCITY);
        offer.report(read, |world| range(world).unwrap_or_default());
        Ok(())
    }
}

fn is_viscous(viscosity: &Option<f64>) -> bool {
    viscosity.is_some_and(|nu| nu > 0.0)
}

/// Range of the logarithmic law of a boundary layer: Issa 2004, Table 6.1, and the issue's upper end.
const VALID: [f64; 2] = [1.0, 1000.0];

/// Advice on the spacing where z⁺ of the particles at the walls is out of the range.
fn range<const D: usize>(world: &World<D>) -> Result<Report, StepError> {
    let (units, friction) = world.free.all((WALL_UNITS, FRICTION_VELOCITY))?;
    // z⁺ of the particles within a spacing of the wall: those that the shear acts on most.
    let near = (0..units.len()).filter(|i| friction[*i] > 0.0);
    let least = near.map(|i| units[i]).fold(f64::INFINITY, f64::min);
    let [low, high] = VALID;
    if !least.is_finite() || (low..=high).contains(&least) {
        return Ok(Report::default());
    }
    Ok(Report::advice(format!(
        "the particles nearest to the walls with a wall function are at z+ = {least:.3}: the law of the wall is meant for \
         {low} to {high}, so change the spacing"
    )))
}

/// [`FRICTION_VELOCITY`] u*, [`WALL_UNITS`] z⁺ and [`WALL_FRICTION`](fields::WALL_FRICTION) ρu*²/u_t by the law, from the
/// velocity u_t along the wall, relative to it, at the particle's true distance z.
///
/// `named` are the walls, `viscosities` ν of every phase, m²/s; none of those that the law is not for.
fn wall_shear<const D: usize>(
    law: WallLaw,
    named: Vec<String>,
    viscosities: Vec<Option<f64>>,
) -> impl Stage<World<D>> {
    let access = Access::none()
        .here((fields::VELOCITY, fields::DENSITY, fields::RENORMALISATION))
        .writes((FRICTION_VELOCITY, WALL_UNITS, fields::WALL_FRICTION))
        .here(Kinematic::column(&viscosities));
    stage("wall function", access, move |world: &mut World<D>| {
        if world.walls.elements.wall_function.len() != world.walls.elements.wall.len() {
            let names = &world.walls.names;
            let is_named = |wall: &u32| named.contains(&names[*wall as usize]);
            let marks = world.walls.elements.wall.iter().map(is_named);
            world.walls.elements.wall_function = marks.collect();
        }
        let mut friction_velocity = world.free.take(FRICTION_VELOCITY)?;
        let mut wall_units = world.free.take(WALL_UNITS)?;
        let mut friction = world.free.take(fields::WALL_FRICTION)?;
        let (velocity, density) = world.free.all((fields::VELOCITY, fields::DENSITY))?;
        let viscosity = Kinematic::from_world(&viscosities, world)?;
        let (walls, spacing) = (&world.walls, world.spacing);
        let at = |i: usize| -> Result<[f64; 3], StepError> {
            let none = [0.0, f64::INFINITY, 0.0];
            let counts = |s: usize| walls.elements.wall_function[s];
            let seen = nearest(walls, i, &velocity[i], spacing, counts);
            let (Some(nu), Some(seen)) = (viscosity.at(i), seen) else {
                return Ok(none);
            };
            let found = law.friction_velocity(seen.speed, seen.distance, nu);
            let found = found.map_err(|error| StepError::stage("wall function", error))?;
            // At rest the wall is one of the viscous sublayer: τ_w = η u/z.
            let friction = match seen.speed > 0.0 {
                true => density[i] * found * found / seen.speed,
                false => density[i] * nu / seen.distance,
            };
            Ok([found, seen.distance * found / nu, friction])
        };
        let columns = friction_velocity.par_iter_mut().zip(&mut wall_units);
        let each = columns.zip(&mut friction).enumerate().with_min_len(512);
        each.try_for_each(|(i, ((u, z), f))| at(i).map(|found| [*u, *z, *f] = found))?;
        world.free.put(FRICTION_VELOCITY, friction_velocity)?;
        world.free.put(WALL_UNITS, wall_units)?;
        Ok(world.free.put(fields::WALL_FRICTION, friction)?)
    })
}

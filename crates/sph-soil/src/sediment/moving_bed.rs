//! Beds that bed load moves.

use sph_contribution::{
    Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, StepPhase, contributes, step_hook,
};
use sph_core::bed::Bed;
use sph_core::{Access, StepError, Work, contract, fields, parameters};
use sph_neighbours::World;

use super::bed_shear::shear;
use crate::sediment::{Grains, Packing, balance, critical_ratio};

/// A law of bed load.
pub trait BedLoadLaw: Send {
    /// The grains of the bed, and how it moves.
    fn bed(&self) -> &MovingBed;
    /// q* = q/√((s − 1) g d³) of a Shields number, with its critical value; q is the volume of grains per width and time, without
    /// pores. Zero up to the critical value.
    fn rate(&self, shields: f64, critical: f64, grains: &Grains) -> f64;
}

contract!(
    /// A law of bed load that a scene may name.
    pub BedLoadEntry, "bed-load", One, "how a flow carries grains along walls that are beds", BedLoadLaw,
    .works(Work::Others)
);
#[cfg(not(test))]
contributes!("bed-load", BedLoadOfScene);

const KIND: &str = "bed-load";

/// α of Ikeda's deflection of grains on a slope across the flow.
const DEFLECTION: f64 = 1.5;

/// Grains of a bed, `[wall.NAME.erodible]`, and how the flow moves them.
///
/// Before every drift the shear of the wall function becomes a Shields number θ = u*²/((s − 1) g d) at the places of the bed,
/// its critical value that of Soulsby on the slope there, the flux of grains that of the law, and the level changes by Exner's
/// equation, (1 − n) ∂z/∂t = −∇·q. Across a slope the flux is turned downhill by 1.5 √(θ_c/θ) ∂z/∂n. What is steeper than the
/// angle of repose slides within √(Δx/g). Grains are neither made nor lost: what passes the ends of a bed that is a part of its
/// wall is counted.
///
/// Sources: Soulsby 1997 (threshold, slope); Exner 1925; Ikeda 1982 (slope across the flow), with the constant of van Rijn 1993.
#[parameters]
pub struct MovingBed {
    /// Diameter d of the grains.
    #[parameter(unit: "m", above: 0.0)]
    pub grain_diameter: f64,
    /// Their density.
    #[parameter(default: 2650.0, unit: "kg/m³", above: 0.0, source: "quartz")]
    pub grain_density: f64,
    /// Porosity n of the bed.
    #[parameter(default: 0.4, unit: "1", min: 0.0, below: 1.0, source: "Soulsby 1997")]
    pub porosity: f64,
    /// Angle of repose φ under water.
    #[parameter(default: 32.0_f64.to_radians(), unit: "rad", above: 0.0, below: 1.57, source: "Soulsby 1997")]
    pub repose_angle: f64,
    /// Critical Shields number of a flat bed; Soulsby's for the grains if left out.
    #[parameter(unit: "1", min: 0.0)]
    pub critical_shields: Option<f64>,
    /// Time over which the shear is averaged, with weights that fall exponentially; 0 for not at all.
    #[parameter(default: 0.0, unit: "s", min: 0.0)]
    pub averaging_time: f64,
    /// Time at which the bed begins to move.
    #[parameter(default: 0.0, unit: "s", min: 0.0)]
    pub start: f64,
}

impl MovingBed {
    /// Critical Shields number of a flat bed of its grains.
    pub fn critical(&self, grains: &Grains) -> f64 {
        let own = || grains.critical_shields();
        self.critical_shields.unwrap_or_else(own)
    }

    /// Its grains in a fluid of this kinematic viscosity (m²/s), density (kg/m³) and gravity (m/s²).
    pub fn grains(&self, viscosity: f64, density: f64, gravity: f64) -> Grains {
        Grains {
            diameter: self.grain_diameter,
            relative_density: self.grain_density / density,
            viscosity,
            gravity,
        }
    }
}

struct BedLoadOfScene<const D: usize> {
    law: Option<Box<dyn BedLoadLaw>>,
    has_shear: bool,
}

impl<const D: usize> FromPlugins<D> for BedLoadOfScene<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        Some(BedLoadOfScene {
            law: Some(plugins.one::<D, BedLoadEntry>()?),
            has_shear: plugins.names("wall-function"),
        })
    }
}

/// The one viscous fluid of a scene that carries grains: the number of its phase, its kinematic viscosity (m²/s) and density
/// (kg/m³).
pub(super) fn carrier<const D: usize>(
    setting: &Setting<'_, D>,
    kind: &'static str,
) -> Result<(usize, f64, f64), Refusal> {
    let viscous = |nu: &Option<f64>| nu.is_some_and(|nu| nu > 0.0);
    let mut fluids = (0..setting.phases.len()).filter(|k| viscous(&setting.viscosities[*k]));
    let (Some(water), None) = (fluids.next(), fluids.next()) else {
        let why = "grains are carried by one viscous fluid, and this scene has none or several";
        return Err(Refusal::at_key(kind, "", why));
    };
    let viscosity = setting.viscosities[water].unwrap_or_default();
    Ok((water, viscosity, setting.laws[water].reference().density))
}

impl<const D: usize> Contribution<D> for BedLoadOfScene<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let refused = |key: &str, why: &str| Err(Refusal::at_key(KIND, key, why));
        let Some(law) = self.law.take() else {
            return Ok(());
        };
        let moving = *law.bed();
        let world = setting.world;
        if world.walls.beds.is_empty() {
            let why = "no wall of this scene is a bed: give one `[wall.NAME.erodible]`";
            return refused("", why);
        }
        let gravity = world.gravity.norm();
        if gravity == 0.0 {
            let why = "grains without weight have no threshold: give the scene `gravity`";
            return refused("", why);
        }
        let (_, viscosity, density) = carrier(setting, KIND)?;
        if moving.grain_density <= density {
            let why = format!(
                "grains of {} kg/m³ float in a fluid of {density} kg/m³",
                moving.grain_density
            );
            return refused("grain_density", &why);
        }
        let thickest = |bed: &Bed| bed.drawn.iter().fold(0.0, |a: f64, z| a.max(z - bed.rock));
        for bed in &world.walls.beds {
            if thickest(bed) < moving.grain_diameter {
                let name = &world.walls.names[bed.walls[0] as usize];
                let why = format!(
                    "the bed `{name}` is nowhere thicker than {:.3e} m, less than a grain: lower its `rock`",
                    thickest(bed)
                );
                return refused("grain_diameter", &why);
            }
        }
        if !self.has_shear {
            let name = &world.walls.names[world.walls.beds[0].walls[0] as usize];
            let why = format!(
                "the shear on a bed is that of a wall function, and this scene has none: expected \
                 `[wall-function.log-law]` with `walls = [\"{name}\"]`"
            );
            return refused("", &why);
        }
        offer.goals.push(fields::WALL_FRICTION.any());
        let bed_load = BedLoad {
            grains: moving.grains(viscosity, density, gravity),
            bed: moving,
            law,
        };
        let access = Access::none()
            .here((fields::WALL_FRICTION, fields::VELOCITY, fields::DENSITY))
            .here(fields::VOLUME);
        let work = move |world: &mut World<D>, dt: f64| {
            let mut beds = std::mem::take(&mut world.walls.beds);
            let mut all = beds.iter_mut();
            let done = all.try_for_each(|bed| bed_load.step(world, bed, dt));
            world.walls.beds = beds;
            done
        };
        offer.hook(step_hook(KIND, access, &[StepPhase::BeforeDrift], work));
        Ok(())
    }
}

struct BedLoad {
    bed: MovingBed,
    grains: Grains,
    law: Box<dyn BedLoadLaw>,
}

impl BedLoad {
    /// Critical Shields number at a place on a slope, for a flow along a unit vector.
    fn critical(&self, gradient: [f64; 2], along: [f64; 2]) -> f64 {
        self.bed.critical(&self.grains)
            * critical_ratio(gradient, along, self.bed.repose_angle.tan())
    }

    /// Critical Shields number at a place; infinite where no water flows.
    fn threshold(&self, bed: &Bed, place: usize) -> f64 {
        flow(bed, place).map_or(f64::INFINITY, |(_, along)| {
            self.critical(gradient(bed, place), along)
        })
    }

    /// Flux of grains at a place, m²/s.
    fn flux(&self, bed: &Bed, place: usize) -> [f64; 2] {
        let Some((squared, along)) = flow(bed, place).filter(|_| !bed.covered[place]) else {
            return [0.0; 2];
        };
        let gradient = gradient(bed, place);
        let critical = self.critical(gradient, along);
        let shields = self.grains.shields(squared);
        let rate = self.law.rate(shields, critical, &self.grains) * self.grains.unit_transport();
        let across = [-along[1], along[0]];
        let rise = gradient[0] * across[0] + gradient[1] * across[1];
        let turned = -DEFLECTION * (critical / shields).sqrt() * rise;
        [0, 1].map(|k| rate * (along[k] + turned * across[k]))
    }

    /// Shear, flux and rates of a bed for a step of `dt` seconds.
    fn step<const D: usize>(
        &self,
        world: &World<D>,
        bed: &mut Bed,
        dt: f64,
    ) -> Result<(), StepError> {
        bed.unit_shear = self.grains.shields(1.0).recip();
        bed.unit_transport = self.grains.unit_transport();
        let share = match self.bed.averaging_time > dt {
            true => dt / self.bed.averaging_time,
            false => 1.0,
        };
        let now = shear(world, bed)?;
        for (mean, now) in bed.shear.iter_mut().zip(now) {
            *mean = [0, 1].map(|k| mean[k] + share * (now[k] - mean[k]));
        }
        let places = 0..bed.grid.len();
        bed.transport = places.clone().map(|k| self.flux(bed, k)).collect();
        if world.time < self.bed.start {
            return Ok(());
        }
        bed.critical = places.map(|k| self.threshold(bed, k)).collect();
        let packing = Packing {
            porosity: self.bed.porosity,
            repose: self.bed.repose_angle.tan(),
            slide_time: (bed.grid.cell[0] / self.grains.gravity).sqrt(),
        };
        let step = balance(bed, &bed.transport, &packing, dt);
        bed.rate = step.rate;
        bed.fed += step.fed;
        bed.slid += step.slid;
        Ok(())
    }
}

/// u*², m²/s², and the unit vector of the flow at a place; none where no water flows.
fn flow(bed: &Bed, place: usize) -> Option<(f64, [f64; 2])> {
    let [x, y] = bed.shear[place];
    let squared = x.hypot(y);
    (squared != 0.0).then(|| (squared, [x / squared, y / squared]))
}

/// ∇z at a place, by the levels on both sides of it.
fn gradient(bed: &Bed, place: usize) -> [f64; 2] {
    let grid = &bed.grid;
    [0, 1].map(|axis| {
        let seen = |other: Option<usize>| other.filter(|p| *p != place && !bed.covered[*p]);
        let [before, after] = [-1, 1].map(|step| seen(grid.step(place, axis, step)));
        let ways = f64::from(u8::from(before.is_some()) + u8::from(after.is_some()));
        match ways > 0.0 {
            true => {
                let level = |other: Option<usize>| bed.level(other.unwrap_or(place));
                (level(after) - level(before)) / (ways * grid.cell[axis])
            }
            false => 0.0,
        }
    })
}

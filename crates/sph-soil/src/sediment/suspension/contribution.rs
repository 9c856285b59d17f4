//! Suspension as a part of a scene.

use sph_contribution::{
    Contribution, FromPlugins, Limiter, Offer, OwnColumn, Plugins, Refusal, Setting, StepHook,
    StepPhase, bound, contributes, step_hook,
};
use sph_core::{Access, StepError, Vect, fields, suggestion};
use sph_neighbours::{Interaction, Neighbourhood, Rates, RowTerm, WithTerm, World};

use super::exchange::BedExchange;
use super::transport::Transport;
use crate::pores::PhaseMask;
use crate::sediment::moving_bed::carrier;
use crate::sediment::{BedLoadEntry, Grains, MovingBed, PickUp, Suspended, SuspensionEntry};

#[cfg(not(test))]
contributes!("suspension", SuspensionOfScene);

const KIND: &str = "suspension";

/// Concentration of packed grains in a scene without a bed.
const PACKING: f64 = 0.6;
/// Density of grains in a scene without bed load, kg/m³: quartz.
const QUARTZ: f64 = 2650.0;
/// Grains between the bed and the height at which they leave it.
const REFERENCE_GRAINS: f64 = 2.0;

/// The suspension that a scene names.
///
/// ∂C/∂t + u·∇C = ∇·(w C (1 − C)^n ĝ) + ∇·(D∇C), on the particles of the one viscous fluid; D = `diffusivity` + ν_t/σ. Before
/// every drift grains pass between pairs of particles ([`pair_flux`](super::pair_flux)), then between beds and the particles
/// that touch them. Their weight under water acts on the fluid, (s − 1) C g: the inertia of the grains is left out.
struct SuspensionOfScene<const D: usize> {
    law: Option<Box<dyn PickUp>>,
    suspended: Suspended,
    bed: Option<MovingBed>,
    has_eddies: bool,
}

impl<const D: usize> FromPlugins<D> for SuspensionOfScene<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        let law = plugins.one::<D, SuspensionEntry>()?;
        Some(SuspensionOfScene {
            suspended: law.suspended().clone(),
            law: Some(law),
            bed: plugins.one::<D, BedLoadEntry>().map(|law| *law.bed()),
            has_eddies: plugins.names("eddy-viscosity"),
        })
    }
}

fn refused<T>(key: &str, why: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal::at_key(KIND, key, why))
}

impl<const D: usize> SuspensionOfScene<D> {
    /// The grains in a fluid of this kinematic viscosity, m²/s, and density, kg/m³.
    fn grains(&self, viscosity: f64, density: f64, gravity: f64) -> Result<Grains, Refusal> {
        let (own, bed) = (&self.suspended, &self.bed);
        if let Some(bed) = bed {
            let given = [own.grain_diameter, own.grain_density];
            for (key, given) in ["grain_diameter", "grain_density"].into_iter().zip(given) {
                if given.is_some() {
                    let why = "the grains are those of `[bed-load]`: take this key out";
                    return refused(key, why);
                }
            }
            return Ok(bed.grains(viscosity, density, gravity));
        }
        let Some(diameter) = own.grain_diameter else {
            let why = "expected a `grain_diameter`, such as \"0.2 mm\": the scene has no law of bed load that names it";
            return refused("", why);
        };
        let grain_density = own.grain_density.unwrap_or(QUARTZ);
        if grain_density <= density {
            let why =
                format!("grains of {grain_density} kg/m³ float in a fluid of {density} kg/m³");
            return refused("grain_density", why);
        }
        Ok(Grains {
            diameter,
            relative_density: grain_density / density,
            viscosity,
            gravity,
        })
    }

    /// Concentration of grains that lie: 1 − n of the bed, or 0.6.
    fn solid(&self) -> f64 {
        self.bed.map_or(PACKING, |bed| 1.0 - bed.porosity)
    }

    /// Refuses concentrations above packing, and bodies that there are none of.
    fn check_start(&self, setting: &Setting<'_, D>, packing: f64) -> Result<(), Refusal> {
        for (k, one) in self.suspended.start.iter().enumerate() {
            let (body, concentration) = (&one.body, one.concentration);
            if !setting.bodies.contains(body) {
                let names = setting.bodies.iter().map(String::as_str);
                let why = format!("no body is called `{body}`{}", suggestion(body, names));
                return refused(&format!("start[{k}].body"), why);
            }
            if concentration > packing {
                let why = format!(
                    "{concentration} is above the packing of the grains: expected at most {packing}"
                );
                return refused(&format!("start[{k}].concentration"), why);
            }
        }
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for SuspensionOfScene<D> {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let start = self.suspended.start.clone();
        let of = move |body: &str| {
            let found = start.iter().find(|one| one.body == body);
            found.map_or(0.0, |one| one.concentration)
        };
        let column = OwnColumn::scalar(fields::CONCENTRATION, move |birth| of(birth.body));
        vec![column.within(0.0, self.suspended.packed(self.solid()))]
    }

    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let Some(law) = self.law.take() else {
            return Ok(());
        };
        let gravity = setting.world.gravity.norm();
        if gravity == 0.0 {
            let why = "grains without weight do not settle: give the scene `gravity`";
            return refused("", why);
        }
        if law.lifts() && self.bed.is_none() {
            let why = "grains are lifted off a bed, and this scene has none: expected a wall with `[wall.NAME.erodible]` and a \
                       law of bed load such as `[bed-load.engelund-fredsoe]`, or `[suspension.settling]`";
            return refused("", why);
        }
        if law.lifts() && !self.has_eddies {
            let why = "eddies carry grains off a bed, and this scene has none: expected a closure such as \
                       `[eddy-viscosity.k-epsilon]`, or `[suspension.settling]`";
            return refused("", why);
        }
        let (water, viscosity, density) = carrier(setting, KIND)?;
        let grains = self.grains(viscosity, density, gravity)?;
        let solid = self.solid();
        let settling = self.suspended.settles(&grains, solid);
        self.check_start(setting, settling.packing)?;
        let transport = Transport {
            settling,
            diffusivity: self.suspended.diffusivity,
            schmidt: self.has_eddies.then_some(self.suspended.schmidt_number),
            phase: PhaseMask((setting.phases.len() > 1).then_some(water as u32)),
            density,
        };
        let reference = self.suspended.reference_height;
        offer.term(SubmergedWeight(grains.relative_density - 1.0));
        offer.limiter(transport_limit(transport));
        let exchange = BedExchange {
            law,
            grains,
            settling,
            height: reference.unwrap_or(REFERENCE_GRAINS * grains.diameter),
            critical: self.bed.map_or(0.0, |bed| bed.critical(&grains)),
            schmidt: self.suspended.schmidt_number,
            solid,
            density,
        };
        offer.hook(suspension(transport, exchange));
        Ok(())
    }
}

/// (s − 1) C g, the weight of the grains under water; the field is s − 1.
struct SubmergedWeight(f64);

struct BoundWeight<'a, const D: usize> {
    concentration: &'a [f64],
    /// (s − 1) g, m/s².
    gravity: Vect<D>,
}

impl<const D: usize> RowTerm<D> for BoundWeight<'_, D> {
    fn row(&self, at: &Neighbourhood<'_, D>, rates: &mut Rates<D>) {
        rates.acceleration += self.gravity * self.concentration[at.particle];
    }
}

impl<const D: usize> Interaction<D> for SubmergedWeight {
    fn name(&self) -> String {
        "weight of suspended grains".into()
    }
    fn access(&self) -> Access {
        Access::none().here(fields::CONCENTRATION)
    }
    fn with_columns(&self, world: &World<D>, with: &mut WithTerm<'_, D>) -> Result<(), StepError> {
        with(&BoundWeight {
            concentration: world.free.get(fields::CONCENTRATION)?,
            gravity: world.gravity * self.0,
        })
    }
}

/// Δt ≤ 1/(12 w/R + 56 D/R²) with the radius R of the support: half of the step at which a particle would give all its grains
/// away, 2 Σ_b V_b |F_ab| (w|Δz| + D) Δt = 1.
fn transport_limit<const D: usize>(transport: Transport) -> impl Limiter<D> {
    let formula = "suspension: dt <= 1 / (12 w / R + 56 D / R²), R the radius of the support";
    bound("suspension", formula, None, move |world: &World<D>| {
        let radius = world.kernel.support_radius();
        let mixing = transport.mixing(world)?.into_iter().fold(0.0, f64::max);
        let rate = 12.0 * transport.settling.speed / radius + 56.0 * mixing / radius.powi(2);
        Ok(1.0 / rate)
    })
}

fn suspension<const D: usize>(transport: Transport, exchange: BedExchange) -> impl StepHook<D> {
    let work = move |world: &mut World<D>, dt: f64| {
        let mut concentration = transport.step(world, dt)?;
        let mut beds = std::mem::take(&mut world.walls.beds);
        let mut moving = beds.iter_mut().filter(|bed| !bed.critical.is_empty());
        let done = moving.try_for_each(|bed| exchange.step(world, bed, &mut concentration, dt));
        world.walls.beds = beds;
        done?;
        Ok(world.free.put(fields::CONCENTRATION, concentration)?)
    };
    step_hook(KIND, transport.access(), &[StepPhase::BeforeDrift], work)
}

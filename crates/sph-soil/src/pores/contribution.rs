//! The pores of a soil in a scene.

use std::sync::Arc;

use sph_contribution::{
    Birth, Contribution, FromPlugins, Offer, OwnColumn, Plugins, Refusal, Setting, contributes,
};
use sph_core::fields;

use super::columns::{
    EARLIER_DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, GRAIN_VOLUME, PACKING, PhaseMask,
};
use super::drainage::{Drainage, Scratch};
use super::effective::{dilatant_friction, grain_pressure};
use super::plugins::{PorePressureEntry, PoreSettings, Supply};
use super::pore_flow::PoreFlow;
use super::surface::SurfaceDistance;
use super::swelling::Swelling;
use crate::dilatancy::{Dilatancy, DilatancyEntry};
use crate::seepage::{Exchange, Phase};
use crate::stress::{LawInputs, contribution::Materials};

const KIND: &str = "pore-pressure";

struct Pores<const D: usize> {
    settings: PoreSettings,
    law: Option<Arc<dyn Dilatancy>>,
    law_inputs: LawInputs,
    effective: bool,
    seeps: bool,
}

#[cfg(not(test))]
contributes!("pore-pressure", Pores);

impl<const D: usize> FromPlugins<D> for Pores<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        if !plugins.names(KIND) {
            return None;
        }
        let dilates = plugins.names("dilatancy");
        let law = dilates.then(|| plugins.one::<D, DilatancyEntry>());
        Some(Pores {
            settings: plugins.one::<D, PorePressureEntry>()?.settings(),
            law: law.flatten().map(Arc::from),
            law_inputs: Materials::<D>::from_plugins(plugins)?.law_inputs(),
            effective: plugins.names("effective-pressure"),
            seeps: plugins.names("seepage"),
        })
    }
}

impl<const D: usize> Contribution<D> for Pores<D> {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let settings = self.settings.clone();
        let (soil, bodies) = (settings.soil, settings.bodies);
        let borne = settings.darcy.filter(|s| !s.consolidated);
        let load = borne.map_or(0.0, |s| s.load);
        let name = soil.clone();
        let packing = move |birth: &Birth<'_, D>| match birth.phase == name {
            true => 1.0 - bodies.get(birth.body).copied().unwrap_or(settings.porosity),
            false => 0.0,
        };
        let excess = move |birth: &Birth<'_, D>| if birth.phase == soil { load } else { 0.0 };
        vec![
            OwnColumn::scalar(PACKING, packing.clone()),
            OwnColumn::scalar(GRAIN_VOLUME, move |birth| {
                packing(birth) * birth.mass / birth.density
            }),
            OwnColumn::scalar(EXCESS_PORE_PRESSURE, excess),
            OwnColumn::scalar(EARLIER_DRAINED_PRESSURE, |_| -1.0),
        ]
    }

    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let settings = &self.settings;
        let soil = self.soil(setting)?;
        let only = setting.phases.len() == 1;
        let phase = PhaseMask((!only).then_some(soil as u32));
        let reference = setting.laws[soil].reference();
        let load = settings.darcy.as_ref().map_or(0.0, |s| s.load);
        offer.stage(grain_pressure(phase, load));
        if let Some(law) = self.law.clone().filter(|law| law.adds_friction()) {
            offer.stage(dilatant_friction(phase, law, self.friction(soil)?));
        }
        let kernel = &setting.world.kernel;
        let elastic = self.law_inputs.laws[soil].elastic().is_some();
        let darcy = settings.darcy.clone();
        let supply = self.supply(setting)?;
        offer.hook(PoreFlow {
            soil: phase,
            law: self.law.clone(),
            plastic: elastic.then(|| self.law_inputs.clone()),
            drainage: darcy.map(|s| Drainage::new(s, supply, &reference)),
            swelling: self.swelling(setting, soil)?,
            density: setting.density.value,
            distance: SurfaceDistance::new::<D>(kernel.support_radius(), &|r| kernel.at(r).0),
            scratch: Scratch::default(),
        });
        let why = "the pressure in the pores could not be solved for: raise `pore-pressure.darcy.iterations`, or \
                   loosen its `tolerance`";
        (offer.remedies_of_failures).push(("pore pressure", why.into()));
        Ok(())
    }
}

impl<const D: usize> Pores<D> {
    /// Number of the phase with the pores.
    fn soil(&self, setting: &Setting<'_, D>) -> Result<usize, Refusal> {
        let settings = &self.settings;
        if !self.effective {
            let why = "the pressure in the pores is one beside that of the grains: add [effective-pressure.laplace]";
            return Err(Refusal::at_key(KIND, "", why));
        }
        if self.seeps {
            let why = "the pores seep by this table already: take [seepage] out";
            return Err(Refusal::at_key(KIND, "", why));
        }
        if let Some(darcy) = &settings.darcy
            && darcy.permeability(1.0 - settings.porosity) <= 0.0
        {
            let why = "the permeability follows from the diameter of the grains: give `grain_diameter` or \
                       `permeability`, or take [pore-pressure.drained]";
            return Err(Refusal::at_key(KIND, "", why));
        }
        let soil = setting.phase_number(KIND, "soil", &settings.soil)?;
        if !setting.soils[soil] {
            let why = format!(
                "the law of `{}` reads no pressure: name a phase that is a soil",
                settings.soil
            );
            return Err(Refusal::at_key(KIND, "soil", why));
        }
        let mut named = settings.bodies.keys();
        if let Some(name) = named.find(|name| !setting.bodies.contains(name)) {
            let (key, known) = (format!("bodies.{name}"), setting.bodies);
            return Err(Refusal::unknown(KIND, key, "body called", name, known));
        }
        let Some(law) = &self.law else {
            return Ok(soil);
        };
        let bodies = settings.bodies.iter();
        let bodies = bodies.map(|(name, n)| (format!("bodies.{name}"), *n));
        let mut all = std::iter::once(("porosity".to_string(), settings.porosity)).chain(bodies);
        let dense = |n: f64| 1.0 - n >= law.densest();
        match all.find(|(_, n)| dense(*n)) {
            None => Ok(soil),
            Some((key, n)) => {
                let why = format!(
                    "a packing of 1 − {n} is beyond the densest of the law, {}: take a larger porosity, or raise \
                     `densest_packing`",
                    law.densest()
                );
                Err(Refusal::at_key(KIND, key, why))
            }
        }
    }

    /// The coefficient of friction of the rheology of the soil, to which dilation adds.
    fn friction(&self, soil: usize) -> Result<f64, Refusal> {
        let why = "it adds to the friction of the rheology, and that of the soil has no coefficient: take a \
                   rheology of grains, or [dilatancy.plastic-pressure]";
        let friction = self.law_inputs.laws[soil].slow_friction();
        friction.ok_or_else(|| Refusal::at_key("dilatancy", "", why))
    }

    fn supply(&self, setting: &Setting<'_, D>) -> Result<Option<(u32, Supply)>, Refusal> {
        let Some(supply) = self.settings.darcy.as_ref().and_then(|d| d.supply.clone()) else {
            return Ok(None);
        };
        let walls = &setting.world.walls;
        if walls.elements.centre.is_empty() {
            let why = "the fluid comes through elements of a wall: take [walls.usaw]";
            return Err(Refusal::at_key(KIND, "supply", why));
        }
        let found = walls.names.iter().position(|name| *name == supply.wall);
        let (name, known) = (&supply.wall, &walls.names);
        let unknown = || Refusal::unknown(KIND, "supply.wall", "wall called", name, known);
        let found = found.ok_or_else(unknown)?;
        Ok(Some((found as u32, supply)))
    }

    fn swelling(&self, setting: &Setting<'_, D>, soil: usize) -> Result<Option<Swelling>, Refusal> {
        let settings = &self.settings;
        if !settings.swelling {
            return Ok(None);
        }
        if setting.density.value != fields::DENSITY_CONSTANT {
            let why = "particles grow and shrink, which is known with densities that are sums over positions: take \
                       [formulation.hu-adams], or `swelling = false`";
            return Err(Refusal::at_key(KIND, "swelling", why));
        }
        let water = settings.water.as_ref();
        let fluid = water.map(|name| Phase::new(setting, KIND, soil, name));
        let fluid = fluid.transpose()?;
        let of_fluid = fluid.map_or(WATER, |phase| phase.density);
        Ok(Some(Swelling {
            density: settings.fluid_density.unwrap_or(of_fluid),
            fluid,
            exchange: EXCHANGE,
        }))
    }
}

/// kg/m³.
const WATER: f64 = 1000.0;

/// Particles of the fluid even out as those beside a soil that seeps do.
const EXCHANGE: Exchange = Exchange {
    evening: 0.15,
    limit: 0.5,
    remedy: "take a finer spacing, or leave `pore-pressure.darcy.water` out",
};

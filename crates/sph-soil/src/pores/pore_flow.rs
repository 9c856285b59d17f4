//! The flow of the pores within a step.

use std::sync::Arc;

use sph_contribution::{StepHook, StepMoment, StepPhase};
use sph_core::{Access, Field, Scalar, StepError, Vect, fields};
use sph_neighbours::World;

use super::columns::{EARLIER_DRAINED_PRESSURE, GRAIN_VOLUME};
use super::drainage::{Drainage, Scratch};
use super::effective::plastic_shares;
use super::surface::{Outlet, SurfaceDistance, feeds, outlets};
use super::swelling::Swelling;
use crate::dilatancy::{Dilatancy, Dilation, GrainState};
use crate::pores::{DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, PACKING, PhaseMask};
use crate::stress::LawInputs;

pub(crate) struct PoreFlow {
    pub soil: PhaseMask,
    pub law: Option<Arc<dyn Dilatancy>>,
    /// Of a soil with an elastic part.
    pub plastic: Option<LawInputs>,
    /// `None` if the fluid passes freely.
    pub drainage: Option<Drainage>,
    pub swelling: Option<Swelling>,
    /// The scalar that the formulation integrates for the density.
    pub density: Field<Scalar>,
    pub distance: SurfaceDistance,
    pub scratch: Scratch,
}

impl<const D: usize> StepHook<D> for PoreFlow {
    fn name(&self) -> String {
        "pore pressure".into()
    }
    fn access(&self) -> Access {
        let mut access = Access::none()
            .both(self.soil.column())
            .both((fields::POSITION, fields::VOLUME, PACKING))
            .both(EXCESS_PORE_PRESSURE)
            .here((DRAINED_PRESSURE, EARLIER_DRAINED_PRESSURE, GRAIN_VOLUME))
            .here(fields::IDENTITY)
            .writes((PACKING, EXCESS_PORE_PRESSURE, EARLIER_DRAINED_PRESSURE));
        if self.law.is_some() {
            access = access.here(fields::STRAIN_RATE);
            if let Some(plastic) = &self.plastic {
                access = access.and(plastic.access()).here(fields::ELASTIC_STRESS);
            }
        }
        match self.swelling.is_some() {
            false => access,
            true => access
                .both((fields::MASS, fields::VELOCITY))
                .here(fields::DENSITY)
                .writes((fields::MASS, fields::VELOCITY, self.density))
                .rings(3),
        }
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
        let mut scratch = std::mem::take(&mut self.scratch);
        let mut drainage = self.drainage.take();
        let drained = match &mut drainage {
            Some(drainage) => self.drain(world, drainage, dt, &mut scratch),
            None => self.expand(world, dt, &mut scratch.growth),
        };
        (self.scratch, self.drainage) = (scratch, drainage);
        let (outlets, outflow) = drained?;
        let growth = &self.scratch.growth;
        self.pack(world, growth)?;
        match &self.swelling {
            None => Ok(()),
            Some(swelling) => swelling.grow(world, growth, &outlets, &outflow, dt),
        }
    }
}

/// The outlets of a soil, and the volumes that go out by them in a step, m^d.
type Outflow = (Vec<Outlet>, Vec<f64>);

impl PoreFlow {
    /// The expansion of a particle at a pressure; none without a law.
    fn dilation(&self, packing: f64, strain_rate: f64, pressure: f64) -> Dilation {
        let state = GrainState {
            packing,
            strain_rate,
            pressure,
        };
        let law = self.law.as_ref();
        law.map_or_else(Dilation::default, |law| law.dilation(&state))
    }

    /// Plastic strain rates; empty without a law.
    fn strain_rates<const D: usize>(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        if self.law.is_none() {
            return Ok(Vec::new());
        }
        let rates = world.free.get(fields::STRAIN_RATE)?;
        let Some(plastic) = &self.plastic else {
            return Ok(rates.to_vec());
        };
        let both = rates.iter().zip(plastic_shares(plastic, world)?);
        Ok(both.map(|(rate, share)| rate * share).collect())
    }

    /// Growth of every particle by dilation at the drained pressure; no fluid goes out.
    fn expand<const D: usize>(
        &self,
        world: &World<D>,
        dt: f64,
        growth: &mut Vec<f64>,
    ) -> Result<Outflow, StepError> {
        let soil = self.soil.test(world)?;
        let strain_rate = self.strain_rates(world)?;
        let (volume, packing) = world.free.all((fields::VOLUME, PACKING))?;
        let drained = world.free.get(DRAINED_PRESSURE)?;
        growth.clear();
        growth.extend((0..volume.len()).map(|i| {
            let rate = strain_rate.get(i).copied().unwrap_or(0.0);
            match soil(i) {
                true => self.dilation(packing[i], rate, drained[i]).rate * volume[i] * dt,
                false => 0.0,
            }
        }));
        Ok(Outflow::default())
    }

    /// Solves for the excess pressure at the end of the step.
    fn drain<const D: usize>(
        &self,
        world: &mut World<D>,
        drainage: &mut Drainage,
        dt: f64,
        scratch: &mut Scratch,
    ) -> Result<Outflow, StepError> {
        let outlets = {
            let soil = self.soil.test(world)?;
            let water = self.swelling.as_ref().and_then(|s| s.fluid);
            let both = water.zip(world.free.get(fields::PHASE).ok());
            let fluid = both.map(|(w, p)| move |i: usize| p[i] == w.water);
            let fluid = fluid.as_ref().map(|f| f as &dyn Fn(usize) -> bool);
            outlets(world, &soil, fluid, &self.distance)?
        };
        self.coefficients(world, drainage, &outlets, dt, scratch)?;
        drainage.solve(world, scratch)?;
        let (mobility, excess, growth) = (&scratch.mobility, &scratch.excess, &mut scratch.growth);
        growth.clear();
        // Storage and the law's share are no flux.
        let grown = scratch.product.iter().zip(excess).zip(&scratch.storage);
        growth.extend(grown.map(|((flux, p), storage)| dt * (storage * p[0] - flux[0])));
        for (i, grown) in growth.iter_mut().enumerate() {
            match mobility[i] == 0.0 {
                true => *grown = 0.0,
                false => *grown += dt * scratch.fed[i],
            }
        }
        let outflow = |outlet: &Outlet| {
            let i = outlet.particle;
            dt * outlet.conductance * mobility[i] * excess[i][0]
        };
        let outflow = outlets.iter().map(outflow).collect();
        Ok((outlets, outflow))
    }

    /// Fills the coefficients of the system at the state before the step.
    fn coefficients<const D: usize>(
        &self,
        world: &mut World<D>,
        drainage: &Drainage,
        outlets: &[Outlet],
        dt: f64,
        scratch: &mut Scratch,
    ) -> Result<(), StepError> {
        let darcy = &drainage.darcy;
        let mut earlier = world.free.take(EARLIER_DRAINED_PRESSURE)?;
        let soil = self.soil.test(world)?;
        let strain_rate = self.strain_rates(world)?;
        let (volume, packing) = world.free.all((fields::VOLUME, PACKING))?;
        let (drained, excess) = world.free.all((DRAINED_PRESSURE, EXCESS_PORE_PRESSURE))?;
        let Scratch {
            mobility,
            storage,
            diagonal,
            source,
            fed,
            excess: x,
            ..
        } = scratch;
        for column in [&mut *mobility, storage, diagonal, source, fed] {
            column.clear();
            column.resize(volume.len(), 0.0);
        }
        x.clear();
        x.extend(excess.iter().map(|p| Vect::<1>::from([*p])));
        for i in (0..volume.len()).filter(|&i| soil(i)) {
            let before = match earlier[i] < 0.0 {
                true => drained[i],
                false => earlier[i],
            };
            let pressure = (before + darcy.load - excess[i]).max(0.0);
            let rate = strain_rate.get(i).copied().unwrap_or(0.0);
            let dilation = self.dilation(packing[i], rate, pressure);
            let modulus = self.law.as_ref().map_or(drainage.contacts, |law| {
                law.modulus(drainage.contacts, pressure)
            });
            let (v, gain) = (volume[i], drained[i] - before);
            let stored = v / (modulus * dt);
            // f(p') at the new p' = pressure + gain − (p_e' − p_e), to first order.
            storage[i] = stored - v * dilation.slope;
            let constant = dilation.rate + dilation.slope * (gain + excess[i]);
            source[i] = stored * (excess[i] + gain) - v * constant;
            mobility[i] = darcy.permeability(packing[i]) / darcy.viscosity;
            earlier[i] = drained[i];
        }
        diagonal.copy_from_slice(storage);
        for outlet in outlets {
            diagonal[outlet.particle] += outlet.conductance * mobility[outlet.particle];
        }
        if let Some((wall, supply)) = &drainage.supply {
            let pressure = supply.at(world.time + dt);
            for (i, conductance) in feeds(world, *wall)? {
                diagonal[i] += conductance * mobility[i];
                fed[i] = conductance * mobility[i] * pressure;
                source[i] += fed[i];
            }
        }
        Ok(world.free.put(EARLIER_DRAINED_PRESSURE, earlier)?)
    }

    /// φ' = G/(G/φ + dV).
    fn pack<const D: usize>(&self, world: &mut World<D>, growth: &[f64]) -> Result<(), StepError> {
        let mut packing = world.free.take(PACKING)?;
        let grains = world.free.get(GRAIN_VOLUME)?;
        let soil = self.soil.test(world)?;
        let densest = self.law.as_ref().map_or(1.0, |law| law.densest());
        let mut bad = None;
        for i in (0..packing.len()).filter(|&i| soil(i)) {
            packing[i] = grains[i] / (grains[i] / packing[i] + growth[i]);
            // Not `>=`: a packing that is not a number must be seen.
            if !(packing[i] > 0.0 && packing[i] < densest) {
                bad = bad.or(Some((i, packing[i])));
            }
        }
        world.free.put(PACKING, packing)?;
        let Some((i, value)) = bad else {
            return Ok(());
        };
        let reason = format!("and must stay between 0 and {densest}, the densest of the law");
        Err(world.bad_value("packing", i, value, reason))
    }
}

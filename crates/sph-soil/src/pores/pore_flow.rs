//! The flow of the pores within a step.

use std::sync::Arc;

use sph_contribution::{StepHook, StepMoment, StepPhase};
use sph_core::{Access, Field, Pool, Scalar, StepError, Vect, fields};
use sph_multiphase::linear::{
    Assembly, ConjugateGradient, Entries, LinearSolver, Matrix, ParticleMatrix,
};
use sph_neighbours::World;

use super::contract::{
    DRAINED_PRESSURE, EARLIER_DRAINED_PRESSURE, EXCESS_PORE_PRESSURE, GRAIN_VOLUME, PACKING,
    Skeleton, Supply,
};
use super::feeds::feeds;
use super::plastic_share::PlasticShare;
use super::soil_phase::SoilPhase;
use super::surface::{Outlet, outlets};
use super::surface_distance::SurfaceDistance;
use super::swelling::Swelling;
use super::system::PoreSystem;
use crate::dilatancy::{Dilatancy, Dilation, GrainState};

/// Packing and excess pressure of the pores of a soil.
pub(crate) struct PoreFlow {
    pub soil: SoilPhase,
    pub law: Option<Arc<dyn Dilatancy>>,
    /// Of a soil with an elastic part.
    pub plastic: Option<PlasticShare>,
    /// `None` if the fluid passes freely.
    pub skeleton: Option<Skeleton>,
    /// A wall that feeds the pores, with its number.
    pub supply: Option<(u32, Supply)>,
    /// Solves for the excess pressure.
    pub solver: ConjugateGradient,
    /// Stiffness of the contacts, Pa.
    pub contacts: f64,
    pub swelling: Option<Swelling>,
    /// The scalar that the formulation integrates for the density.
    pub density: Field<Scalar>,
    pub distance: SurfaceDistance,
    pub scratch: Scratch,
}

/// Buffers of a solve, kept for their memory.
#[derive(Default)]
pub(crate) struct Scratch {
    assembly: Assembly<f64, 1>,
    pool: Pool<Vec<f64>>,
    mobility: Vec<f64>,
    /// Storage and the slope of the law, without outlets, m^d/(Pa s).
    storage: Vec<f64>,
    diagonal: Vec<f64>,
    source: Vec<f64>,
    /// Inflow through walls that feed pores without an excess pressure, m^d/s.
    fed: Vec<f64>,
    excess: Vec<Vect<1>>,
    product: Vec<Vect<1>>,
    growth: Vec<f64>,
}

impl<const D: usize> StepHook<D> for PoreFlow {
    fn name(&self) -> String {
        "pore pressure".into()
    }
    fn access(&self) -> Access {
        let mut access = self
            .soil
            .access()
            .both(fields::POSITION)
            .both(fields::VOLUME)
            .both(PACKING)
            .both(EXCESS_PORE_PRESSURE)
            .here(DRAINED_PRESSURE)
            .here(EARLIER_DRAINED_PRESSURE)
            .here(GRAIN_VOLUME)
            .here(fields::IDENTITY)
            .writes(PACKING)
            .writes(EXCESS_PORE_PRESSURE)
            .writes(EARLIER_DRAINED_PRESSURE);
        if self.law.is_some() {
            access = access.here(fields::STRAIN_RATE);
            if let Some(plastic) = &self.plastic {
                access = access.and(plastic.access());
            }
        }
        match self.swelling.is_some() {
            false => access,
            true => access
                .both(fields::MASS)
                .both(fields::VELOCITY)
                .here(fields::DENSITY)
                .writes(fields::MASS)
                .writes(fields::VELOCITY)
                .writes(self.density)
                .rings(3),
        }
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let mut scratch = std::mem::take(&mut self.scratch);
        let done = self.advance(moment.world, moment.dt, &mut scratch);
        self.scratch = scratch;
        done
    }
}

impl PoreFlow {
    fn advance<const D: usize>(
        &mut self,
        world: &mut World<D>,
        dt: f64,
        scratch: &mut Scratch,
    ) -> Result<(), StepError> {
        let (outlets, outflow) = match self.skeleton.is_some() {
            true => self.drain(world, dt, scratch)?,
            false => {
                self.expand(world, dt, scratch)?;
                (Vec::new(), Vec::new())
            }
        };
        self.pack(world, &scratch.growth)?;
        match &self.swelling {
            None => Ok(()),
            Some(swelling) => swelling.grow(world, &scratch.growth, &outlets, &outflow, dt),
        }
    }

    /// The expansion of a particle at a pressure; none without a law.
    fn dilation(&self, packing: f64, strain_rate: f64, pressure: f64) -> Dilation {
        let none = Dilation {
            rate: 0.0,
            slope: 0.0,
        };
        let state = GrainState {
            packing,
            strain_rate,
            pressure,
        };
        self.law.as_ref().map_or(none, |law| law.dilation(&state))
    }

    /// Plastic strain rates; empty without a law.
    fn strain_rates<const D: usize>(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        if self.law.is_none() {
            return Ok(Vec::new());
        }
        let rates = world.free.get(fields::STRAIN_RATE)?;
        match &self.plastic {
            None => Ok(rates.to_vec()),
            Some(plastic) => {
                let shares = plastic.shares(world)?;
                Ok(rates
                    .iter()
                    .zip(shares)
                    .map(|(rate, share)| rate * share)
                    .collect())
            }
        }
    }

    /// Growth of every particle by dilation at the drained pressure.
    fn expand<const D: usize>(
        &self,
        world: &World<D>,
        dt: f64,
        scratch: &mut Scratch,
    ) -> Result<(), StepError> {
        let soil = self.soil.mask(world)?;
        let strain_rate = self.strain_rates(world)?;
        let volume = world.free.get(fields::VOLUME)?;
        let packing = world.free.get(PACKING)?;
        let drained = world.free.get(DRAINED_PRESSURE)?;
        scratch.growth.clear();
        scratch.growth.extend((0..volume.len()).map(|i| {
            let rate = strain_rate.get(i).copied().unwrap_or(0.0);
            match soil.has(i) {
                true => self.dilation(packing[i], rate, drained[i]).rate * volume[i] * dt,
                false => 0.0,
            }
        }));
        Ok(())
    }

    /// Solves for the excess pressure at the end of the step; returns the outlets and the volumes that go out by them, m^d.
    fn drain<const D: usize>(
        &mut self,
        world: &mut World<D>,
        dt: f64,
        scratch: &mut Scratch,
    ) -> Result<(Vec<Outlet>, Vec<f64>), StepError> {
        let outlets = {
            let soil = self.soil.mask(world)?;
            let water = self.swelling.as_ref().and_then(|s| s.fluid);
            let phase = world.free.get(fields::PHASE).ok();
            let fluid = water
                .zip(phase)
                .map(|(w, p)| move |i: usize| p[i] == w.water);
            let fluid = fluid.as_ref().map(|f| f as &dyn Fn(usize) -> bool);
            outlets(world, &|i| soil.has(i), fluid, &self.distance)?
        };
        self.coefficients(world, &outlets, dt, scratch)?;
        self.solve(world, scratch)?;
        let Scratch {
            mobility,
            excess,
            storage,
            fed,
            product,
            growth,
            ..
        } = scratch;
        growth.clear();
        // Storage and the law's share are no flux.
        let grown = product.iter().zip(&*excess).zip(&*storage);
        growth.extend(grown.map(|((flux, p), storage)| dt * (storage * p[0] - flux[0])));
        for (i, grown) in growth.iter_mut().enumerate() {
            match mobility[i] == 0.0 {
                true => *grown = 0.0,
                false => *grown += dt * fed[i],
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
        outlets: &[Outlet],
        dt: f64,
        scratch: &mut Scratch,
    ) -> Result<(), StepError> {
        let Some(skeleton) = &self.skeleton else {
            return Ok(());
        };
        let mut earlier = world.free.take(EARLIER_DRAINED_PRESSURE)?;
        let soil = self.soil.mask(world)?;
        let strain_rate = self.strain_rates(world)?;
        let volume = world.free.get(fields::VOLUME)?;
        let packing = world.free.get(PACKING)?;
        let drained = world.free.get(DRAINED_PRESSURE)?;
        let excess = world.free.get(EXCESS_PORE_PRESSURE)?;
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
        for i in (0..volume.len()).filter(|&i| soil.has(i)) {
            let before = if earlier[i] < 0.0 {
                drained[i]
            } else {
                earlier[i]
            };
            let pressure = (before + skeleton.load - excess[i]).max(0.0);
            let rate = strain_rate.get(i).copied().unwrap_or(0.0);
            let dilation = self.dilation(packing[i], rate, pressure);
            let modulus = self
                .law
                .as_ref()
                .map_or(self.contacts, |law| law.modulus(self.contacts, pressure));
            let (v, gain) = (volume[i], drained[i] - before);
            let stored = v / (modulus * dt);
            // f(p') at the new p' = pressure + gain − (p_e' − p_e), to first order.
            storage[i] = stored - v * dilation.slope;
            let constant = dilation.rate + dilation.slope * (gain + excess[i]);
            source[i] = stored * (excess[i] + gain) - v * constant;
            mobility[i] = skeleton.permeability.at(packing[i]) / skeleton.viscosity;
            earlier[i] = drained[i];
        }
        diagonal.copy_from_slice(storage);
        for outlet in outlets {
            diagonal[outlet.particle] += outlet.conductance * mobility[outlet.particle];
        }
        if let Some((wall, supply)) = &self.supply {
            let pressure = supply.at(world.time + dt);
            for (i, conductance) in feeds(world, *wall)? {
                diagonal[i] += conductance * mobility[i];
                fed[i] = conductance * mobility[i] * pressure;
                source[i] += fed[i];
            }
        }
        Ok(world.free.put(EARLIER_DRAINED_PRESSURE, earlier)?)
    }

    /// Solves, and leaves the product of the matrix with the solution, whose grains all keep a pressure of 0 or more.
    fn solve<const D: usize>(
        &mut self,
        world: &mut World<D>,
        scratch: &mut Scratch,
    ) -> Result<(), StepError> {
        let Some(skeleton) = &self.skeleton else {
            return Ok(());
        };
        let space = world.space()?;
        let Scratch {
            assembly,
            pool,
            mobility,
            diagonal,
            source,
            excess,
            product,
            ..
        } = scratch;
        let system = PoreSystem {
            volume: world.free.get(fields::VOLUME)?,
            gamma: world.free.get(fields::RENORMALISATION).ok(),
            mobility,
            diagonal,
            source,
        };
        let owned = space.owned();
        assembly.fill_wanted(
            world,
            |i| system.mobility[i] != 0.0 && owned.has(i),
            |rows, cluster| system.add(cluster, rows, pool),
            |rows, others| others.for_each(|_| system.add_outside(rows)),
        )?;
        let values = std::mem::take(&mut assembly.values);
        let matrix = Matrix::on(assembly.pattern.clone(), Entries::Scalar(values));
        let operator = ParticleMatrix::new(&matrix, &space, None);
        let solved = self.solver.solve(&operator, &assembly.sources, excess);
        let drained = world.free.get(DRAINED_PRESSURE)?;
        for (i, p) in excess.iter_mut().enumerate() {
            p[0] = p[0].min(drained[i] + skeleton.load);
        }
        product.clear();
        product.resize(excess.len(), Vect::zeros());
        matrix.multiply(excess, product);
        if let Entries::Scalar(values) = matrix.entries {
            assembly.values = values;
        }
        solved.map_err(|e| StepError::Stage {
            stage: "pore pressure".into(),
            reason: e.to_string(),
        })?;
        let mut column = world.free.take(EXCESS_PORE_PRESSURE)?;
        let both = column.iter_mut().zip(&*excess);
        both.for_each(|(column, p)| *column = p[0]);
        Ok(world.free.put(EXCESS_PORE_PRESSURE, column)?)
    }

    /// φ' = G/(G/φ + dV).
    fn pack<const D: usize>(&self, world: &mut World<D>, growth: &[f64]) -> Result<(), StepError> {
        let mut packing = world.free.take(PACKING)?;
        let grains = world.free.get(GRAIN_VOLUME)?;
        let soil = self.soil.mask(world)?;
        let densest = self.law.as_ref().map_or(1.0, |law| law.densest());
        let mut bad = None;
        for i in (0..packing.len()).filter(|&i| soil.has(i)) {
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
        let position = world.free.get(fields::POSITION)?[i];
        Err(StepError::Bad {
            quantity: "packing",
            particle: world.free.get(fields::IDENTITY)?[i],
            position: position.iter().copied().collect(),
            value,
            reason: format!("and must stay between 0 and {densest}, the densest of the law"),
        })
    }
}

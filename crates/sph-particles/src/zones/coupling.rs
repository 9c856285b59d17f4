//! The zones of a flow, and its own band if it is one.

mod level;
mod stepper;

use rayon::prelude::*;
use serde::Serialize;
use sph_core::{Field, Scalar, StepError, System, Vect, fields};
use sph_multiphase::Diffused;
use sph_neighbours::World;
use sph_probes::Probe;
use sph_solver::Flow;

use super::fit::weight;
use super::frame::Frame;
use super::guard::{Guard, spread};
use super::near::NearbyPlaces;
use super::refusals::scalars;
use super::sample::{REACH, State, States};
use crate::setup::{Assembled, measure_walls};

pub(crate) use level::Level;
pub use stepper::Stepper;

/// Time over h/c in which density and velocity of a particle in the core of a zone come to those of the zone. At once they
/// would be those of other places, and the particles' own forces could not keep them apart. Measured: `notes/zones.md`.
const RELAXATION: f64 = 2.0;

/// Particles of a zone at the start, those of its band among them.
#[derive(Clone, Debug, Serialize)]
pub struct ZoneSize {
    /// Its name in the scene.
    pub name: String,
    /// Spacing, m.
    pub spacing: f64,
    /// Number of particles.
    pub particles: usize,
}

/// Some particles of a flow.
pub(crate) type Particles<'a, const D: usize> = (&'a Flow<D>, Vec<usize>);

/// Flows that a flow shares its particles with: those of its zones, and that around it.
pub(crate) struct Coupling<const D: usize> {
    /// The quantity that the formulation integrates for the density.
    diffused: Diffused,
    /// Scalars of state that go from flow to flow besides.
    pub scalars: Vec<Field<Scalar>>,
    /// The band around it, if it is a zone.
    pub guard: Option<Guard<D>>,
    /// Its zones.
    pub levels: Vec<Level<D>>,
    /// Particles that a zone leads, with the states there.
    inner: States<D>,
}

impl<const D: usize> Coupling<D> {
    /// Of an assembled flow.
    pub fn new(parts: &Assembled<D>, guard: Option<Guard<D>>, levels: Vec<Level<D>>) -> Self {
        Coupling {
            diffused: parts.diffused,
            scalars: scalars(&parts.flow),
            guard,
            levels,
            inner: Vec::new(),
        }
    }

    /// An evaluation of a flow, in which its zones come to its time.
    ///
    /// Particles of the band have the densities around them each time forces are computed, and those of the overlap behind
    /// it have them in the mean: while particles that came in find their order, the sums of their kernels fall, and a
    /// pressure that follows the sums holds back the flow.
    ///
    /// # Errors
    /// Those of the flow, and of its zones.
    pub fn evaluate(&mut self, flow: &mut Flow<D>) -> Result<(), StepError> {
        if self.guard.is_none() && self.levels.is_empty() {
            return flow.evaluate();
        }
        let mut band = Vec::new();
        flow.evaluate_with(|flow, restored| {
            if let Some(guard) = self.guard.as_ref() {
                let frame = guard.frame.at(flow);
                let around = guard.states(flow, |x| !frame.in_core(x))?;
                let position = flow.world.free.get(fields::POSITION)?;
                let beyond = |(k, _): &(usize, State<D>)| !frame.holds(&position[*k], 0.0);
                let (outer, overlap): (States<D>, States<D>) = around.into_iter().partition(beyond);
                band = outer;
                // A state to which a run came back has these densities, and the same bits: sums of the same constants.
                if !restored {
                    let means = with_mean_densities(flow, &overlap)?;
                    move_densities(self.diffused, flow, &means, 1.0)?;
                    move_densities(self.diffused, flow, &band, 1.0)?;
                    flow.sum_densities()?;
                }
                set_densities(flow, &band)?;
            }
            self.inner.clear();
            flow.finer_loads.clear();
            for level in &mut self.levels {
                self.inner.extend(level.follow(flow)?);
                flow.finer_loads.extend(level.loads()?);
            }
            let velocity = flow.world.free.get_mut(fields::VELOCITY)?;
            let states = band.iter();
            states.for_each(|(k, state)| velocity[*k] = state.velocity);
            move_scalars(&self.scalars, flow, &band, 1.0)
        })?;
        match &self.guard {
            Some(guard) => accelerate(flow, &band, &guard.frame.at(flow)),
            None => Ok(()),
        }
    }

    /// A step of `dt` seconds of an assembled flow, not beyond `target` (s).
    ///
    /// # Errors
    /// Those of the integrator, of particles that cannot come in.
    pub fn step(
        &mut self,
        parts: &mut Assembled<D>,
        dt: f64,
        target: f64,
    ) -> Result<(), StepError> {
        let flow = &mut parts.flow;
        let time = flow.world.time;
        flow.world.dt = dt;
        self.begin_step(flow, dt)?;
        parts.integrator.step(flow, dt)?;
        flow.let_out(dt)?;
        flow.let_in(dt)?;
        if let Some(guard) = &self.guard {
            guard.lead_walls(flow)?;
            spread(flow, &guard.frame.at(flow))?;
        }
        // A drift in parts may end one rounding short of its aim, and the sliver that is left
        // be too short for its parts to move the clock: for ever.
        if time + dt >= target * (1.0 - 1e-12) {
            flow.world.time = target;
        }
        match &self.guard {
            Some(guard) => guard.exchange(flow),
            None => Ok(()),
        }
    }

    /// Before a step of `dt` seconds: particles that a zone leads go towards its densities and velocities.
    fn begin_step(&mut self, flow: &mut Flow<D>, dt: f64) -> Result<(), StepError> {
        if self.inner.is_empty() {
            return Ok(());
        }
        let speeds = flow.laws.iter().map(|law| law.reference().sound_speed);
        let time = RELAXATION * flow.world.kernel.smoothing_length() / speeds.fold(0.0, f64::max);
        let share = 1.0 - (-dt / time).exp();
        let velocity = flow.world.free.get_mut(fields::VELOCITY)?;
        for (k, state) in &self.inner {
            let own = velocity[*k];
            velocity[*k] += (state.velocity - own) * share;
        }
        move_scalars(&self.scalars, flow, &self.inner, share)?;
        move_densities(self.diffused, flow, &self.inner, share)
    }

    /// Accelerates the particles of the band as those around it.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn hold(&self, flow: &mut Flow<D>) -> Result<(), StepError> {
        let Some(guard) = &self.guard else {
            return Ok(());
        };
        let frame = guard.frame.at(flow);
        let band = guard.states(flow, |x| !frame.holds(x, 0.0))?;
        accelerate(flow, &band, &frame)
    }

    /// All zones, those within zones too.
    pub fn all_levels(&self) -> Vec<&Level<D>> {
        let mut all = Vec::new();
        for level in &self.levels {
            all.push(level);
            all.extend(level.stepper.coupling.all_levels());
        }
        all
    }

    /// The finest particles everywhere: those of a flow outside of its zones, by their places, and those of each zone.
    ///
    /// # Errors
    /// If there are no positions.
    pub fn finest<'a>(&'a self, flow: &'a Flow<D>) -> Result<Vec<Particles<'a, D>>, StepError> {
        self.finest_within(flow, &|_| true)
    }

    fn finest_within<'a>(
        &'a self,
        flow: &'a Flow<D>,
        wanted: &dyn Fn(&Vect<D>) -> bool,
    ) -> Result<Vec<Particles<'a, D>>, StepError> {
        let position = flow.world.free.get(fields::POSITION)?;
        let frames: Vec<_> = self.levels.iter().map(Level::frame).collect();
        let finer = |x: &Vect<D>| frames.iter().any(|frame| frame.holds(x, 0.0));
        let own = |k: &usize| wanted(&position[*k]) && !finer(&position[*k]);
        let mut all = vec![(flow, (0..position.len()).filter(own).collect())];
        for (level, frame) in self.levels.iter().zip(&frames) {
            let zone = &level.stepper;
            let inside = |x: &Vect<D>| frame.holds(x, 0.0);
            all.extend(zone.coupling.finest_within(&zone.parts.flow, &inside)?);
        }
        Ok(all)
    }

    /// Sizes of all zones at the start.
    pub fn sizes(&self) -> Vec<ZoneSize> {
        let of = |level: &&Level<D>| {
            let world = &level.stepper.parts.flow.world;
            ZoneSize {
                name: level.name.clone(),
                spacing: world.spacing,
                particles: world.free.len(),
            }
        };
        self.all_levels().iter().map(of).collect()
    }

    /// A probe that a zone measures, with the particles of that.
    pub fn measuring(&self, probe: &str) -> Option<(&dyn Probe<D>, &World<D>)> {
        let all = self.all_levels().into_iter();
        let mut measured = all.filter_map(|level| {
            let parts = &level.stepper.parts;
            let (_, own) = parts.probes.iter().find(|(name, _)| name == probe)?;
            Some((&**own, &parts.flow.world))
        });
        measured.next()
    }

    /// Measures the forces on walls that probes of zones read.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn measure_walls(&mut self) -> Result<(), StepError> {
        for level in &mut self.levels {
            let parts = &mut level.stepper.parts;
            measure_walls(&mut parts.flow, &parts.probes)?;
            level.stepper.coupling.measure_walls()?;
        }
        Ok(())
    }

    /// Keeps the states of all zones for the flow `depth` levels below the coarsest.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn keep(&mut self, depth: usize) -> Result<(), StepError> {
        (self.levels.iter_mut()).try_for_each(|level| level.keep(depth))
    }

    /// Puts them back.
    ///
    /// # Errors
    /// If lists cannot be built.
    pub fn put_back(&mut self, depth: usize) -> Result<(), StepError> {
        (self.levels.iter_mut()).try_for_each(|level| level.put_back(depth))
    }
}

/// States with the particles' own densities, moved by the mean difference to those of `led` within a fit's radius: what
/// single particles have beside it keeps them apart.
fn with_mean_densities<const D: usize>(
    flow: &Flow<D>,
    led: &States<D>,
) -> Result<States<D>, StepError> {
    let free = &flow.world.free;
    let (position, density) = (free.get(fields::POSITION)?, free.get(fields::DENSITY)?);
    let domain = &flow.world.domain;
    let places: Vec<Vect<D>> = led.iter().map(|(k, _)| position[*k]).collect();
    let missing = led.iter().map(|(k, state)| state.density - density[*k]);
    let missing: Vec<f64> = missing.collect();
    let near = NearbyPlaces::new(&places, REACH * flow.world.spacing, domain);
    let mean = |(k, state): &(usize, State<D>)| {
        let (mut weights, mut sum) = (0.0, 0.0);
        near.visit(&position[*k], |other, _, q| {
            let weight = weight(q);
            weights += weight;
            sum += weight * missing[other];
        });
        let density = density[*k] + sum / weights;
        (*k, State { density, ..*state })
    };
    Ok(led.par_iter().with_min_len(256).map(mean).collect())
}

/// Gives particles of the band their accelerations, and those of its outer half no shift: they lack neighbours, and a
/// shift towards the void would empty the band.
fn accelerate<const D: usize>(
    flow: &mut Flow<D>,
    band: &States<D>,
    frame: &Frame<D>,
) -> Result<(), StepError> {
    let free = &mut flow.world.free;
    let acceleration = free.get_mut(fields::ACCELERATION)?;
    for (k, state) in band {
        acceleration[*k] = state.acceleration;
    }
    if free.has(fields::SHIFT_VELOCITY.name) {
        let mut shift = free.take(fields::SHIFT_VELOCITY)?;
        let position = free.get(fields::POSITION)?;
        let outer = band.iter().filter(|(k, _)| frame.is_outer(&position[*k]));
        outer.for_each(|(k, _)| shift[*k] = Vect::zeros());
        free.put(fields::SHIFT_VELOCITY, shift)?;
    }
    Ok(())
}

/// Changes the integrated quantity so that densities go a share of the way to those of `led`. It may be the density itself.
fn move_densities<const D: usize>(
    diffused: Diffused,
    flow: &mut Flow<D>,
    led: &States<D>,
    share: f64,
) -> Result<(), StepError> {
    let gamma = flow.world.sum_renormalisation();
    let free = &flow.world.free;
    let (density, volume) = (free.get(fields::DENSITY)?, free.get(fields::VOLUME)?);
    let change = |(k, state): &(usize, State<D>)| {
        let gamma = gamma.map_or(1.0, |g| g[*k]);
        let slope = (diffused.per_density)(density[*k], volume[*k], gamma);
        (*k, share * slope * (state.density - density[*k]))
    };
    let changes: Vec<(usize, f64)> = led.iter().map(change).collect();
    let value = flow.world.free.get_mut(diffused.evolved.value)?;
    changes.iter().for_each(|(k, change)| value[*k] += change);
    Ok(())
}

/// Changes scalars of state by a share of the way to those of `led`.
fn move_scalars<const D: usize>(
    scalars: &[Field<Scalar>],
    flow: &mut Flow<D>,
    led: &States<D>,
    share: f64,
) -> Result<(), StepError> {
    for (n, field) in scalars.iter().enumerate() {
        let values = flow.world.free.get_mut(*field)?;
        for (k, state) in led {
            values[*k] += share * (state.scalars[n] - values[*k]);
        }
    }
    Ok(())
}

/// Gives particles the densities of another flow, to the last bit.
fn set_densities<const D: usize>(flow: &mut Flow<D>, led: &States<D>) -> Result<(), StepError> {
    let free = &mut flow.world.free;
    let mut density = free.take(fields::DENSITY)?;
    let mut volume = free.take(fields::VOLUME)?;
    let mass = free.get(fields::MASS)?;
    for (k, state) in led {
        density[*k] = state.density;
        volume[*k] = mass[*k] / state.density;
    }
    free.put(fields::DENSITY, density)?;
    Ok(free.put(fields::VOLUME, volume)?)
}

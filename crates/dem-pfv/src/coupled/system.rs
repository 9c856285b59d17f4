//! The coupled system: made, stepped, meshed anew.

use std::ops::Deref;

use serde::{Deserialize, Serialize};

use crate::coupled::limit::{Mode, combined, strongest_drag};
use crate::coupled::pores::{GIVEN, PRESSED, Places, Pores, transferred};
use crate::coupled::{CoupledError, FlowCondition, FlowSetup, StepLimit, WallBoundary, condition};
use crate::flow::{Conductance, HydraulicRadius, Storage};
use crate::grains::GrainSystem;
use crate::{POSITIVE, require, sphere};

/// Grains that move, and the fluid in the pores between them.
///
/// ```text
/// M dv/dt = F_contacts + W + S p,     G p = −dV/dt + Q
/// ```
///
/// A step finds the contacts' forces, then the pressures from the rates at which pores' volumes changed in the step
/// before, then moves the grains; the pressures are implicit, the motion explicit. Results are the same bit for bit on
/// any number of threads. Source: Catalano 2012, Eqs. (4.5), (4.8), §4.6 to §4.9.
///
/// The fluid's forces take the place of the grains' external forces, and of the walls'. Leave the non-viscous damping
/// of the grains at zero: the fluid damps.
pub struct CoupledSystem {
    pub(crate) grains: GrainSystem,
    pub(crate) setup: FlowSetup,
    pub(crate) law: Box<dyn Conductance>,
    pub(crate) pores: Pores,
    pub(crate) clock: PoreState,
    /// True if contacts were found where the grains are now.
    pub(crate) evaluated: bool,
    /// Flux into the pores through every wall at the last step, m³/s, if it is measured; none before the first.
    pub(crate) inflows: Option<Vec<f64>>,
}

/// State of the pores that is remembered from step to step.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct PoreState {
    /// Volumes of all cells where the grains are now, m³; they add up to the box.
    pub volumes: Vec<f64>,
    /// Rates at which they changed in the last step, m³/s; none before the first.
    pub rates: Vec<f64>,
    /// Pressures of all cells at the last step, Pa.
    pub pressures: Vec<f64>,
    /// Strain summed since the mesh was made.
    pub(crate) strain: f64,
    /// Steps since then.
    pub(crate) age: u64,
    /// Number of meshes made, the first included.
    pub meshes: u64,
    /// The last step, s; none before the first.
    pub(crate) last_step: Option<f64>,
    /// Step for which a fluid that gives way was factorised, s.
    pub(crate) storage_step: f64,
    /// Mode of strongest drag, and whether it is that of this mesh.
    pub(crate) mode: Mode,
    pub(crate) fresh: bool,
}

impl Deref for CoupledSystem {
    type Target = PoreState;

    fn deref(&self) -> &PoreState {
        &self.clock
    }
}

impl CoupledSystem {
    /// Fills the box of the grains with fluid, conductances by hydraulic radii.
    ///
    /// # Errors
    /// A viscosity or a bulk modulus that is not positive; conditions that mean nothing; periodic axes, meshes of
    /// triangles, walls that are no box; grains that overlap or reach into a wall by more than a tenth of their
    /// radius; stiff fluid without a given pressure. All name the grain, the wall or the cell.
    pub fn new(grains: GrainSystem, setup: FlowSetup) -> Result<Self, CoupledError> {
        Self::with_law(grains, setup, Box::new(HydraulicRadius::default()))
    }

    /// The same with a law for the conductances of throats.
    ///
    /// # Errors
    /// As [`CoupledSystem::new`].
    pub fn with_law(
        grains: GrainSystem,
        setup: FlowSetup,
        law: Box<dyn Conductance>,
    ) -> Result<Self, CoupledError> {
        setup.check(&grains)?;
        let places = Places::from_grains(&grains);
        let clock = PoreState {
            meshes: 1,
            storage_step: 0.1 * grains.critical_step(),
            ..PoreState::default()
        };
        let mut system = Self::meshed(grains, setup, law, (places, GIVEN), clock)?;
        let clock = &mut system.clock;
        clock.volumes = system.pores.geometry.volumes.to_vec();
        clock.rates = vec![0.0; clock.volumes.len()];
        clock.pressures = clock.rates.clone();
        Ok(system)
    }

    /// With the mesh of grains at their places and the deepest overlap.
    pub(crate) fn meshed(
        grains: GrainSystem,
        setup: FlowSetup,
        law: Box<dyn Conductance>,
        (places, deepest): (Places, f64),
        clock: PoreState,
    ) -> Result<Self, CoupledError> {
        let step = clock.storage_step;
        Ok(Self {
            pores: Pores::new(places, &grains, &setup, &*law, step, deepest)?,
            grains,
            setup,
            law,
            clock,
            evaluated: false,
            inflows: None,
        })
    }

    fn evaluate(&mut self) -> Result<(), CoupledError> {
        if !self.evaluated {
            self.grains.evaluate()?;
            self.evaluated = true;
        }
        Ok(())
    }

    /// Makes a step (s).
    ///
    /// # Errors
    /// [`CoupledError::StepTooLarge`] above [`CoupledSystem::step_limit`]; nothing is moved then. What
    /// [`CoupledSystem::step_unchecked`] may refuse.
    pub fn step(&mut self, step: f64) -> Result<(), CoupledError> {
        require("the step is", step, POSITIVE, step > 0.0)?;
        self.evaluate()?;
        self.store(step)?;
        let limit = self.limit_here()?;
        if step > limit.step {
            return Err(CoupledError::StepTooLarge(step, limit));
        }
        self.step_unchecked(step)
    }

    /// Makes a step (s) without asking whether it is stable.
    ///
    /// # Errors
    /// A step that is not positive; grains that flew away, that overlap or reach into walls by more than half their
    /// radius when pores are made anew; a system that cannot be solved.
    pub fn step_unchecked(&mut self, step: f64) -> Result<(), CoupledError> {
        require("the step is", step, POSITIVE, step > 0.0)?;
        self.evaluate()?;
        // Volumes changed, and fluid gave way, over the last step.
        self.store(self.clock.last_step.unwrap_or(step))?;
        self.press()?;
        let before = Places::from_grains(&self.grains);
        self.evaluated = false;
        self.grains.integrate_unchecked(step)?;
        let here = Places::from_grains(&self.grains);
        self.clock.last_step = Some(step);
        let strain = self.measure_rates(&here, step);
        self.clock.strain += strain;
        self.clock.age += 1;
        let (clock, remeshing) = (&self.clock, self.setup.remeshing);
        let strained = remeshing.strain.is_some_and(|most| clock.strain >= most);
        if strained || remeshing.most_steps.is_some_and(|n| clock.age >= n) {
            self.rebuild(here.clone())?;
            self.clock.volumes = self.pores.volumes(&before);
            self.measure_rates(&here, step);
        }
        Ok(())
    }

    /// Steps at a share `safety` of the limit until a time (s) is reached; returns the number of steps.
    ///
    /// # Errors
    /// As [`CoupledSystem::step`]; a share that is not between 0 and 1.
    pub fn run_to(&mut self, time: f64, safety: f64) -> Result<u64, CoupledError> {
        let fine = safety > 0.0 && safety <= 1.0;
        require("the share of the limit is", safety, "in (0, 1]", fine)?;
        let mut steps = 0;
        while self.time() < time {
            let step = safety * self.step_limit()?.step;
            self.step_unchecked(step.min(time - self.time()).max(1e-3 * step))?;
            steps += 1;
        }
        Ok(steps)
    }

    /// Largest stable step where the grains are now, from contacts and drag together:
    ///
    /// ```text
    /// λ_max Δt / 2 + ω_max² Δt² / 4 < 1
    /// ```
    ///
    /// λ by power iterations once per mesh, plus a bound for forces between neighbours, ω by a bound that is found
    /// anew every hundred steps. Walls that follow a servo count as fixed. The rule of the thesis, Eq. (4.20), takes
    /// every grain as if it moved alone and is too long by a factor of three to six for narrow gradings.
    ///
    /// # Errors
    /// A system that cannot be solved.
    pub fn step_limit(&mut self) -> Result<StepLimit, CoupledError> {
        self.evaluate()?;
        let mut limit = self.limit_here()?;
        if self.setup.fluid.bulk_modulus.is_some() {
            // A stiffer answer in a longer step: halve the distance to what holds for the last one.
            for _ in 0..6 {
                let last = self.clock.storage_step;
                if limit.step >= last && limit.step < 1.1 * last {
                    break;
                }
                self.store((limit.step * last).sqrt())?;
                limit = self.limit_here()?;
            }
            limit.step = limit.step.min(self.clock.storage_step);
        }
        Ok(limit)
    }

    fn limit_here(&mut self) -> Result<StepLimit, CoupledError> {
        if !self.clock.fresh {
            let mode = std::mem::take(&mut self.clock.mode);
            self.clock.mode = strongest_drag(&self.grains, &mut self.pores, mode)?;
            self.clock.fresh = true;
        }
        let mode = &self.clock.mode;
        let (mut rate, mut grain) = (mode.rate, mode.grain);
        if let Some(edges) = &self.pores.edges {
            let (more, there) = edges.rate(&self.grains, &self.setup.fluid);
            grain = if more > rate { there } else { grain };
            rate += more;
        }
        Ok(combined(self.grains.current_limit(), rate, grain))
    }

    /// Pressures of the rates of now, and the fluid's forces on grains and walls.
    fn press(&mut self) -> Result<(), CoupledError> {
        use FlowCondition::{Recorded, Wave};
        let varies = |s: &WallBoundary| matches!(s.condition, Wave(_) | Recorded(_));
        if self.setup.sides.iter().any(varies) {
            self.pores.refresh(&self.setup, self.grains.time);
        }
        let (pores, clock) = (&mut self.pores, &mut self.clock);
        pores.system.start_from(&clock.pressures)?;
        let (boundary, rates) = (&pores.boundary, &clock.rates);
        let pressures = pores.system.step(boundary, rates, &clock.pressures)?;
        if let Some(inflows) = &mut self.inflows {
            let before = &clock.pressures;
            let influx = pores.system.influx(boundary, rates, before, &pressures);
            *inflows = condition::inflows(&self.setup.sides, &pores.geometry, &influx);
        }
        clock.pressures = pressures;
        let forces = pores.forces.apply(&clock.pressures);
        let (on_grains, on_walls) = forces.split_at(self.grains.grains.len());
        let lift = -self.setup.fluid.density * self.grains.gravity;
        let grains = &mut self.grains.grains;
        for (k, f) in on_grains.iter().enumerate() {
            grains.external_force[k] = f + lift * sphere(grains.radius[k]);
        }
        for (wall, f) in self.grains.walls.iter_mut().zip(on_walls) {
            wall.external_force = *f;
        }
        if let Some(edges) = &pores.edges {
            let [forces, torques, walls] = edges.apply(&self.grains, &self.setup.fluid);
            let grains = &mut self.grains.grains;
            for (external, f) in grains.external_force.iter_mut().zip(&forces) {
                *external += f;
            }
            grains.external_torque.copy_from_slice(&torques);
            for (wall, f) in self.grains.walls.iter_mut().zip(&walls) {
                wall.external_force += f;
            }
        }
        Ok(())
    }

    /// Prepares a fluid that gives way for a step (s).
    fn store(&mut self, step: f64) -> Result<(), CoupledError> {
        if let Some(bulk_modulus) = self.setup.fluid.bulk_modulus
            && step != self.clock.storage_step
        {
            let storage = Storage { bulk_modulus, step };
            self.pores.system.set_storage(storage)?;
            self.clock.storage_step = step;
            self.clock.fresh = false;
        }
        Ok(())
    }

    /// Volumes of now and their rates over the last step (s); returns the largest strain of a pore.
    fn measure_rates(&mut self, here: &Places, step: f64) -> f64 {
        let volumes = self.pores.volumes(here);
        let clock = &mut self.clock;
        let mut largest = 0.0_f64;
        for ((rate, new), old) in clock.rates.iter_mut().zip(&volumes).zip(&clock.volumes) {
            *rate = (new - old) / step;
            largest = largest.max(((new - old) / old).abs());
        }
        clock.volumes = volumes;
        largest
    }

    /// Makes the mesh anew where the grains are; rates are left to the caller.
    fn rebuild(&mut self, places: Places) -> Result<(), CoupledError> {
        let (setup, step) = (&self.setup, self.clock.storage_step);
        let pores = Pores::new(places, &self.grains, setup, &*self.law, step, PRESSED)?;
        let clock = &mut self.clock;
        clock.pressures = transferred(&self.pores, &clock.pressures, &pores);
        clock.volumes = pores.geometry.volumes.to_vec();
        clock.rates = vec![0.0; clock.volumes.len()];
        (clock.strain, clock.age, clock.fresh) = (0.0, 0, false);
        clock.meshes += 1;
        self.pores = pores;
        Ok(())
    }

    /// Makes the mesh anew now: after grains or walls were moved through [`CoupledSystem::grains_mut`]. The motion from
    /// outside counts for no pressure.
    ///
    /// # Errors
    /// Grains that overlap or reach into walls by more than half their radius.
    pub fn remesh(&mut self) -> Result<(), CoupledError> {
        self.rebuild(Places::from_grains(&self.grains))
    }

    /// Sets the condition at a wall. Another value costs nothing; another kind of condition makes a new matrix, another
    /// grip new throats.
    ///
    /// # Errors
    /// A wall that is not there, a condition that means nothing, a stiff fluid without a given pressure; the old
    /// condition stays then.
    pub fn set_side(&mut self, wall: usize, side: WallBoundary) -> Result<(), CoupledError> {
        side.check(wall)?;
        let Some(slot) = self.setup.sides.get_mut(wall) else {
            let problem = "is at no wall: there are six";
            return Err(CoupledError::BadCondition(wall, problem));
        };
        let old = std::mem::replace(slot, side.clone());
        let same = old.sticks == side.sticks;
        let done = if same && old.presses() == side.presses() {
            self.pores.refresh(&self.setup, self.grains.time);
            Ok(())
        } else if same {
            let now = [self.grains.time, self.clock.storage_step];
            self.clock.fresh = false;
            self.pores.reassemble(&self.setup, &*self.law, now)
        } else {
            self.remesh()
        };
        if done.is_err() {
            self.setup.sides[wall] = old;
        }
        done
    }
}

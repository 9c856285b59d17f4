//! The energy budget: how much energy each term has given to every particle. Only where a probe reads it.

use rayon::prelude::*;
use sph_contribution::StepPhase;
use sph_core::{Field, FieldError, Role, Scalar, StepError, Vect, Work, fields, kind_of};
use sph_multiphase::{Diffused, Formulation};
use sph_neighbours::{ClassRate, Interaction, World, class_rates, interactions};
use sph_probes::{BOOKED_COMPRESSION, ENERGY_AT_START, ENERGY_WORKS, EnergyWork, work_of_stranger};
use sph_rheology::state::Laws;

use crate::step::flow::Flow;
use crate::step::hooks::{Boundary, ObservedFlow, Observer};

const BATCH: usize = 1024;

type Account = Field<Scalar>;

fn own(work: EnergyWork) -> Account {
    ENERGY_WORKS[work as usize]
}

/// Classes of terms with rates of their own; the pressure has the rest of the acceleration.
const CLASSES: [EnergyWork; 6] = [
    EnergyWork::Viscosity,
    EnergyWork::Smoother,
    EnergyWork::Shifting,
    EnergyWork::Damper,
    EnergyWork::Surface,
    EnergyWork::Others,
];

/// The account of the work of a kind's terms; none of the pressure's.
fn of_terms(kind: &str) -> Option<Account> {
    Some(match kind_of(kind).map(|kind| kind.work) {
        Some(Work::Pressure) => return None,
        Some(Work::Friction) => own(EnergyWork::Viscosity),
        Some(Work::Smoothing) => own(EnergyWork::Smoother),
        Some(Work::Shifting) => own(EnergyWork::Shifting),
        Some(Work::Damping) => own(EnergyWork::Damper),
        Some(Work::Surface) => own(EnergyWork::Surface),
        Some(Work::Own) => work_of_stranger(kind),
        Some(Work::Others) | None => own(EnergyWork::Others),
    })
}

fn of_hooks(kind: &str) -> Account {
    match kind_of(kind).map(|kind| kind.work) {
        Some(Work::Damping) => own(EnergyWork::Damping),
        _ => of_terms(kind).unwrap_or(own(EnergyWork::Others)),
    }
}

/// Counts the work of all terms on every particle, step by step.
pub struct EnergyBudget<const D: usize> {
    diffused: Diffused,
    /// True if densities are sums over positions, which shifts change.
    summed: bool,
    /// −D lnρ/Dt by motion.
    dilatation: [Box<dyn Interaction<D>>; 1],
    laws: Laws,
    /// The account of every term, by its name; none: the pressure.
    terms: Vec<(String, Option<Account>)>,
    /// [`CLASSES`] and those of strangers.
    classes: Vec<Account>,
    hooks: Vec<Account>,
    kicker: Option<usize>,
    /// Velocities before the kick, m/s.
    before: Vec<Vect<D>>,
    /// Velocities as booked, m/s.
    velocity: Vec<Vect<D>>,
    /// Changes of velocities in this kick by work, m/s, and to densities, kg/m³.
    turns: Vec<(Account, Vec<Vect<D>>)>,
    changes: Vec<(Account, Vec<f64>)>,
    /// Rates of all classes before the kick, those of a particle together.
    rates: Vec<ClassRate<D>>,
    /// The integrated quantity of the formulation, as booked.
    scalar: Vec<f64>,
    /// Densities as booked, kg/m³.
    density: Vec<f64>,
}

fn add_work<const D: usize>(
    world: &mut World<D>,
    field: Field<Scalar>,
    amounts: &[f64],
) -> Result<(), FieldError> {
    let column = world.free.get_mut(field)?.par_iter_mut();
    let all = column.zip(amounts).with_min_len(BATCH);
    all.for_each(|(sum, amount)| *sum += amount);
    Ok(())
}

/// A number for each of so many particles.
fn per_particle(particles: usize, one: impl Fn(usize) -> f64 + Sync + Send) -> Vec<f64> {
    let all = (0..particles).into_par_iter().with_min_len(BATCH);
    all.map(one).collect()
}

impl<const D: usize> Observer<D> for EnergyBudget<D> {
    fn observe(&mut self, at: Boundary, seen: &mut ObservedFlow<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *seen.world, seen.dt);
        match at {
            Boundary::Evaluated => Ok(self.evaluated(world)?),
            Boundary::Kicks => self.before_kick(world, seen.terms),
            Boundary::Kicked => Ok(self.kicked(world, dt)?),
            Boundary::Hooked(StepPhase::AfterKick, k) => Ok(self.record_hook(world, k)?),
            Boundary::KickEnds => self.settled(world, dt),
            Boundary::Hooked(StepPhase::BeforeWalls | StepPhase::BeforeDrift, k) => {
                Ok(self.turned(world, self.hooks[k])?)
            }
            Boundary::Hooked(..) => Ok(()),
            Boundary::Constrained => Ok(self.turned(world, own(EnergyWork::Walls))?),
            Boundary::Drifts => self.drifts(world, dt),
        }
    }
}

impl<const D: usize> EnergyBudget<D> {
    /// Empty books of a flow in which kinds of strangers are. Adds their columns to the particles.
    pub(crate) fn open(
        formulation: &dyn Formulation<D>,
        flow: &mut Flow<D>,
        strangers: &[&str],
    ) -> Result<Self, FieldError> {
        let world = &mut flow.world;
        let all = [ENERGY_AT_START, BOOKED_COMPRESSION];
        let strange = || strangers.iter().map(|kind| work_of_stranger(kind));
        for field in ENERGY_WORKS.into_iter().chain(strange()).chain(all) {
            world.free.add(field, Role::State);
        }
        // Not a number: nothing has been booked.
        world.free.get_mut(BOOKED_COMPRESSION)?.fill(f64::NAN);
        Ok(EnergyBudget {
            diffused: formulation.diffused(),
            summed: formulation.compressed().is_none(),
            dilatation: [formulation.dilatation()],
            laws: flow.laws.clone(),
            terms: (flow.kinds.iter())
                .map(|(name, kind)| (name.clone(), of_terms(kind)))
                .collect(),
            classes: CLASSES.map(own).into_iter().chain(strange()).collect(),
            hooks: (flow.hooks.all.iter())
                .map(|hook| of_hooks(hook.kind))
                .collect(),
            kicker: flow.hooks.kicking.first().copied(),
            before: Vec::new(),
            velocity: Vec::new(),
            turns: Vec::new(),
            changes: Vec::new(),
            rates: Vec::new(),
            scalar: Vec::new(),
            density: Vec::new(),
        })
    }

    /// After an evaluation: the work of compression by the motion since the last entry.
    fn evaluated(&self, world: &mut World<D>) -> Result<(), FieldError> {
        let density = world.free.get(fields::DENSITY)?;
        let now = self.compression(world, density)?;
        let booked = world.free.get(BOOKED_COMPRESSION)?;
        if booked.iter().any(|b| b.is_nan()) {
            let (mass, velocity) = world.free.all((fields::MASS, fields::VELOCITY))?;
            let position = world.free.get(fields::POSITION)?;
            let start = per_particle(now.len(), |i| {
                let high = -world.steady_gravity.dot(&position[i]);
                now[i] + mass[i] * (0.5 * velocity[i].norm_squared() + high)
            });
            *world.free.get_mut(ENERGY_AT_START)? = start;
        } else {
            let more = per_particle(now.len(), |i| now[i] - booked[i]);
            add_work(world, own(EnergyWork::Remainder), &more)?;
        }
        *world.free.get_mut(BOOKED_COMPRESSION)? = now;
        Ok(())
    }

    /// Before a kick: the work of every class of terms in it.
    fn before_kick(
        &mut self,
        world: &World<D>,
        terms: &[Box<dyn Interaction<D>>],
    ) -> Result<(), StepError> {
        let class = |name: &str| {
            let known = self.terms.iter().find(|(n, _)| n == name);
            let others = own(EnergyWork::Others);
            let work = known.map_or(Some(others), |(_, work)| *work)?;
            let class = |work| self.classes.iter().position(|c| *c == work);
            class(work).or_else(|| class(others))
        };
        let terms: Vec<_> = terms.iter().map(|t| &**t).collect();
        self.rates = class_rates(world, &terms, self.classes.len(), class)?;
        let free = &world.free;
        free.get(fields::VELOCITY)?.clone_into(&mut self.before);
        free.get(fields::DENSITY)?.clone_into(&mut self.density);
        // The rest of a step that failed.
        self.turns.clear();
        self.changes.clear();
        Ok(())
    }

    /// After the kick proper over `dt` seconds.
    fn kicked(&mut self, world: &World<D>, dt: f64) -> Result<(), FieldError> {
        let now = world.free.get(fields::VELOCITY)?;
        if let Some(kicker) = self.kicker {
            let acceleration = world.free.get(fields::ACCELERATION)?.iter();
            let before = self.before.iter().zip(acceleration);
            let more = now.iter().zip(before).map(|(u, (v, a))| u - v - a * dt);
            self.turns.push((self.hooks[kicker], more.collect()));
        }
        now.clone_into(&mut self.velocity);
        let scalar = world.free.get(self.diffused.evolved.value)?;
        scalar.clone_into(&mut self.scalar);
        Ok(())
    }

    /// After the hook number `k` has worked on velocities and scalars that have been advanced.
    fn record_hook(&mut self, world: &World<D>, k: usize) -> Result<(), FieldError> {
        let of = self.hooks[k];
        let now = world.free.get(fields::VELOCITY)?;
        if now != self.velocity {
            let change = now.iter().zip(&self.velocity).map(|(u, v)| u - v);
            self.turns.push((of, change.collect()));
            now.clone_into(&mut self.velocity);
        }
        let scalar = world.free.get(self.diffused.evolved.value)?;
        if scalar != self.scalar {
            let volume = world.free.get(fields::VOLUME)?;
            let gamma = world.sum_renormalisation();
            let change = per_particle(scalar.len(), |i| {
                let gamma = gamma.map_or(1.0, |g| g[i]);
                let slope = (self.diffused.per_density)(self.density[i], volume[i], gamma);
                (scalar[i] - self.scalar[i]) / slope
            });
            self.changes.push((of, change));
            scalar.clone_into(&mut self.scalar);
        }
        Ok(())
    }

    /// After a kick over `dt` seconds and all that followed: the work of all parts, with the mean of the velocities
    /// before and after.
    fn settled(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mean = self.before.iter().zip(&self.velocity);
        let mean: Vec<Vect<D>> = mean.map(|(a, b)| (a + b) * 0.5).collect();
        let n = mean.len();
        let mass = world.free.get(fields::MASS)?.to_vec();
        let work = |i: usize, gain: Vect<D>| mass[i] * gain.dot(&mean[i]);
        let rates = |i: usize| &self.rates[i * self.classes.len()..][..self.classes.len()];
        for (class, of) in self.classes.iter().enumerate() {
            let steady = match *of == own(EnergyWork::Others) {
                true => world.driving + (world.gravity - world.steady_gravity),
                false => Vect::zeros(),
            };
            let done = per_particle(n, |i| work(i, (rates(i)[class].acceleration + steady) * dt));
            add_work(world, *of, &done)?;
        }
        for (of, turn) in std::mem::take(&mut self.turns) {
            add_work(world, of, &per_particle(n, |i| work(i, turn[i])))?;
        }
        let dilatation = self.dilatation_with(world, mean.clone())?;
        let free = &world.free;
        let (volume, pressure) = (free.get(fields::VOLUME)?, free.get(fields::PRESSURE)?);
        let acceleration = free.get(fields::ACCELERATION)?;
        let compressed = per_particle(n, |i| -volume[i] * pressure[i] * dilatation[i] * dt);
        let pushed = per_particle(n, |i| {
            let others = rates(i).iter().map(|rate| rate.acceleration);
            let push = acceleration[i] - world.gravity - world.driving - others.sum::<Vect<D>>();
            work(i, push * dt) + compressed[i]
        });
        add_work(world, own(EnergyWork::Walls), &pushed)?;
        add_work(world, BOOKED_COMPRESSION, &compressed)?;
        // What the weight has given; `drifts` takes what the drift costs.
        let fallen = per_particle(n, |i| work(i, world.steady_gravity * dt));
        add_work(world, own(EnergyWork::Remainder), &fallen)?;
        // Densities in the middle of the motion: a term that changes them in this step does it all along.
        let all = self.density.par_iter_mut().zip(&dilatation);
        all.for_each(|(rho, rate)| *rho *= 1.0 - 0.5 * rate * dt);
        self.spread(world, dt)
    }

    /// Changes of the density over `dt` seconds: diffusion, class by class, and hooks.
    fn spread(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let changes = std::mem::take(&mut self.changes);
        if world.free.has(self.diffused.evolved.rate.name) {
            for (class, of) in self.classes.clone().into_iter().enumerate() {
                let rates = self.rates.iter().skip(class).step_by(self.classes.len());
                if rates.clone().any(|rate| rate.scalar != 0.0) {
                    let change: Vec<f64> = rates.map(|rate| rate.scalar * dt).collect();
                    self.condensed(world, of, &change)?;
                }
            }
        }
        for (of, change) in changes {
            self.condensed(world, of, &change)?;
        }
        Ok(())
    }

    /// Books densities that were changed, kg/m³.
    fn condensed(
        &mut self,
        world: &mut World<D>,
        of: Account,
        change: &[f64],
    ) -> Result<(), FieldError> {
        let before = self.compression(world, &self.density)?;
        let all = self.density.iter_mut().zip(change);
        all.for_each(|(rho, change)| *rho += change);
        let after = self.compression(world, &self.density)?;
        let work = per_particle(before.len(), |i| after[i] - before[i]);
        add_work(world, BOOKED_COMPRESSION, &work)?;
        add_work(world, of, &work)
    }

    fn turned(&mut self, world: &mut World<D>, of: Account) -> Result<(), FieldError> {
        let (mass, now) = world.free.all((fields::MASS, fields::VELOCITY))?;
        let gain = per_particle(now.len(), |i| {
            0.5 * mass[i] * (now[i].norm_squared() - self.velocity[i].norm_squared())
        });
        now.to_vec().clone_into(&mut self.velocity);
        add_work(world, of, &gain)
    }

    /// Before a drift over `dt` seconds with the present velocities: weights and shifts.
    fn drifts(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mass = world.free.get(fields::MASS)?;
        let height = |i: usize, way: &Vect<D>| -mass[i] * world.steady_gravity.dot(way) * dt;
        let n = mass.len();
        let velocity = world.free.get(fields::VELOCITY)?;
        let lifted = per_particle(n, |i| height(i, &velocity[i]));
        let shift = world.free.get(fields::SHIFT_VELOCITY).ok();
        let shifted = shift.map(|s| per_particle(n, |i| height(i, &s[i])));
        add_work(world, own(EnergyWork::Remainder), &lifted)?;
        let Some(shifted) = shifted else {
            return Ok(());
        };
        add_work(world, own(EnergyWork::Shifting), &shifted)?;
        if !self.summed {
            return Ok(());
        }
        let velocity = world.free.get(fields::VELOCITY)?.to_vec();
        let shift = world.free.get(fields::SHIFT_VELOCITY)?;
        let both = velocity.iter().zip(shift).map(|(u, s)| u + s).collect();
        let without = self.dilatation_with(world, velocity)?;
        let with = self.dilatation_with(world, both)?;
        let change = per_particle(n, |i| -self.density[i] * (with[i] - without[i]) * dt);
        Ok(self.condensed(world, own(EnergyWork::Shifting), &change)?)
    }

    /// −D lnρ/Dt at the present positions if particles had these velocities, 1/s.
    fn dilatation_with(
        &self,
        world: &mut World<D>,
        velocity: Vec<Vect<D>>,
    ) -> Result<Vec<f64>, StepError> {
        let n = velocity.len();
        let kept = std::mem::replace(world.free.get_mut(fields::VELOCITY)?, velocity);
        let (mut unused, mut sum) = (vec![Vect::zeros(); n], vec![0.0; n]);
        let done = interactions(world, &self.dilatation, &mut unused, Some(&mut sum));
        *world.free.get_mut(fields::VELOCITY)? = kept;
        done.map(|()| sum)
    }

    /// Energy of compression, J.
    fn compression(&self, world: &World<D>, density: &[f64]) -> Result<Vec<f64>, FieldError> {
        let mass = world.free.get(fields::MASS)?;
        let phase = world.free.get(fields::PHASE).ok();
        Ok(per_particle(mass.len(), |i| {
            let law = &self.laws[phase.map_or(0, |p| p[i] as usize)];
            mass[i] * law.internal_energy(density[i])
        }))
    }
}

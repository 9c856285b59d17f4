//! The stage that solves for the pressure, to which bodies give way.

use nalgebra::Vector6;
use sph_core::{Access, Declares, Pool, Stage, StepError, Vect, fields};
use sph_neighbours::{FreeBody, World, interactions, lattice_sum};
use sph_rheology::state::BoundState;

use crate::linear::{
    Assembly, Automatic, Entries, LinearSolver, LowRank, Matrix, Operator, ParticleMatrix,
};
use crate::pressure::system::{ClusterCoefficients, Couplings, Part};
use crate::{Acting, FREE_SURFACE, Place};

const NAME: &str = "implicit pressure";

/// Density over that at rest at which the largest tension of a law is taken.
const TORN: f64 = 0.5;

/// Applies the equations of state, and solves for the pressure of the end of the step.
pub(crate) struct SolvePressure<const D: usize> {
    acting: Acting<D>,
    /// The lowest pressure of every law, Pa.
    floors: Vec<f64>,
    solver: Automatic<1>,
    scratch: Scratch<D>,
}

/// Share of the density that the density constant has to make up for at a surface: the first row lacks some 0.3 of its support,
/// beside walls and between phases sums are off by 0.02.
const OPEN: f64 = 0.15;

/// Buffers of a solve, kept for their memory.
#[derive(Default)]
struct Scratch<const D: usize> {
    rate: Vec<f64>,
    /// The sweep sums accelerations, too; they are not read.
    unused: Vec<Vect<D>>,
    parts: Vec<Part>,
    assembly: Assembly<f64, 1>,
    pressure: Vec<Vect<1>>,
    scratch_pool: Pool<ClusterCoefficients>,
}

impl<const D: usize> Declares for SolvePressure<D> {
    fn name(&self) -> String {
        NAME.into()
    }
    fn access(&self) -> Access {
        let access = self.acting.state.access();
        let access = access.and(self.acting.dilatation.access());
        let access = access
            .both((fields::POSITION, fields::VOLUME, fields::DENSITY))
            // A solve starts from the pressure of the step before.
            .remembers(fields::PRESSURE)
            .where_there((fields::DENSITY_CONSTANT, fields::RENORMALISATION))
            .where_there(fields::PHASE);
        match self.acting.surfaces {
            true => access.here(FREE_SURFACE),
            false => access,
        }
    }
}

impl<const D: usize> Stage<World<D>> for SolvePressure<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let before = world.free.get(fields::PRESSURE)?.iter();
        let x = &mut self.scratch.pressure;
        x.clear();
        x.extend(before.map(|p| Vect::from([*p])));
        self.acting.state.run(world)?;
        // Later a resumed run would meet a check that an uninterrupted one did not.
        if !self.acting.surfaces && world.time <= 0.0 {
            refuse_surfaces(world)?;
        }
        match world.dt > 0.0 && world.dt.is_finite() {
            true => self.solve(world),
            false => Ok(()),
        }
    }
    fn bytes(&self) -> usize {
        self.scratch.assembly.bytes() + size_of_val(&self.scratch.pressure[..])
    }
}

impl<const D: usize> SolvePressure<D> {
    pub fn new(acting: Acting<D>, solver: Automatic<1>) -> Self {
        let floor = |law: &dyn BoundState| {
            let mut pressure = [0.0];
            law.pressure(&[TORN * law.reference().density], &mut pressure);
            pressure[0]
        };
        SolvePressure {
            floors: acting.laws.iter().map(|law| floor(&**law)).collect(),
            acting,
            solver,
            scratch: Scratch::default(),
        }
    }

    fn solve(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.diverge(world)?;
        self.fill_parts(world)?;
        let space = world.space()?;
        let Scratch {
            parts,
            assembly,
            pressure: x,
            scratch_pool,
            ..
        } = &mut self.scratch;
        let scratch_pool = &*scratch_pool;
        let system = Couplings {
            owned: &space.owned,
            volume: world.free.get(fields::VOLUME)?,
            density: world.free.get(fields::DENSITY)?,
            gamma: world.free.get(fields::RENORMALISATION).ok(),
            parts,
            gravity: world.gravity,
            squared_step: world.dt * world.dt,
            full: 2.0 * world.spacing.powi(D as i32) * lattice_sum(world, |pair| -pair.factor),
        };
        assembly.fill_wanted(
            world,
            |i| system.owned.has(i),
            |rows, cluster| system.add(cluster, rows, scratch_pool),
            |rows, others| others.for_each(|_| Couplings::<D>::add_other(rows)),
        )?;
        let values = std::mem::take(&mut assembly.values);
        let matrix = Matrix::on(assembly.pattern.clone(), Entries::Scalar(values));
        let sources = &mut assembly.sources;
        let base = ParticleMatrix::new(&matrix, &space, None);
        let vectors = give_way(world, &base, sources, x)?;
        let operator = LowRank {
            base: &base,
            vectors: &vectors,
            sign: 1.0,
        };
        let solved = self.solver.solve(&operator, sources, x);
        if let Entries::Scalar(values) = matrix.entries {
            assembly.values = values;
        }
        solved.map_err(|error| StepError::stage(NAME, error))?;
        self.spread(world)
    }

    fn diverge(&mut self, world: &World<D>) -> Result<(), StepError> {
        let Scratch { rate, unused, .. } = &mut self.scratch;
        let n = world.free.len();
        rate.clear();
        rate.resize(n, 0.0);
        unused.resize(n, Vect::zeros());
        let terms = std::slice::from_ref(&self.acting.dilatation);
        interactions(world, terms, unused, Some(rate))
    }

    fn fill_parts(&mut self, world: &World<D>) -> Result<(), StepError> {
        let free = &world.free;
        let (volume, density) = free.all((fields::VOLUME, fields::DENSITY))?;
        let pressure = free.get(fields::PRESSURE)?;
        let gamma = free.get(fields::RENORMALISATION).ok();
        let phase = free.get(fields::PHASE).ok();
        let surface = self.acting.surfaces.then(|| free.get(FREE_SURFACE));
        let surface = surface.transpose()?;
        let row = world.gravity.norm() * world.spacing;
        let Scratch { parts, rate, .. } = &mut self.scratch;
        parts.clear();
        parts.extend((0..volume.len()).map(|i| {
            let law = &self.acting.laws[phase.map_or(0, |p| p[i] as usize)];
            let size = volume[i] * gamma.map_or(1.0, |g| g[i]);
            let stiffness = density[i] * law.sound_speed(density[i]).powi(2);
            let compliance = size / stiffness;
            Part {
                compliance,
                source: compliance * pressure[i] - world.dt * size * rate[i],
                // A row of fluid at the most: a density that is noise has no say.
                outside: pressure[i].clamp(0.0, row * density[i]),
                open: surface.is_some_and(|s| s[i] >= Place::Near.number()),
            }
        }));
        Ok(())
    }

    /// The solution to its column; a law's largest tension is that of the solution, too.
    fn spread(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let mut pressure = world.free.take(fields::PRESSURE)?;
        let phase = world.free.get(fields::PHASE).ok();
        for (i, (p, x)) in pressure.iter_mut().zip(&self.scratch.pressure).enumerate() {
            *p = x[0].max(self.floors[phase.map_or(0, |k| k[i] as usize)]);
        }
        Ok(world.free.put(fields::PRESSURE, pressure)?)
    }
}

/// Refuses supports that lack fluid where free surfaces are not defined: their pressure would float.
fn refuse_surfaces<const D: usize>(world: &World<D>) -> Result<(), StepError> {
    let columns = (fields::DENSITY_CONSTANT, fields::DENSITY);
    let Ok((constant, density)) = world.free.all(columns) else {
        return Ok(());
    };
    let lacks = |(k, rho): &(&f64, &f64)| **k > OPEN * **rho;
    match constant.iter().zip(density).filter(lacks).count() {
        0 => Ok(()),
        some => {
            let why = format!(
                "{some} particles are at a free surface, and the scene does not say what that is: add \
                 `[surface.cone-test]`"
            );
            Err(StepError::stage(NAME, why))
        }
    }
}

/// The force of the wall over Bᵀp that is reckoned with: it is 2 for a pressure that is the same everywhere, 2.5 were
/// measured for one that falls off from the body. With less than the true one light bodies swing from step to step,
/// with more they follow within some steps.
const RESPONSE: f64 = 4.0;

/// Share of bodies in the system of the pressure: p moves a body within the step, and the body the fluid.
///
/// With B_a = −γ_aV_a ∂(1/γ_a Σ_s u_s·∇γ_as)/∂(v, ω), W the mobility of a body, a its acceleration over the last step
/// and pⁿ the pressure before,
///
/// (A + 4Δt² B W Bᵀ) p = s − Δt² B (a − 4 W Bᵀ pⁿ): vⁿ⁺¹ = vⁿ + Δt [a + 4 W Bᵀ (p − pⁿ)].
///
/// All forces are in a, and p alone has changed since, so that a body at rest stays at rest; it may be lighter than
/// its added mass by any factor. Gives the vectors 2Δt B S, W = S Sᵀ, of that update.
pub(crate) fn give_way<const D: usize>(
    world: &World<D>,
    base: &dyn Operator<1>,
    right: &mut [Vect<1>],
    before: &[Vect<1>],
) -> Result<Vec<Vec<Vect<1>>>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let dt = world.dt;
    let mut vectors = Vec::new();
    for body in &world.walls.bodies {
        let first = vectors.len();
        for root in body.roots() {
            let along = |j: &Vector6<f64>| -(RESPONSE.sqrt() * dt) * j.dot(&root);
            let mut g = column(world, body, along, volume);
            base.import(&mut g);
            vectors.push(g);
        }
        if vectors.len() > first {
            let moved = column(world, body, |j| dt * dt * j.dot(&body.rate), volume);
            right.iter_mut().zip(moved).for_each(|(b, m)| *b += m);
        }
    }
    let shares: Vec<f64> = vectors.iter().map(|g| base.inner(g, before)).collect();
    for (g, share) in vectors.iter().zip(shares) {
        right.iter_mut().zip(g).for_each(|(b, g)| *b += g * share);
    }
    Ok(vectors)
}

/// V_a f(Σ_s (∇γ_as, r_s × ∇γ_as)) over the elements of a body, for every particle.
fn column<const D: usize>(
    world: &World<D>,
    body: &FreeBody<D>,
    of: impl Fn(&Vector6<f64>) -> f64,
    volume: &[f64],
) -> Vec<Vect<1>> {
    let walls = &world.walls;
    let one = |i: usize| {
        let mut sum = Vector6::zeros();
        for contact in walls.contacts.of_particle(i) {
            let s = contact.element as usize;
            if body.is(walls.elements.wall[s] as usize) {
                sum += body.along(&walls.elements.centre[s], &contact.gradient);
            }
        }
        Vect::from([volume[i] * of(&sum)])
    };
    (0..volume.len()).map(one).collect()
}

//! Friction from the end of the step: (M + θΔt K) uⁿ⁺¹ = M u* + Δt s − (1 − θ)Δt K uⁿ.
//!
//! M = diag(m_a γ_a) and K are those of [`sph_multiphase::Coupling`]; u* is the velocity after all
//! other forces. Where K depends on the velocity, it follows it (Picard). Pairs whose friction is weak act with uⁿ if θ = 1. Ghaïtanellis 2017, Eq. 5.3–5.6, made symmetric by the factor m_a γ_a.

use std::collections::BTreeMap;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use sph_core::{Stage, StepError, Vect, fields};
use sph_implicit::{
    Block, Entries, Entry, LinearSolver, Matrix, Report, Row, TimeScheme, Values, assemble, dot,
};
use sph_multiphase::{Coupling, Weak};
use sph_neighbours::{Neighbourhood, World};

use crate::step::held_back::HeldBack;

/// Coupling of a pair over its smaller mass up to which it is taken explicitly: hundreds of neighbours together are far from
/// the bound of 1, and a step of water beside mud has a matrix of the mud alone.
const SOFT: f64 = 1e-3;

/// Residual of a solve within an outer iteration, over the tolerance of the latter.
const INNER: f64 = 0.1;

/// Vectors of a solve: right-hand side, uⁿ, u*, what they start from, and those of conjugate gradients.
const VECTORS: usize = 8;

/// What the implicit solves of a run took.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Solves {
    /// How many systems were solved by each method.
    pub by_method: BTreeMap<String, u64>,
    /// Mean number of iterations of all, those before a factorisation included.
    pub mean_iterations: f64,
    /// Largest number of iterations.
    pub most_iterations: usize,
    /// Largest relative residual.
    pub largest_residual: f64,
    /// Wall-clock time of all solves, without putting the systems together, s.
    #[serde(default)]
    pub wall_seconds: f64,
    /// Most bytes of a matrix and of what the solver held for it.
    #[serde(default)]
    pub most_bytes: usize,
    /// How often the viscosity followed the velocity, where it depends on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outer: Option<OuterSolves>,
    /// What held a soil beyond its strength, with stresses of the end of the step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub held_back: Option<HeldBack>,
}

/// What iterating on the viscosity took.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct OuterSolves {
    /// Steps so far.
    pub steps: u64,
    /// Mean number of solves per step.
    pub mean_iterations: f64,
    /// Largest number of solves in a step.
    pub most_iterations: usize,
    /// Steps that did not reach the tolerance.
    pub unconverged: u64,
    /// Largest relative change of the velocity in the last iteration of a step.
    pub largest_change: f64,
}

impl OuterSolves {
    fn add(&mut self, iterations: usize, change: f64, converged: bool) {
        self.steps += 1;
        self.mean_iterations += (iterations as f64 - self.mean_iterations) / self.steps as f64;
        self.most_iterations = self.most_iterations.max(iterations);
        self.unconverged += u64::from(!converged);
        self.largest_change = self.largest_change.max(change);
    }
}

impl Solves {
    fn add(&mut self, report: &Report, seconds: f64, matrix: usize) {
        self.wall_seconds += seconds;
        self.most_bytes = self.most_bytes.max(matrix + report.bytes);
        *self.by_method.entry(report.method.to_string()).or_default() += 1;
        let all: u64 = self.by_method.values().sum();
        self.mean_iterations += (report.iterations as f64 - self.mean_iterations) / all as f64;
        self.most_iterations = self.most_iterations.max(report.iterations);
        self.largest_residual = self.largest_residual.max(report.residual);
    }
}

/// The viscous operator, a scheme and a solver.
pub struct ImplicitViscosity<const D: usize> {
    pub(crate) coupling: Box<dyn Coupling<D>>,
    pub(crate) scheme: Box<dyn TimeScheme>,
    pub(crate) solver: Box<dyn LinearSolver<D>>,
    /// What gives the viscosity of the present velocity; empty where it does not depend on it.
    pub(crate) lagged: Vec<Box<dyn Stage<World<D>>>>,
    /// Whether an elastic material stiffens while it is strained: 𝒢Δt then acts as a viscosity.
    pub(crate) stiffens: bool,
    pub(crate) solves: Solves,
    /// The entries of the last matrix, for their memory.
    pub(crate) former: Option<Entries<D>>,
}

/// A system on the way to its solver.
struct System<const D: usize> {
    matrix: Matrix<D>,
    /// Mγ of every row, kg.
    mass: Vec<f64>,
    /// Δt s.
    right: Vec<Vect<D>>,
}

impl<const D: usize> ImplicitViscosity<D> {
    /// Takes friction over a step; `earlier` is uⁿ.
    ///
    /// # Errors
    /// If the system cannot be solved to its tolerance.
    pub fn apply(
        &mut self,
        world: &mut World<D>,
        earlier: &[Vect<D>],
        dt: f64,
    ) -> Result<(), StepError> {
        let outer = self.scheme.outer();
        let most = match self.lagged.is_empty() {
            true => 1,
            false => outer.iterations.max(1),
        };
        let ahead = world.free.get(fields::VELOCITY)?.to_vec();
        let (mut iterations, mut change) = (0, f64::INFINITY);
        while iterations < most && change > outer.tolerance {
            let again = iterations > 0;
            if again {
                for stage in &mut self.lagged {
                    stage.run(world)?;
                }
            }
            let mut velocity = world.free.get(fields::VELOCITY)?.to_vec();
            let plain = match self.stiffens {
                true => Some(stiffen(world)?),
                false => None,
            };
            let solved = self.solve(world, [earlier, &ahead], again, &mut velocity, dt);
            if let Some(plain) = plain {
                world.free.put(fields::VISCOSITY, plain)?;
            }
            solved?;
            if again {
                change = relative_change(world, &velocity, dt)?;
            }
            world.free.put(fields::VELOCITY, velocity)?;
            iterations += 1;
        }
        if self.stiffens && !self.lagged.is_empty() {
            let held = self.solves.held_back.get_or_insert_default();
            held.add(world, &ahead, dt)?;
        }
        if !self.lagged.is_empty() {
            let converged = change <= outer.tolerance;
            let change = if change.is_finite() { change } else { 0.0 };
            let outer = self.solves.outer.get_or_insert_default();
            outer.add(iterations, change, converged);
        }
        Ok(())
    }

    /// Bytes of a matrix of the present state for a step of dt, s, with the vectors of a solve.
    ///
    /// # Errors
    /// If a column is missing.
    pub(crate) fn bytes(&self, world: &mut World<D>, dt: f64) -> Result<usize, StepError> {
        let plain = match self.stiffens {
            true => Some(stiffen(world)?),
            false => None,
        };
        let system = self.system_of(world, world.free.get(fields::VELOCITY)?, dt, None);
        if let Some(plain) = plain {
            world.free.put(fields::VISCOSITY, plain)?;
        }
        let vectors = VECTORS * world.free.len() * size_of::<Vect<D>>();
        Ok(system?.matrix.bytes() + vectors)
    }

    /// The system of a step; the memory of `former` entries is used again.
    fn system_of(
        &self,
        world: &World<D>,
        earlier: &[Vect<D>],
        dt: f64,
        former: Option<Entries<D>>,
    ) -> Result<System<D>, StepError> {
        let part = [self.scheme.implicit_share(), dt];
        match (self.coupling.mixes_components(), former) {
            (false, Some(Entries::Scalar(former))) => {
                self.scalar_system(world, earlier, part, former)
            }
            (false, _) => self.scalar_system(world, earlier, part, Values::default()),
            (true, Some(Entries::Block(former))) => self.block_system(world, earlier, part, former),
            (true, _) => self.block_system(world, earlier, part, Values::default()),
        }
    }

    /// One linear solve from uⁿ and u*; `velocity` is the start and the result.
    ///
    /// The first one of a step starts on the line from uⁿ to u*, one that comes `again` where the last ended.
    fn solve(
        &mut self,
        world: &World<D>,
        [earlier, ahead]: [&[Vect<D>]; 2],
        again: bool,
        velocity: &mut [Vect<D>],
        dt: f64,
    ) -> Result<(), StepError> {
        let share = self.scheme.implicit_share();
        let former = self.former.take();
        let mut system = self.system_of(world, earlier, dt, former)?;
        let rows = system.right.iter_mut().zip(ahead).zip(&system.mass);
        rows.for_each(|((b, u), m)| *b += u * *m);
        if share < 1.0 || !again {
            let mut before = vec![Vect::zeros(); earlier.len()];
            system.matrix.multiply(earlier, &mut before);
            if share < 1.0 {
                let rest = (1.0 - share) / share;
                for (k, b) in system.right.iter_mut().enumerate() {
                    *b -= (before[k] - earlier[k] * system.mass[k]) * rest;
                }
            }
            if !again {
                start_between(&system, &before, earlier, velocity);
            }
        }
        let (matrix, right) = (&system.matrix, &system.right);
        let start = Instant::now();
        let solved = match self.lagged.is_empty() {
            true => self.solver.solve(matrix, right, velocity),
            false => {
                // More than the outer iteration asks for would be lost on it.
                let enough = INNER * self.scheme.outer().tolerance;
                self.solver.solve_roughly(matrix, right, velocity, enough)
            }
        };
        let report = solved.map_err(|e| StepError::Stage {
            stage: "implicit viscosity".into(),
            reason: e.to_string(),
        })?;
        let seconds = start.elapsed().as_secs_f64();
        self.solves.add(&report, seconds, matrix.bytes());
        self.former = Some(system.matrix.entries);
        Ok(())
    }

    fn scalar_system(
        &self,
        world: &World<D>,
        earlier: &[Vect<D>],
        part: [f64; 2],
        former: Values<f64>,
    ) -> Result<System<D>, StepError> {
        let bound = self.coupling.bind(world)?;
        let entries = (former, Entries::Scalar);
        self.system(world, earlier, part, entries, |rows, weak, out| {
            let row = bound.scalar_row(rows, weak, out);
            (row.wall, row.source)
        })
    }

    fn block_system(
        &self,
        world: &World<D>,
        earlier: &[Vect<D>],
        part: [f64; 2],
        former: Values<Block<D>>,
    ) -> Result<System<D>, StepError> {
        let bound = self.coupling.bind(world)?;
        let entries = (former, Entries::Block);
        self.system(world, earlier, part, entries, |rows, weak, out| {
            let row = bound.block_row(rows, weak, out);
            (row.wall, row.source)
        })
    }

    fn system<E: Entry<D>>(
        &self,
        world: &World<D>,
        earlier: &[Vect<D>],
        [share, dt]: [f64; 2],
        (former, entries): (Values<E>, impl FnOnce(Values<E>) -> Entries<D>),
        friction: impl Fn(
            &Neighbourhood<'_, D>,
            Option<Weak<'_, D>>,
            &mut Vec<(u32, E)>,
        ) -> (E, Vect<D>)
        + Sync,
    ) -> Result<System<D>, StepError> {
        let gamma = world.free.get(fields::RENORMALISATION).ok();
        let mass = world.free.get(fields::MASS)?.iter().enumerate();
        let mass: Vec<f64> = mass.map(|(i, m)| gamma.map_or(*m, |g| m * g[i])).collect();
        let limit: Vec<f64> = mass.iter().map(|m| SOFT / dt * m).collect();
        let weak = (share == 1.0).then_some(Weak {
            velocity: earlier,
            limit: &limit,
        });
        let (pattern, values, right) = assemble(world, former, |rows, out: &mut Vec<(u32, E)>| {
            let (wall, source) = friction(rows, weak, out);
            out.iter_mut().for_each(|(_, c)| *c = c.times(share * dt));
            Row {
                own: E::unit(mass[rows.particle]).plus(&wall.times(share * dt)),
                source: source * dt,
            }
        })?;
        Ok(System {
            matrix: Matrix::new(pattern, entries(values)),
            mass,
            right,
        })
    }
}

/// Adds what the strain of the step does to an elastic material, s𝒢Δt, to the viscosities, and gives those without it.
///
/// Δt is the whole step, over which stresses follow the velocity, also in a kick over a part of it.
fn stiffen<const D: usize>(world: &mut World<D>) -> Result<Vec<f64>, StepError> {
    let dt = world.dt;
    let plain = world.free.take(fields::VISCOSITY)?;
    let stiffness = world.free.get(fields::ELASTIC_STIFFNESS)?;
    let both = plain.iter().zip(stiffness);
    let stiff = both.map(|(eta, g)| eta + g * dt).collect();
    world.free.put(fields::VISCOSITY, stiff)?;
    Ok(plain)
}

/// √(Σm|u − u'|²/Σm(|u|² + Δt²|g|²)) of a velocity against the world's, with what drives the flow:
/// next to rest nobody needs to know the velocity better than what one step could give it.
fn relative_change<const D: usize>(
    world: &World<D>,
    velocity: &[Vect<D>],
    dt: f64,
) -> Result<f64, StepError> {
    let mass = world.free.get(fields::MASS)?;
    let last = world.free.get(fields::VELOCITY)?;
    let kick = dt * dt * (world.gravity + world.driving).norm_squared();
    let mut sums = [0.0, 0.0];
    for ((u, l), m) in velocity.iter().zip(last).zip(mass) {
        sums[0] += m * (u - l).norm_squared();
        sums[1] += m * (u.norm_squared() + kick);
    }
    Ok(match sums[1] > 0.0 {
        true => (sums[0] / sums[1]).sqrt(),
        false => 0.0,
    })
}

/// The best start on the line from uⁿ to u*, in the norm of the matrix: where friction balances the
/// other forces it is uⁿ, where there is little of it u*.
fn start_between<const D: usize>(
    system: &System<D>,
    image: &[Vect<D>],
    earlier: &[Vect<D>],
    velocity: &mut [Vect<D>],
) {
    let ahead: Vec<Vect<D>> = velocity.iter().zip(earlier).map(|(u, e)| u - e).collect();
    let mut image_ahead = vec![Vect::zeros(); ahead.len()];
    system.matrix.multiply(&ahead, &mut image_ahead);
    let missing: Vec<Vect<D>> = system.right.iter().zip(image).map(|(b, a)| b - a).collect();
    let (along, curvature) = (dot(&ahead, &missing), dot(&ahead, &image_ahead));
    let part = if curvature > 0.0 {
        along / curvature
    } else {
        0.0
    };
    let both = velocity.iter_mut().zip(earlier).zip(&ahead);
    both.for_each(|((u, e), a)| *u = e + a * part);
}

//! Friction from the end of the step: (M + θΔt K) uⁿ⁺¹ = M u* + Δt s − (1 − θ)Δt K uⁿ.
//!
//! M = diag(m_a γ_a) and K are those of [`Coupling`]; u* is the velocity after all other forces. Where K depends on the
//! velocity, it follows it (Picard). Pairs whose friction is weak act with uⁿ if θ = 1. Ghaïtanellis 2017, Eq. 5.3–5.6, made
//! symmetric by the factor m_a γ_a.

use std::time::Instant;

use serde_json::Value as Json;
use sph_contribution::{Report, Stages, StepHook, StepMoment, StepPhase};
use sph_core::{Access, StepError, Vect, fields};
use sph_neighbours::World;

use crate::linear::{LinearSolver, LowRank, Operator, TimeScheme};
use crate::viscosity::body_response::Bodies;
use crate::viscosity::{Coupling, FrictionSystem, Solves};

/// Residual of a solve within an outer iteration, over the tolerance of the latter.
const INNER: f64 = 0.1;

/// Vectors of a solve: right-hand side, uⁿ, u*, their start, and those of conjugate gradients.
const VECTORS: usize = 8;

/// Updates of the viscosity with the velocity within a step.
pub struct PicardUpdates<const D: usize> {
    /// Stages of the viscosity of the present velocity; empty where it does not depend on it.
    pub stages: Stages<D>,
    /// True if an elastic material stiffens while it is strained: 𝒢Δt then acts as a viscosity.
    pub stiffens: bool,
    /// True if a soil may be held by the solve beyond its strength.
    pub may_hold: bool,
}

/// The viscous operator, a scheme and a solver.
pub struct ImplicitViscosity<const D: usize> {
    coupling: Box<dyn Coupling<D>>,
    scheme: Box<dyn TimeScheme>,
    solver: Box<dyn LinearSolver<D>>,
    lagged: PicardUpdates<D>,
    solves: Solves,
    /// The system of the last solve, for its memory.
    system: FrictionSystem<D>,
    start: Start<D>,
    /// uⁿ.
    earlier: Vec<Vect<D>>,
    /// u*.
    ahead: Vec<Vect<D>>,
    /// uⁿ⁺¹ on its way.
    velocity: Vec<Vect<D>>,
    /// Viscosities without the stiffening.
    plain: Vec<f64>,
}

impl<const D: usize> ImplicitViscosity<D> {
    /// Its name among the work of a step.
    pub const NAME: &'static str = "implicit viscosity";

    /// Of an operator as a matrix, for a scheme and a solver.
    pub fn new(
        coupling: Box<dyn Coupling<D>>,
        (scheme, solver): (Box<dyn TimeScheme>, Box<dyn LinearSolver<D>>),
        lagged: PicardUpdates<D>,
    ) -> Self {
        ImplicitViscosity {
            coupling,
            scheme,
            solver,
            lagged,
            solves: Solves::default(),
            system: FrictionSystem::default(),
            start: Start::default(),
            earlier: Vec::new(),
            ahead: Vec::new(),
            velocity: Vec::new(),
            plain: Vec::new(),
        }
    }

    /// Takes friction over a step; `earlier` is uⁿ.
    ///
    /// # Errors
    /// If the system cannot be solved to its tolerance.
    fn apply(
        &mut self,
        world: &mut World<D>,
        earlier: &[Vect<D>],
        dt: f64,
    ) -> Result<(), StepError> {
        let outer = self.scheme.outer();
        let most = match self.lagged.stages.is_empty() {
            true => 1,
            false => outer.iterations.max(1),
        };
        let mut ahead = std::mem::take(&mut self.ahead);
        world.free.get(fields::VELOCITY)?.clone_into(&mut ahead);
        self.give_way(world, [earlier, &ahead], dt)?;
        let (mut iterations, mut change) = (0, f64::INFINITY);
        while iterations < most && change > outer.tolerance {
            let again = iterations > 0;
            if again {
                for stage in &mut self.lagged.stages {
                    world.run(&mut **stage)?;
                }
            }
            let mut velocity = std::mem::take(&mut self.velocity);
            world.free.get(fields::VELOCITY)?.clone_into(&mut velocity);
            if self.lagged.stiffens {
                stiffen(world, &mut self.plain)?;
            }
            let solved = self.solve(world, [earlier, &ahead], again, (&mut velocity, None), dt);
            if self.lagged.stiffens {
                unstiffen(world, &mut self.plain)?;
            }
            solved?;
            if again {
                change = relative_change(world, &velocity, dt)?;
            }
            std::mem::swap(world.free.get_mut(fields::VELOCITY)?, &mut velocity);
            self.velocity = velocity;
            iterations += 1;
        }
        if !self.lagged.stages.is_empty() {
            if self.lagged.stiffens {
                let held = self.solves.held_back.get_or_insert_default();
                held.add(world, &ahead, dt)?;
            }
            let converged = change <= outer.tolerance;
            let change = if change.is_finite() { change } else { 0.0 };
            let outer = self.solves.outer.get_or_insert_default();
            outer.add(iterations, change, converged);
        }
        self.ahead = ahead;
        Ok(())
    }

    /// Gives bodies that friction moves the velocity of the end of the step, which a first solve finds with that of
    /// the fluid.
    fn give_way(
        &mut self,
        world: &mut World<D>,
        [earlier, ahead]: [&[Vect<D>]; 2],
        dt: f64,
    ) -> Result<(), StepError> {
        let (elements, bodies) = (&world.walls.elements, &world.walls.bodies);
        let is_body = |wall: &u32| bodies.iter().any(|body| body.is(*wall as usize));
        let mut each = elements.friction_factor.iter().zip(&elements.wall);
        if !each.any(|(factor, wall)| *factor > 0.0 && is_body(wall)) {
            return Ok(());
        }
        let share = self.scheme.implicit_share();
        let system = &mut self.system;
        system.fill(&*self.coupling, world, earlier, [share, dt])?;
        let Some(bodies) = Bodies::new(world, system, earlier, dt)? else {
            return Ok(());
        };
        let mut velocity = ahead.to_vec();
        let known = [earlier, ahead];
        self.solve(world, known, false, (&mut velocity, Some(&bodies)), dt)?;
        bodies.carry(world, &velocity, dt)
    }

    /// One linear solve from uⁿ and u*, where bodies may give way; `velocity` is the start and the result.
    ///
    /// The first one of a step starts on the line from uⁿ to u*, one that comes `again` where the last ended.
    fn solve(
        &mut self,
        world: &World<D>,
        [earlier, ahead]: [&[Vect<D>]; 2],
        again: bool,
        (velocity, bodies): (&mut [Vect<D>], Option<&Bodies<D>>),
        dt: f64,
    ) -> Result<(), StepError> {
        let share = self.scheme.implicit_share();
        let system = &mut self.system;
        system.fill(&*self.coupling, world, earlier, [share, dt])?;
        let mut right = std::mem::take(&mut system.right);
        let rows = right.iter_mut().zip(ahead).zip(&system.mass);
        rows.for_each(|((b, u), m)| *b += u * *m);
        let space = world.space()?;
        space.refresh(&mut right);
        let operator = system.operator(world, &space)?;
        if share < 1.0 || !again {
            self.start.image.resize(earlier.len(), Vect::zeros());
            let before = &mut self.start.image;
            operator.multiply(earlier, before);
            if share < 1.0 {
                let rest = (1.0 - share) / share;
                for (k, b) in right.iter_mut().enumerate() {
                    *b -= (before[k] - earlier[k] * system.mass[k]) * rest;
                }
            }
            if !again {
                self.start.between((&operator, &right), earlier, velocity);
            }
        }
        let vectors = bodies.map_or(Vec::new(), |all| all.bind(&operator, &mut right, dt));
        let whole = LowRank {
            base: &operator,
            vectors: &vectors,
            sign: -1.0,
        };
        let start = Instant::now();
        // A tolerance below that of the outer iteration gains nothing.
        let enough = match self.lagged.stages.is_empty() {
            true => 0.0,
            false => INNER * self.scheme.outer().tolerance,
        };
        let solved = self.solver.solve_to((&whole, &right, velocity), enough);
        let bytes = operator.bytes();
        drop(operator);
        system.right = right;
        let report = solved.map_err(|error| StepError::stage(Self::NAME, error))?;
        let seconds = start.elapsed().as_secs_f64();
        self.solves.add(&report, seconds, bytes);
        Ok(())
    }
}

impl<const D: usize> StepHook<D> for ImplicitViscosity<D> {
    fn name(&self) -> String {
        Self::NAME.into()
    }
    fn access(&self) -> Access {
        let mut access = self.coupling.access().both(fields::POSITION);
        access = access.here(fields::MASS).writes(fields::VELOCITY);
        for stage in &self.lagged.stages {
            access = access.and(stage.access());
        }
        match self.lagged.stiffens {
            false => access,
            true => access
                .here((fields::VOLUME, fields::STRAIN_RATE))
                .here(fields::ELASTIC_STIFFNESS)
                .writes(fields::VISCOSITY),
        }
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::BeforeKick, StepPhase::AfterKick]
    }
    fn run(&mut self, phase: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        if phase == StepPhase::AfterKick {
            let earlier = std::mem::take(&mut self.earlier);
            let done = self.apply(moment.world, &earlier, moment.dt);
            self.earlier = earlier;
            return done;
        }
        let velocity = moment.world.free.get(fields::VELOCITY)?;
        velocity.clone_into(&mut self.earlier);
        Ok(())
    }
    fn bytes(&self, world: &mut World<D>, dt: f64) -> Result<usize, StepError> {
        let mut plain = Vec::new();
        if self.lagged.stiffens {
            stiffen(world, &mut plain)?;
        }
        let mut system = FrictionSystem::default();
        let part = [self.scheme.implicit_share(), dt];
        let earlier = world.free.get(fields::VELOCITY)?;
        let filled = system.fill(&*self.coupling, world, earlier, part);
        if self.lagged.stiffens {
            unstiffen(world, &mut plain)?;
        }
        filled?;
        let space = world.space()?;
        let operator = system.operator(world, &space)?;
        if self.solver.needs_entries(&operator) {
            operator.assembled();
        }
        let vectors = VECTORS * world.free.len() * size_of::<Vect<D>>();
        Ok(operator.bytes() + vectors)
    }
    fn report(&self, _: &World<D>) -> Report {
        let held = self.solves.held_back;
        let warning = held.and_then(|held| held.warning());
        let gross = held.filter(|_| !self.lagged.may_hold);
        Report {
            counts: serde_json::to_value(&self.solves).ok(),
            summary: Some("implicit_viscosity"),
            verdict: gross.and_then(|held| held.verdict()),
            warnings: warning.into_iter().collect(),
            most_bytes: self.solves.most_bytes,
            ..Report::default()
        }
    }
    fn resume(&mut self, counts: Json) {
        self.solves = serde_json::from_value(counts).unwrap_or_default();
    }
}

/// Adds the elastic response to the strain of the step, s𝒢Δt, to the viscosities; `plain` keeps those without it.
///
/// Δt is the whole step, over which stresses follow the velocity, also in a kick over a part of it.
fn stiffen<const D: usize>(world: &mut World<D>, plain: &mut Vec<f64>) -> Result<(), StepError> {
    let dt = world.dt;
    std::mem::swap(plain, world.free.get_mut(fields::VISCOSITY)?);
    let mut stiff = std::mem::take(world.free.get_mut(fields::VISCOSITY)?);
    let stiffness = world.free.get(fields::ELASTIC_STIFFNESS)?;
    let both = plain.iter().zip(stiffness);
    put(&mut stiff, both.map(|(eta, g)| eta + g * dt));
    Ok(world.free.put(fields::VISCOSITY, stiff)?)
}

fn unstiffen<const D: usize>(world: &mut World<D>, plain: &mut Vec<f64>) -> Result<(), StepError> {
    std::mem::swap(plain, world.free.get_mut(fields::VISCOSITY)?);
    Ok(())
}

/// √(Σm|u − u'|²/Σm(|u|² + Δt²|g|²)) of a velocity against the world's, with the driving acceleration: next to rest the
/// velocity need not be more accurate than the change that one step could give it.
fn relative_change<const D: usize>(
    world: &World<D>,
    velocity: &[Vect<D>],
    dt: f64,
) -> Result<f64, StepError> {
    let (mass, last) = world.free.all((fields::MASS, fields::VELOCITY))?;
    let kick = dt * dt * (world.gravity + world.driving).norm_squared();
    let sums = world.sums(|i| {
        let (u, l, m) = (velocity[i], last[i], mass[i]);
        [m * (u - l).norm_squared(), m * (u.norm_squared() + kick)]
    })?;
    Ok(match sums[1] > 0.0 {
        true => (sums[0] / sums[1]).sqrt(),
        false => 0.0,
    })
}

#[derive(Default)]
pub(crate) struct Start<const D: usize> {
    /// K uⁿ, with the mass.
    pub image: Vec<Vect<D>>,
    ahead: Vec<Vect<D>>,
    image_ahead: Vec<Vect<D>>,
    missing: Vec<Vect<D>>,
}

impl<const D: usize> Start<D> {
    /// The best start on the line from uⁿ to u*, in the norm of the matrix: where friction balances the
    /// other forces it is uⁿ, where there is little of it u*. `image` is there already.
    pub fn between(
        &mut self,
        (operator, right): (&dyn Operator<D>, &[Vect<D>]),
        earlier: &[Vect<D>],
        velocity: &mut [Vect<D>],
    ) {
        let ahead = velocity.iter().zip(earlier).map(|(u, e)| u - e);
        put(&mut self.ahead, ahead);
        self.image_ahead.resize(self.ahead.len(), Vect::zeros());
        operator.multiply(&self.ahead, &mut self.image_ahead);
        let missing = right.iter().zip(&self.image).map(|(b, a)| b - a);
        put(&mut self.missing, missing);
        let along = operator.inner(&self.ahead, &self.missing);
        let curvature = operator.inner(&self.ahead, &self.image_ahead);
        let part = match curvature > 0.0 {
            true => along / curvature,
            false => 0.0,
        };
        let both = velocity.iter_mut().zip(earlier).zip(&self.ahead);
        both.for_each(|((u, e), a)| *u = e + a * part);
    }
}

pub(crate) fn put<T>(to: &mut Vec<T>, from: impl Iterator<Item = T>) {
    to.clear();
    to.extend(from);
}

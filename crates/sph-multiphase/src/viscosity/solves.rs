//! Counts and times of implicit solves, and the weight of a soil that they bear beyond its strength.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

use crate::linear::Report;

/// Effort of the implicit solves of a run.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Solves {
    /// Systems solved, by method.
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
    /// Most bytes of a matrix and of the solver's memory for it.
    #[serde(default)]
    pub most_bytes: usize,
    /// Updates of the viscosity by the velocity, where it depends on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outer: Option<OuterSolves>,
    /// Weight of a soil that solves bore beyond its strength, with stresses of the end of the step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub held_back: Option<SolveArrest>,
}

/// Effort of the iterations on the viscosity.
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
    pub(crate) fn add(&mut self, iterations: usize, change: f64, converged: bool) {
        self.steps += 1;
        self.mean_iterations += (iterations as f64 - self.mean_iterations) / self.steps as f64;
        self.most_iterations = self.most_iterations.max(iterations);
        self.unconverged += u64::from(!converged);
        self.largest_change = self.largest_change.max(change);
    }
}

impl Solves {
    pub(crate) fn add(&mut self, report: &Report, seconds: f64, matrix: usize) {
        self.wall_seconds += seconds;
        self.most_bytes = self.most_bytes.max(matrix + report.bytes);
        match self.by_method.get_mut(report.method) {
            Some(count) => *count += 1,
            None => *self.by_method.entry(report.method.into()).or_default() += 1,
        }
        let all: u64 = self.by_method.values().sum();
        self.mean_iterations += (report.iterations as f64 - self.mean_iterations) / all as f64;
        self.most_iterations = self.most_iterations.max(report.iterations);
        self.largest_residual = self.largest_residual.max(report.residual);
    }
}

/// Mean share of the weight above which a result is not right: a fall with 0.95 g has a tenth less kinetic energy.
const MUCH: f64 = 0.05;

/// Mean share of the weight of a soil that the solve bears beyond the strength of the law.
///
/// The law dissipates ∫(η + s𝒢Δt)γ̇² dV in what is solved for, and its stress is cut to τ_y. The operator sums over pairs, and resists as well what is
/// no shear: changes of volume with 5/3 of this viscosity, and motions of neighbours that no gradient sees. None of that is cut, so that a stiff
/// soil in long steps is held by what is no friction. With the power P = Σ m(u* − uⁿ⁺¹)·uⁿ⁺¹/Δt that the solve takes, and P_law of the law,
///
/// held = (1 − P_law/P) Σ m|u* − uⁿ⁺¹| / (Δt |g| Σ m),
///
/// over all particles with a solid part, and its mean over time. At rest the stress of the step before bears the soil, and nothing is left to the solve. Ours.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct SolveArrest {
    /// Mean over time.
    pub mean: f64,
    /// Time over which the mean is taken, s.
    pub seconds: f64,
}

impl SolveArrest {
    /// Adds a kick over `dt` from u* to the velocity of now, with the viscosity of the law alone.
    ///
    /// # Errors
    /// If a column is missing.
    pub(crate) fn add<const D: usize>(
        &mut self,
        world: &World<D>,
        ahead: &[Vect<D>],
        dt: f64,
    ) -> Result<(), StepError> {
        let weight = (world.gravity + world.driving).norm();
        if weight <= 0.0 || dt <= 0.0 {
            return Ok(());
        }
        let free = &world.free;
        let (mass, volume) = (free.get(fields::MASS)?, free.get(fields::VOLUME)?);
        let (velocity, viscosity) = free.all((fields::VELOCITY, fields::VISCOSITY))?;
        let (stiffness, rate) = free.all((fields::ELASTIC_STIFFNESS, fields::STRAIN_RATE))?;
        let [all, taken, power, lawful] = world.sums(|i| match stiffness[i] > 0.0 {
            false => [0.0; 4],
            true => {
                let change = (ahead[i] - velocity[i]) * (mass[i] / dt);
                let eta = viscosity[i] + stiffness[i] * world.dt;
                let lawful = volume[i] * eta * rate[i] * rate[i];
                let power = change.dot(&velocity[i]);
                [mass[i] * weight, change.norm(), power, lawful]
            }
        })?;
        let held = match all > 0.0 && power > lawful {
            true => (1.0 - lawful / power) * taken / all,
            false => 0.0,
        };
        self.seconds += dt;
        self.mean += (held - self.mean) * dt / self.seconds;
        Ok(())
    }

    pub(crate) fn warning(&self) -> Option<String> {
        (self.mean > MUCH).then(|| {
            format!(
                "what is solved for held {:.0} % of the soil's weight beyond its strength, in the mean over time: with \
                 `elastic-force.divergence.implicit = true` stiff soils that should yield are delayed or stand; take \
                 `elastic-force.divergence.sub_steps = true` instead, with [integrator.symplectic-euler]",
                100.0 * self.mean
            )
        })
    }

    /// Reason that a finished run has no result, if too much was held.
    pub(crate) fn verdict(&self) -> Option<StepError> {
        let told = self.warning()?;
        let why = format!("{told}; or allow it with `numerics.delayed_yield = true`");
        Some(StepError::stage("elasticity at the end of the step", why))
    }
}

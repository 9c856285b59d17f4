//! Counts and times of implicit solves.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::linear::Report;
use crate::viscosity::SolveArrest;

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

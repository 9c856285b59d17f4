//! Stabilised bi-conjugate gradients.

use sph_core::{Vect, plugin};

use crate::linear::operator::add;
use crate::linear::precondition::Factors;
use crate::linear::solver::{SolveMonitor, Tolerance};
use crate::linear::{
    LinearSolver, LinearSolverEntry, LinearSystem, Operator, Preconditioner, SolveResult,
};

/// BiCGSTAB (van der Vorst 1992), which needs no symmetry: the solver of the thesis. Two products per iteration; for
/// these matrices conjugate gradients are faster.
///
/// ```toml
/// [linear-solver.bicgstab]
/// ```
#[plugin(LinearSolverEntry [2, 3], "bicgstab", "stabilised bi-conjugate gradients, for comparison with the thesis",
    source: "van der Vorst 1992; Ghaïtanellis 2017, §5.1.1")]
#[derive(Copy)]
pub struct Bicgstab {
    /// The preconditioner.
    #[parameter(default: Preconditioner::Jacobi, source: "Ghaïtanellis 2017, §5.1.1: jacobi")]
    pub preconditioner: Preconditioner,
    /// Relative residual |b − A x| / |b| at which it ends.
    #[parameter(default: 1e-8, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    /// Largest number of iterations; a step that needs more is tried again with half its length.
    #[parameter(default: 2000, unit: "1", min: 1, source: "ours")]
    pub iterations: usize,
}

const METHOD: &str = "BiCGSTAB";

impl<const D: usize> LinearSolver<D> for Bicgstab {
    fn needs_entries(&self, _: &dyn Operator<D>) -> bool {
        self.preconditioner.factorises()
    }

    fn solve_to(&mut self, (operator, right, x): LinearSystem<'_, D>, _: f64) -> SolveResult {
        let tolerance = Tolerance::new(self.tolerance, self.iterations);
        let (mut history, mut factors) = (Vec::new(), Factors::default());
        let mut watch = SolveMonitor::new(METHOD, tolerance, operator, right, &mut history)?;
        let mut r = Vec::new();
        operator.residual(right, x, &mut r);
        if let Some(residual) = watch.reached(operator.norm(&r))? {
            return Ok(watch.report(residual, size_of_val(&r[..])));
        }
        let precondition = self.preconditioner.bind(operator, METHOD, &mut factors)?;
        let bytes = 7 * size_of_val(&r[..]) + precondition.bytes();
        let shadow = r.clone();
        let [mut y, mut z, mut p, mut v, mut t] = [(); 5].map(|_| vec![Vect::zeros(); r.len()]);
        let (mut rho, mut alpha, mut omega) = (1.0, 1.0, 1.0);
        loop {
            let next = operator.inner(&shadow, &r);
            if next == 0.0 || omega == 0.0 {
                return Err(watch.not_positive());
            }
            let beta = next / rho * (alpha / omega);
            rho = next;
            for ((p, r), v) in p.iter_mut().zip(&r).zip(&v) {
                *p = r + (*p - v * omega) * beta;
            }
            precondition.apply(&p, &mut y);
            operator.apply(&mut y, &mut v);
            alpha = rho / operator.inner(&shadow, &v);
            add(&mut r, -alpha, &v);
            add(x, alpha, &y);
            precondition.apply(&r, &mut z);
            operator.apply(&mut z, &mut t);
            let squared = operator.inner(&t, &t);
            omega = match squared > 0.0 {
                true => operator.inner(&t, &r) / squared,
                false => 0.0,
            };
            add(x, omega, &z);
            add(&mut r, -omega, &t);
            if let Some(residual) = watch.reached(operator.norm(&r))? {
                return Ok(watch.report(residual, bytes));
            }
        }
    }
}

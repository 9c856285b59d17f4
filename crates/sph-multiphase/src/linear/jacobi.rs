//! Jacobi's iteration.

use sph_core::Vect;

use crate::linear::precondition::Factors;
use crate::linear::solver::{SolveMonitor, Tolerance};
use crate::linear::{LinearSolver, LinearSystem, Preconditioner, SolveResult};

/// x ← x + D⁻¹(b − A x) with the diagonal blocks D of A, until |b − A x|/|b| is small.
///
/// For comparison: on n rows of particles one sweep takes about 1/n² off the error, so that a cold start needs of the order of n²
/// sweeps, where conjugate gradients need n. A must be diagonally dominant.
#[derive(Clone, Copy, Debug)]
pub struct Jacobi {
    /// Relative residual |b − A x| / |b| at which it ends.
    pub tolerance: f64,
    /// Largest number of sweeps.
    pub sweeps: usize,
}

const METHOD: &str = "Jacobi";

impl<const D: usize> LinearSolver<D> for Jacobi {
    fn solve_to(&mut self, (operator, right, x): LinearSystem<'_, D>, _: f64) -> SolveResult {
        let tolerance = Tolerance::new(self.tolerance, self.sweeps);
        let (mut history, mut factors) = (Vec::new(), Factors::default());
        let mut watch = SolveMonitor::new(METHOD, tolerance, operator, right, &mut history)?;
        let diagonal = Preconditioner::BlockJacobi.bind(operator, METHOD, &mut factors)?;
        let mut r = Vec::new();
        let mut step = vec![Vect::zeros(); right.len()];
        let bytes = 2 * size_of_val(&step[..]) + diagonal.bytes();
        loop {
            operator.residual(right, x, &mut r);
            if let Some(residual) = watch.reached(operator.norm(&r))? {
                return Ok(watch.report(residual, bytes));
            }
            diagonal.apply(&r, &mut step);
            x.iter_mut().zip(&step).for_each(|(x, step)| *x += step);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{Entries, Matrix, Pattern, SolveError};

    /// A chain of n rows, held at both ends: the spectral radius is cos(π/(n + 1)).
    fn sweeps(n: u32) -> usize {
        let row = |i: u32| [i.checked_sub(1), (i + 1 < n).then_some(i + 1)];
        let rows = (0..n).map(|i| row(i).into_iter().flatten().collect());
        let pattern = Pattern::from_rows(&rows.collect::<Vec<Vec<u32>>>());
        let entries = Entries::scalar(vec![2.0; n as usize], vec![-1.0; 2 * n as usize - 2]);
        let matrix = Matrix::<2>::new(pattern, entries);
        let right = vec![Vect::<2>::new(1.0, -1.0); n as usize];
        let mut x = vec![Vect::zeros(); n as usize];
        let mut jacobi = Jacobi {
            tolerance: 1e-6,
            sweeps: 1_000_000,
        };
        let report = jacobi.solve(&matrix, &right, &mut x).expect("converges");
        for (i, x) in x.iter().enumerate() {
            let i = i as f64 + 1.0;
            let exact = 0.5 * i * (f64::from(n) + 1.0 - i);
            assert!((x[0] - exact).abs() < 1e-3 * exact, "{x} {exact}");
        }
        report.iterations
    }

    #[test]
    fn sweeps_grow_as_the_square_of_the_rows() {
        let [few, many] = [10, 40].map(sweeps);
        // ln of the spectral radius is −π²/2(n + 1)²: a factor of (41/11)² = 13.9.
        let ratio = many as f64 / few as f64;
        assert!((ratio / 13.9 - 1.0).abs() < 0.1, "{few} and {many} sweeps");
    }

    #[test]
    fn too_few_sweeps_are_an_error() {
        let pattern = Pattern::from_rows(&[vec![1], vec![0]]);
        let matrix = Matrix::<2>::new(pattern, Entries::scalar(vec![2.0; 2], vec![-1.0; 2]));
        let right = vec![Vect::<2>::new(1.0, 0.0); 2];
        let mut jacobi = Jacobi {
            tolerance: 1e-12,
            sweeps: 5,
        };
        let error = jacobi.solve(&matrix, &right, &mut [Vect::zeros(); 2]).err();
        let five = |e| matches!(e, SolveError::NotConverged { iterations: 5, .. });
        assert!(error.is_some_and(five));
    }
}

//! What `automatic` takes, by dimension, size and stiffness.

use sph_core::Vect;
use sph_multiphase::linear::{Automatic, Cholesky, LinearSolver, Matrix, Report};

use super::systems::{apart, block, right, scalar};

fn taken<const D: usize>(matrix: &Matrix<D>) -> (Report, Vec<Vect<D>>) {
    let b = right(matrix.rows());
    let mut x = vec![Vect::zeros(); b.len()];
    let report = Automatic::default().solve(matrix, &b, &mut x);
    (report.expect("a solution"), x)
}

#[test]
fn systems_that_iterate_quickly_are_iterated() {
    let scalars = [0.01, 1.0].map(|stiffness| scalar::<2>(2000, stiffness, 1.0));
    for matrix in scalars.into_iter().chain([block(1000, 0.01, 1.0)]) {
        assert_eq!(taken(&matrix).0.method, "conjugate gradients");
    }
}

/// √N iterations are spent before.
#[test]
fn stiff_ones_of_unlike_viscosities_are_factorised_in_two_dimensions() {
    let matrix = scalar::<2>(2000, 1.0, 1e6);
    let (report, x) = taken(&matrix);
    assert_eq!((report.method, report.iterations), ("Cholesky", 45));
    let mut exact = vec![Vect::zeros(); x.len()];
    let direct = Cholesky::default().solve(&matrix, &right(x.len()), &mut exact);
    direct.expect("a solution");
    assert_eq!(apart(&x, &exact), 0.0);
}

/// A factor fills up there: never, however long it takes.
#[test]
fn nothing_is_factorised_in_three_dimensions() {
    for matrix in [scalar::<3>(2000, 1e3, 1e6), block(1000, 1e3, 1e6)] {
        let (report, _) = taken(&matrix);
        assert!(report.method.starts_with("conjugate"), "{report:?}");
        assert!(report.iterations > 45, "{report:?}");
    }
}

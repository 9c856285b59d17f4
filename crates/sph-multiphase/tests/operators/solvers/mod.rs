//! Every solver against a dense solution, on random graphs; errors; the same bits on any number of threads.

mod choice;
mod operators;
mod systems;

use sph_core::Vect;
use sph_multiphase::linear::{
    Cholesky, ConjugateGradient, Entries, LinearSolver, Matrix, Pattern, Preconditioner, SolveError,
};
use systems::{apart, block, dense, right, scalar, solvers};

fn agree_with_a_dense_solution<const D: usize>(kind: &str, matrix: &Matrix<D>) {
    let asymmetry = matrix.asymmetry();
    assert!(asymmetry < 1e-15, "{kind}: {asymmetry:e}");
    let b = right(matrix.rows());
    let exact = dense(matrix, &b);
    for (name, mut solver) in solvers() {
        let mut x = vec![Vect::zeros(); b.len()];
        let report = solver.solve(matrix, &b, &mut x);
        let report = report.unwrap_or_else(|e| panic!("{kind}, {name}: {e}"));
        let [error, residual] = [apart(&x, &exact), report.residual];
        assert!(
            error < 1e-8 && residual < 1e-10,
            "{kind}, {name}: {error:e} from the dense solution, residual {residual:e}"
        );
        // A second solve, from the solution: nothing to do, or the same again.
        let again = solver.solve(matrix, &b, &mut x).expect("a second solve");
        let iterations = again.iterations;
        assert!(iterations <= 1, "{kind}, {name}: {iterations}");
    }
}

#[test]
fn all_of_them_agree_with_a_dense_solution_to_1e_8() {
    for (kind, matrix) in [
        ("scalar", scalar::<2>(300, 1.0, 1.0)),
        ("scalar, stiff", scalar(300, 1e3, 1.0)),
        ("2×2", block(200, 1.0, 1.0)),
        ("2×2, stiff", block(200, 100.0, 10.0)),
    ] {
        agree_with_a_dense_solution(kind, &matrix);
    }
    for (kind, matrix) in [
        ("scalar, 3D", scalar::<3>(150, 30.0, 10.0)),
        ("3×3", block(150, 1.0, 1.0)),
        ("3×3, stiff", block(150, 100.0, 10.0)),
    ] {
        agree_with_a_dense_solution(kind, &matrix);
    }
}

/// A contrast of 10⁶: the factorisation does not care, the incomplete one keeps the iteration short.
#[test]
fn a_contrast_of_a_million_is_solved() {
    let matrix = scalar::<2>(2000, 1.0, 1e6);
    let b = right(matrix.rows());
    let mut exact = vec![Vect::zeros(); b.len()];
    let report = Cholesky::default().solve(&matrix, &b, &mut exact).unwrap();
    // Rounding of entries of 10⁷ leaves 2e-9.
    assert!(report.residual < 1e-8, "{:e}", report.residual);
    let mut iterations = Vec::new();
    for preconditioner in [Preconditioner::Jacobi, Preconditioner::IncompleteCholesky] {
        let mut x = vec![Vect::zeros(); b.len()];
        let mut solver = ConjugateGradient {
            preconditioner,
            tolerance: 1e-10,
            iterations: 20_000,
            ..ConjugateGradient::default()
        };
        let report = solver.solve(&matrix, &b, &mut x).unwrap();
        iterations.push(report.iterations);
        // The residual is relative to all of b; the error of the stiff half is 10⁶ times smaller.
        let error = apart(&x, &exact);
        assert!(error < 1e-4, "{preconditioner:?}: {error:e}");
    }
    assert!(iterations[1] * 2 < iterations[0], "{iterations:?}");
}

#[test]
fn an_unsolved_system_is_an_error_with_its_history() {
    let matrix = scalar::<2>(500, 1e4, 1.0);
    let b = right(500);
    let mut x = vec![Vect::zeros(); 500];
    let mut hasty = ConjugateGradient {
        preconditioner: Preconditioner::Jacobi,
        tolerance: 1e-12,
        iterations: 5,
        ..ConjugateGradient::default()
    };
    match hasty.solve(&matrix, &b, &mut x) {
        Err(SolveError::NotConverged {
            iterations: 5,
            history,
            ..
        }) => assert_eq!(history.len(), 6),
        other => panic!("{other:?}"),
    }
    let mut poisoned = right(500);
    poisoned[3][1] = f64::NAN;
    for (name, mut solver) in solvers() {
        let mut x = vec![Vect::zeros(); 500];
        let found = solver.solve(&matrix, &poisoned, &mut x);
        let refused = matches!(found, Err(SolveError::NotFinite { .. }));
        assert!(refused, "{name}: {found:?}");
    }
    let indefinite = Matrix::<2>::new(
        Pattern::from_rows(&[vec![1], vec![0]]),
        Entries::scalar(vec![1.0, 1.0], vec![-2.0, -2.0]),
    );
    let all = solvers().into_iter();
    for (name, mut solver) in all.filter(|(name, _)| !name.starts_with("bicgstab")) {
        let b = [Vect::<2>::new(1.0, 0.5), Vect::<2>::new(1.0, -0.3)];
        let found = solver.solve(&indefinite, &b, &mut [Vect::zeros(); 2]);
        let refused = matches!(found, Err(SolveError::NotPositive { .. }));
        assert!(refused, "{name}: {found:?}");
    }
}

/// Rows without neighbours, and no rows at all.
#[test]
fn lone_rows_and_empty_systems_are_fine() {
    let lone = Matrix::<2>::new(
        Pattern::from_rows(&[vec![], vec![], vec![]]),
        Entries::scalar(vec![2.0, 4.0, 8.0], vec![]),
    );
    let none = Matrix::<2>::new(Pattern::from_rows(&[]), Entries::scalar(vec![], vec![]));
    for (name, mut solver) in solvers() {
        let b = [Vect::<2>::new(1.0, 2.0); 3];
        let mut x = vec![Vect::zeros(); 3];
        let solved = solver.solve(&lone, &b, &mut x);
        assert!(solved.is_ok(), "{name}: {solved:?}");
        assert!((x[2][1] - 0.25).abs() < 1e-12, "{name}: {x:?}");
        let solved = solver.solve(&none, &[], &mut []);
        assert!(solved.is_ok(), "{name}: {solved:?}");
    }
}

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    same_bits(&scalar::<2>(6000, 30.0, 100.0));
    same_bits(&block::<2>(3000, 10.0, 10.0));
    same_bits(&block::<3>(2000, 10.0, 10.0));
}

fn same_bits<const D: usize>(matrix: &Matrix<D>) {
    let b = right(matrix.rows());
    let bits = |threads: usize| -> Vec<Vec<u64>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool").install(|| {
            let solved = solvers().into_iter().map(|(_, mut solver)| {
                let mut x = vec![Vect::zeros(); b.len()];
                solver.solve(matrix, &b, &mut x).expect("a solution");
                let bits = x.iter().flat_map(|x| x.iter().map(|c| c.to_bits()));
                bits.collect()
            });
            solved.collect()
        })
    };
    let one = bits(1);
    assert!(bits(2) == one && bits(4) == one);
}

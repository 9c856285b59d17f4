//! Every solver against a dense solution, on random graphs; errors; the same bits on any number of threads.

use nalgebra::{DMatrix, DVector};
use sph_core::Vect;
use sph_implicit::{
    Automatic, Bicgstab, Block, Cholesky, ConjugateGradient, Entries, Entry, LinearSolver, Matrix,
    Pattern, Preconditioner, SolveError,
};

/// A linear congruence, so that tests need no crate for it.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Points in a square, coupled when near, like particles: entries of size `stiffness` times a
/// contrast of viscosities of two halves, mass 1.
fn system<const D: usize, E: Entry<D>>(
    n: usize,
    entry: impl Fn(&mut Random, &Vect<2>) -> E,
    wrap: fn(Vec<E>, Vec<E>) -> Entries<D>,
    contrast: f64,
) -> Matrix<D> {
    let mut random = Random(7);
    let points: Vec<Vect<2>> = (0..n)
        .map(|_| Vect::<2>::new(random.next(), random.next()))
        .collect();
    let reach = 2.5 / (n as f64).sqrt();
    let eta = |k: usize| if points[k][0] < 0.5 { 1.0 } else { contrast };
    let mut rows = vec![Vec::new(); n];
    let mut entries = vec![Vec::new(); n];
    let mut diagonal = vec![E::unit(1.0); n];
    for i in 0..n {
        for j in 0..i {
            let apart = points[i] - points[j];
            if apart.norm() < reach {
                let mean = 2.0 * eta(i) * eta(j) / (eta(i) + eta(j));
                let c = entry(&mut random, &apart.normalize()).times(mean);
                rows[i].push(j as u32);
                rows[j].push(i as u32);
                entries[i].push(c.times(-1.0));
                entries[j].push(c.transposed().times(-1.0));
                diagonal[i] = diagonal[i].plus(&c);
                diagonal[j] = diagonal[j].plus(&c);
            }
        }
    }
    let others = entries.concat();
    Matrix::new(Pattern::from_rows(&rows), wrap(diagonal, others))
}

fn scalar(n: usize, stiffness: f64, contrast: f64) -> Matrix<2> {
    let entry = |random: &mut Random, _: &Vect<2>| stiffness * (0.5 + random.next());
    system::<2, f64>(n, entry, Entries::scalar, contrast)
}

/// Couplings of the form s (1 + 3 n nᵀ): like the Español–Revenga operator's.
fn block(n: usize, stiffness: f64, contrast: f64) -> Matrix<2> {
    let entry = |random: &mut Random, along: &Vect<2>| {
        (Block::<2>::identity() + 3.0 * along * along.transpose()) * (stiffness * random.next())
    };
    system::<2, Block<2>>(n, entry, Entries::block, contrast)
}

fn right(n: usize) -> Vec<Vect<2>> {
    let mut random = Random(3);
    (0..n)
        .map(|_| Vect::<2>::new(random.next() - 0.5, random.next()))
        .collect()
}

/// The solution by nalgebra's dense LU.
fn dense(matrix: &Matrix<2>, right: &[Vect<2>]) -> Vec<Vect<2>> {
    let n = matrix.rows();
    let mut full = DMatrix::zeros(2 * n, 2 * n);
    for k in 0..2 * n {
        let mut unit = vec![Vect::<2>::zeros(); n];
        unit[k / 2][k % 2] = 1.0;
        let mut column = unit.clone();
        matrix.multiply(&unit, &mut column);
        for (i, c) in column.iter().enumerate() {
            full[(2 * i, k)] = c[0];
            full[(2 * i + 1, k)] = c[1];
        }
    }
    let b = DVector::from_iterator(2 * n, right.iter().flat_map(|b| [b[0], b[1]]));
    let x = full.lu().solve(&b).expect("a regular matrix");
    (0..n)
        .map(|i| Vect::<2>::new(x[2 * i], x[2 * i + 1]))
        .collect()
}

fn solvers() -> Vec<(String, Box<dyn LinearSolver<2>>)> {
    let mut all: Vec<(String, Box<dyn LinearSolver<2>>)> = vec![
        ("cholesky".into(), Box::new(Cholesky::default())),
        ("automatic".into(), Box::new(Automatic::to(1e-11))),
    ];
    for preconditioner in [
        Preconditioner::None,
        Preconditioner::Jacobi,
        Preconditioner::BlockJacobi,
        Preconditioner::IncompleteDiagonal,
        Preconditioner::IncompleteCholesky,
    ] {
        let conjugate = ConjugateGradient {
            preconditioner,
            tolerance: 1e-11,
            iterations: 20_000,
        };
        all.push((format!("cg {preconditioner:?}"), Box::new(conjugate)));
        let stabilised = Bicgstab {
            preconditioner,
            tolerance: 1e-11,
            iterations: 20_000,
        };
        all.push((format!("bicgstab {preconditioner:?}"), Box::new(stabilised)));
    }
    all
}

fn apart(x: &[Vect<2>], y: &[Vect<2>]) -> f64 {
    let largest = y.iter().map(|y| y.amax()).fold(0.0, f64::max);
    let apart = x.iter().zip(y).map(|(x, y)| (x - y).amax());
    apart.fold(0.0, f64::max) / largest
}

#[test]
fn all_of_them_agree_with_a_dense_solution_to_1e_8() {
    for (kind, matrix) in [
        ("scalar", scalar(300, 1.0, 1.0)),
        ("scalar, stiff", scalar(300, 1e3, 1.0)),
        ("block", block(200, 1.0, 1.0)),
        ("block, stiff", block(200, 100.0, 10.0)),
    ] {
        assert!(
            matrix.asymmetry() < 1e-15,
            "{kind}: {:e}",
            matrix.asymmetry()
        );
        let b = right(matrix.rows());
        let exact = dense(&matrix, &b);
        for (name, mut solver) in solvers() {
            let mut x = vec![Vect::zeros(); b.len()];
            let report = solver.solve(&matrix, &b, &mut x);
            let report = report.unwrap_or_else(|e| panic!("{kind}, {name}: {e}"));
            let error = apart(&x, &exact);
            assert!(
                error < 1e-8 && report.residual < 1e-10,
                "{kind}, {name}: {error:e} from the dense solution, residual {:e}",
                report.residual
            );
            // A second solve, from the solution: nothing to do, or the same again.
            let again = solver.solve(&matrix, &b, &mut x).expect("a second solve");
            assert!(
                again.iterations <= 1,
                "{kind}, {name}: {}",
                again.iterations
            );
        }
    }
}

/// A contrast of 10⁶: the factorisation does not care, the incomplete one keeps the iteration short.
#[test]
fn a_contrast_of_a_million_is_solved() {
    let matrix = scalar(2000, 1.0, 1e6);
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
        };
        let report = solver.solve(&matrix, &b, &mut x).unwrap();
        iterations.push(report.iterations);
        // The residual is relative to all of b; the error of the stiff half is 10⁶ times smaller.
        assert!(
            apart(&x, &exact) < 1e-4,
            "{preconditioner:?}: {:e}",
            apart(&x, &exact)
        );
    }
    assert!(iterations[1] * 2 < iterations[0], "{iterations:?}");
}

#[test]
fn what_is_not_solved_is_an_error_with_its_history() {
    let matrix = scalar(500, 1e4, 1.0);
    let b = right(500);
    let mut x = vec![Vect::zeros(); 500];
    let mut hasty = ConjugateGradient {
        preconditioner: Preconditioner::Jacobi,
        tolerance: 1e-12,
        iterations: 5,
    };
    match hasty.solve(&matrix, &b, &mut x) {
        Err(SolveError::NotConverged {
            iterations,
            history,
            ..
        }) => {
            assert_eq!((iterations, history.len()), (5, 6));
        }
        other => panic!("{other:?}"),
    }
    let mut poisoned = right(500);
    poisoned[3][1] = f64::NAN;
    for (name, mut solver) in solvers() {
        let mut x = vec![Vect::zeros(); 500];
        let found = solver.solve(&matrix, &poisoned, &mut x);
        assert!(
            matches!(found, Err(SolveError::NotFinite { .. })),
            "{name}: {found:?}"
        );
    }
    let indefinite = Matrix::<2>::new(
        Pattern::from_rows(&[vec![1], vec![0]]),
        Entries::scalar(vec![1.0, 1.0], vec![-2.0, -2.0]),
    );
    for (name, mut solver) in solvers() {
        if name.starts_with("bicgstab") {
            continue;
        }
        let mut x = vec![Vect::zeros(); 2];
        let b = [Vect::<2>::new(1.0, 0.5), Vect::<2>::new(1.0, -0.3)];
        let found = solver.solve(&indefinite, &b, &mut x);
        assert!(
            matches!(found, Err(SolveError::NotPositive { .. })),
            "{name}: {found:?}"
        );
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
        solver
            .solve(&lone, &b, &mut x)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!((x[2][1] - 0.25).abs() < 1e-12, "{name}: {x:?}");
        solver
            .solve(&none, &[], &mut [])
            .unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn one_two_and_four_threads_give_the_same_bits() {
    for matrix in [scalar(6000, 30.0, 100.0), block(3000, 10.0, 10.0)] {
        let b = right(matrix.rows());
        let bits = |threads: usize| -> Vec<Vec<u64>> {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("a pool").install(|| {
                let solved = solvers().into_iter().map(|(_, mut solver)| {
                    let mut x = vec![Vect::zeros(); b.len()];
                    solver.solve(&matrix, &b, &mut x).expect("a solution");
                    x.iter()
                        .flat_map(|x| [x[0].to_bits(), x[1].to_bits()])
                        .collect()
                });
                solved.collect()
            })
        };
        let one = bits(1);
        assert!(bits(2) == one && bits(4) == one);
    }
}

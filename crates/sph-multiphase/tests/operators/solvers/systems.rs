//! Random systems like those of particles, and what solves them.

use nalgebra::{DMatrix, DVector};
use sph_core::Vect;
use sph_multiphase::linear::{
    Automatic, Bicgstab, Block, Cholesky, ConjugateGradient, Entries, Entry, LinearSolver, Matrix,
    Pattern, Preconditioner,
};

/// A linear congruence, so that tests need no crate for it.
pub struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Points in a square or a cube, coupled when near, like particles: entries of size `stiffness` times a
/// contrast of viscosities of two halves, mass 1.
fn system<const D: usize, E: Entry<D>>(
    n: usize,
    entry: impl Fn(&mut Random, &Vect<D>) -> E,
    wrap: fn(Vec<E>, Vec<E>) -> Entries<D>,
    contrast: f64,
) -> Matrix<D> {
    let mut random = Random(7);
    let points: Vec<Vect<D>> = (0..n)
        .map(|_| Vect::from_fn(|_, _| random.next()))
        .collect();
    let reach = 2.5 / (n as f64).powf(1.0 / D as f64);
    let eta = |k: usize| if points[k][0] < 0.5 { 1.0 } else { contrast };
    let mut rows = vec![Vec::new(); n];
    let mut entries = vec![Vec::new(); n];
    let mut diagonal = vec![E::unit(1.0); n];
    for i in 0..n {
        for j in 0..i {
            let apart = points[i] - points[j];
            if apart.norm() < reach {
                let mean = 2.0 * eta(i) * eta(j) / (eta(i) + eta(j));
                let c = entry(&mut random, &apart.normalize()) * mean;
                rows[i].push(j as u32);
                rows[j].push(i as u32);
                entries[i].push(c * -1.0);
                entries[j].push(c.transposed() * -1.0);
                diagonal[i] = diagonal[i] + c;
                diagonal[j] = diagonal[j] + c;
            }
        }
    }
    let others = entries.concat();
    Matrix::new(Pattern::from_rows(&rows), wrap(diagonal, others))
}

/// One number for all components.
pub fn scalar<const D: usize>(n: usize, stiffness: f64, contrast: f64) -> Matrix<D> {
    let entry = |random: &mut Random, _: &Vect<D>| stiffness * (0.5 + random.next());
    system::<D, f64>(n, entry, Entries::scalar, contrast)
}

/// Couplings of the form s (1 + 3 n nᵀ): like the Español–Revenga operator's.
pub fn block<const D: usize>(n: usize, stiffness: f64, contrast: f64) -> Matrix<D> {
    let entry = |random: &mut Random, along: &Vect<D>| {
        (Block::<D>::identity() + 3.0 * along * along.transpose()) * (stiffness * random.next())
    };
    system::<D, Block<D>>(n, entry, Entries::block, contrast)
}

/// A right-hand side.
pub fn right<const D: usize>(n: usize) -> Vec<Vect<D>> {
    let mut random = Random(3);
    (0..n)
        .map(|_| Vect::from_fn(|k, _| random.next() - if k == 0 { 0.5 } else { 0.0 }))
        .collect()
}

/// The solution by nalgebra's dense LU.
pub fn dense<const D: usize>(matrix: &Matrix<D>, right: &[Vect<D>]) -> Vec<Vect<D>> {
    let n = matrix.rows();
    let mut full = DMatrix::zeros(D * n, D * n);
    for k in 0..D * n {
        let mut unit = vec![Vect::zeros(); n];
        unit[k / D][k % D] = 1.0;
        let mut column = unit.clone();
        matrix.multiply(&unit, &mut column);
        let column = column.iter().flat_map(|c| c.iter().copied());
        full.set_column(k, &DVector::from_iterator(D * n, column));
    }
    let b = DVector::from_iterator(D * n, right.iter().flat_map(|b| b.iter().copied()));
    let x = full.lu().solve(&b).expect("a regular matrix");
    (0..n).map(|i| Vect::from_fn(|k, _| x[D * i + k])).collect()
}

/// All that are shipped, with every preconditioner.
pub fn solvers<const D: usize>() -> Vec<(String, Box<dyn LinearSolver<D>>)> {
    let mut all: Vec<(String, Box<dyn LinearSolver<D>>)> = vec![
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
            ..ConjugateGradient::default()
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

/// Largest difference over the largest component of `y`.
pub fn apart<const D: usize>(x: &[Vect<D>], y: &[Vect<D>]) -> f64 {
    let largest = y.iter().map(|y| y.amax()).fold(0.0, f64::max);
    let apart = x.iter().zip(y).map(|(x, y)| (x - y).amax());
    apart.fold(0.0, f64::max) / largest
}

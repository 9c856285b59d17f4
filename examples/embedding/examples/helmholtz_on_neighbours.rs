//! κ²u − ∇²u = f on particles of a periodic square, with `sph-neighbours`, `sph-kernels` and the linear
//! systems of `sph-multiphase` alone.

use std::f64::consts::TAU;

use sph_core::{Pool, Vect};
use sph_kernels::{Kernel, by_name};
use sph_multiphase::linear::{
    ConjugateGradient, Entries, LinearSolver, Matrix, Pattern, SolveError,
};
use sph_neighbours::{CellGrid, Clusters, Domain};

/// Largest error of u = sin(2πx) with `n` × `n` particles, over its largest value.
pub fn error(n: usize) -> Result<f64, SolveError> {
    let (spacing, kappa) = (1.0 / n as f64, 3.0);
    let at = |k: usize| (k as f64 + 0.5) * spacing;
    let points: Vec<Vect<2>> = (0..n * n).map(|i| [at(i % n), at(i / n)].into()).collect();
    let mut domain = Domain::open(Vect::zeros(), Vect::repeat(1.0));
    domain.periodic = [true; 2];
    let kernel = by_name("wendland-c4").expect("built in");
    let sampler = kernel.sampler(2, 2.5 * spacing);
    let reach = sampler.support_radius();
    let grid = CellGrid::new(&points, reach, &domain);
    let mut list = Clusters::default();
    list.build_each([&points; 2], &grid, (reach, &domain), &Pool::default());

    // ∇²u ≈ 2 Σ V (u_a − u_b) F_ab (Morris 1997), each row times V: symmetric and positive.
    let v = spacing * spacing;
    let (mut rows, mut diagonal, mut others) = (vec![], vec![], vec![]);
    for (i, x) in points.iter().enumerate() {
        let mut row = list.candidates(i).to_vec();
        row.retain(|j| *j as usize != i);
        row.sort_unstable();
        let away = |j: &u32| (x - points[*j as usize]).map(|d| d - d.round());
        let squares: Vec<f64> = row.iter().map(|j| away(j).norm_squared()).collect();
        let (mut w, mut factor) = (vec![0.0; row.len()], vec![0.0; row.len()]);
        sampler.both(&squares, &mut w, &mut factor);
        diagonal.push(v * kappa * kappa - 2.0 * v * v * factor.iter().sum::<f64>());
        others.extend(factor.iter().map(|f| 2.0 * v * v * f));
        rows.push(row);
    }
    let matrix = Matrix::<2>::new(Pattern::from_rows(&rows), Entries::scalar(diagonal, others));
    let exact: Vec<f64> = points.iter().map(|x| (TAU * x[0]).sin()).collect();
    let source = |u: &f64| Vect::from([v * (kappa * kappa + TAU * TAU) * u, 0.0]);
    let right: Vec<Vect<2>> = exact.iter().map(source).collect();
    let mut u = vec![Vect::zeros(); points.len()];
    ConjugateGradient::default().solve(&matrix, &right, &mut u)?;
    let errors = exact.iter().zip(&u).map(|(exact, u)| (u[0] - exact).abs());
    Ok(errors.fold(0.0, f64::max))
}

fn main() -> Result<(), SolveError> {
    for n in [16, 32, 64] {
        println!("{n:3} × {n:3} particles: largest error {:.2e}", error(n)?);
    }
    Ok(())
}

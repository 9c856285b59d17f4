//! Time and memory per solve against the number of particles, contrast and stiffness:
//! `cargo bench -p sph-tests --bench solver_scaling`. Not a test: it takes some minutes.

use std::time::Instant;

use sph_core::Vect;
use sph_multiphase::linear::{
    Bicgstab, Cholesky, ConjugateGradient, Entries, LinearSolver, Matrix, Pattern, Preconditioner,
};

/// Backward Euler on a lattice with Wendland-like couplings: mass 1, Σ_j c_ij = `stiffness`, and a
/// viscosity `contrast` times as large in one half.
fn matrix<const D: usize>(side: usize, reach: f64, stiffness: f64, contrast: f64) -> Matrix<D> {
    let count = side.pow(D as u32);
    let cells = reach.ceil() as i64;
    let span = (2 * cells + 1) as usize;
    let mut offsets = Vec::new();
    for k in 0..span.pow(D as u32) {
        let step: Vec<i64> = (0..D)
            .map(|a| ((k / span.pow((D - 1 - a) as u32)) % span) as i64 - cells)
            .collect();
        let r = step.iter().map(|s| (s * s) as f64).sum::<f64>().sqrt();
        if r > 0.0 && r < reach {
            offsets.push((step, (1.0 - r / reach).powi(3)));
        }
    }
    let whole: f64 = offsets.iter().map(|(_, w)| w).sum();
    let eta = |i: usize| if i < count / 2 { 1.0 } else { contrast };
    let (mut rows, mut others) = (Vec::with_capacity(count), Vec::new());
    let mut diagonal = vec![1.0; count];
    for (i, own) in diagonal.iter_mut().enumerate() {
        let place = |a: usize| ((i / side.pow((D - 1 - a) as u32)) % side) as i64;
        let mut row = Vec::new();
        for (step, w) in &offsets {
            let at: Vec<i64> = (0..D).map(|a| place(a) + step[a]).collect();
            if at.iter().any(|p| *p < 0 || *p >= side as i64) {
                continue;
            }
            let j = at.iter().fold(0, |sum, p| sum * side + *p as usize);
            let mean = 2.0 * eta(i) * eta(j) / (eta(i) + eta(j));
            let c = stiffness * w / whole * mean;
            *own += c;
            row.push(j as u32);
            others.push(-c);
        }
        rows.push(row);
    }
    Matrix::new(Pattern::from_rows(&rows), Entries::scalar(diagonal, others))
}

fn right<const D: usize>(n: usize) -> Vec<Vect<D>> {
    let wave = |i: usize, k: usize| (0.7 * i as f64 + k as f64).sin() + 0.3;
    (0..n).map(|i| Vect::from_fn(|k, _| wave(i, k))).collect()
}

fn conjugate<const D: usize>(preconditioner: Preconditioner) -> ConjugateGradient<D> {
    ConjugateGradient {
        preconditioner,
        iterations: 20_000,
        ..ConjugateGradient::default()
    }
}

/// Milliseconds of the second of two solves, and iterations.
fn timed<const D: usize>(solver: &mut dyn LinearSolver<D>, matrix: &Matrix<D>) -> (f64, usize) {
    let b = right::<D>(matrix.rows());
    let mut result = (f64::NAN, 0);
    for _ in 0..2 {
        let mut x = vec![Vect::zeros(); b.len()];
        let start = Instant::now();
        match solver.solve(matrix, &b, &mut x) {
            Ok(report) => result = (1e3 * start.elapsed().as_secs_f64(), report.iterations),
            Err(error) => {
                println!("  {error}");
                return (f64::NAN, 0);
            }
        }
    }
    result
}

/// Least-squares slope of ln t over ln n.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<_> = points.iter().map(|(n, t)| (n.ln(), t.ln())).collect();
    let count = logs.len() as f64;
    let (x, y) = logs
        .iter()
        .fold((0.0, 0.0), |s, p| (s.0 + p.0 / count, s.1 + p.1 / count));
    let (up, down) = logs.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - x) * (p.1 - y), s.1 + (p.0 - x).powi(2))
    });
    up / down
}

fn scaling<const D: usize>(sides: &[usize], reach: f64, direct_up_to: usize)
where
    ConjugateGradient<D>: LinearSolver<D>,
{
    for stiffness in [30.0, 3e3, 3e5] {
        println!("\n{D}D, stiffness {stiffness:e}: ms per solve of {D} components");
        println!("| particles | CG, diagonal | its | CG, incomplete | its | Cholesky | MB |");
        println!("|---|---|---|---|---|---|---|");
        let (mut iterative, mut direct) = (Vec::new(), Vec::new());
        let mut crossover = None;
        for &side in sides {
            let matrix = matrix::<D>(side, reach, stiffness, 1.0);
            let n = matrix.rows();
            let (quick, its) = timed(&mut conjugate(Preconditioner::IncompleteDiagonal), &matrix);
            let (full, more) = timed(&mut conjugate(Preconditioner::IncompleteCholesky), &matrix);
            iterative.push((n as f64, quick));
            let (mut ms, mut bytes) = (f64::NAN, 0);
            if n <= direct_up_to {
                let mut cholesky = Cholesky::default();
                (ms, _) = timed(&mut cholesky, &matrix);
                bytes = cholesky.bytes();
                direct.push((n as f64, ms));
                if ms < quick.min(full) {
                    crossover = Some(n);
                }
            }
            println!(
                "| {n} | {quick:.1} | {its} | {full:.1} | {more} | {ms:.1} | {:.0} |",
                bytes as f64 / 1e6
            );
        }
        println!(
            "exponents: CG {:.2}, Cholesky {:.2}; largest size at which Cholesky is the fastest: {}",
            exponent(&iterative),
            exponent(&direct),
            crossover.map_or("none".to_string(), |n| n.to_string())
        );
    }
}

fn contrasts() {
    println!(
        "\n2D, 10 000 particles, stiffness 30 in the thin half: iterations to 1e-8 against contrast"
    );
    println!(
        "| contrast | none | jacobi | incomplete-diagonal | incomplete-cholesky | bicgstab, jacobi | Cholesky, ms |"
    );
    println!("|---|---|---|---|---|---|---|");
    for contrast in [1.0, 1e2, 1e4, 1e6] {
        let matrix = matrix::<2>(100, 4.0, 30.0, contrast);
        let its: Vec<String> = [
            Preconditioner::None,
            Preconditioner::Jacobi,
            Preconditioner::IncompleteDiagonal,
            Preconditioner::IncompleteCholesky,
        ]
        .map(|p| timed(&mut conjugate(p), &matrix).1.to_string())
        .to_vec();
        let mut stabilised = Bicgstab {
            iterations: 20_000,
            ..Bicgstab::default()
        };
        let (_, bicgstab) = timed(&mut stabilised, &matrix);
        let (ms, _) = timed(&mut Cholesky::default(), &matrix);
        println!(
            "| {contrast:e} | {} | {bicgstab} | {ms:.0} |",
            its.join(" | ")
        );
    }
}

fn main() {
    // `cargo test --benches` calls this with an argument of its own.
    if std::env::args().any(|a| a == "--test") {
        return;
    }
    contrasts();
    scaling::<2>(&[32, 100, 173, 316, 548], 4.0, 310_000);
    scaling::<3>(&[10, 22, 32, 46], 2.6, 40_000);
}

//! Sparse Cholesky factorisation.

use std::sync::Arc;

use sparse::{Order, SparseError, UpperTriangle};
use sph_core::{Vect, plugin};

use crate::linear::matrix::{Entries, Matrix, Values};
use crate::linear::operator::{add, norm};
use crate::linear::{
    Entry, LinearSolver, LinearSolverEntry, LinearSystem, Pattern, Report, SolveError, SolveResult,
};

/// A = L Lᵀ by faer, with the order of elimination kept while the pattern stays the same.
///
/// As fast for any Δt and any contrast of viscosity. Memory grows like N log N in 2D (about 165 MB
/// for 50 000 particles with 46 neighbours) and much faster in 3D. One thread: the same bits on any
/// machine with any number of them.
///
/// ```toml
/// [linear-solver.cholesky]
/// ```
#[plugin(LinearSolverEntry [2, 3], "cholesky",
    "sparse factorisation by faer: any step and contrast, memory permitting; best in 2D",
    source: "faer 0.24; Davis 2006")]
pub struct Cholesky {
    #[serde(skip)]
    kept: Option<Workspace>,
}

impl Cholesky {
    /// Bytes of the factor that is kept; nothing before the first solve.
    pub fn bytes(&self) -> usize {
        let numbers = |k: &Workspace| k.factor.size() + k.upper.values.len();
        8 * self.kept.as_ref().map_or(0, numbers)
    }
}

/// Memory kept between solves.
struct Workspace {
    pattern: Arc<Pattern>,
    blocks: bool,
    upper: UpperTriangle,
    factor: sparse::Cholesky,
}

const METHOD: &str = "Cholesky";
/// Residual above which the solution is refined once.
const REFINE: f64 = 1e-10;
/// Residual above which the solution is refused.
const REFUSE: f64 = 1e-4;

impl<const D: usize> LinearSolver<D> for Cholesky {
    fn solve_to(&mut self, (operator, right, x): LinearSystem<'_, D>, _: f64) -> SolveResult {
        let matrix = operator.whole_matrix(METHOD)?;
        if right.is_empty() {
            return Ok(report(0.0, 0));
        }
        let blocks = matches!(matrix.entries, Entries::Block(_));
        let fits = |kept: &Workspace| kept.blocks == blocks && kept.pattern == matrix.pattern;
        if !self.kept.as_ref().is_some_and(fits) {
            self.kept = Some(analysed(matrix, blocks)?);
        }
        let Some(kept) = &mut self.kept else {
            return Err(SolveError::NoMemory(METHOD, right.len()));
        };
        match &matrix.entries {
            Entries::Scalar(values) => fill::<D, _>(&mut kept.upper, &matrix.pattern, values, 1),
            Entries::Block(values) => fill::<D, _>(&mut kept.upper, &matrix.pattern, values, D),
        }
        factorise(kept, right.len())?;
        solve(kept, right, x);
        let scale = norm(right).max(f64::MIN_POSITIVE);
        let mut rest = Vec::new();
        operator.residual(right, x, &mut rest);
        if norm(&rest) > REFINE * scale {
            let mut correction = vec![Vect::zeros(); rest.len()];
            solve(kept, &rest, &mut correction);
            add(x, 1.0, &correction);
            operator.residual(right, x, &mut rest);
        }
        let relative = norm(&rest) / scale;
        match relative <= REFUSE {
            true => Ok(report(relative, self.bytes())),
            false if relative.is_finite() => Err(SolveError::NotConverged {
                method: METHOD,
                wanted: REFUSE,
                iterations: 0,
                history: vec![relative],
            }),
            false => Err(SolveError::NotFinite(METHOD, "the solution")),
        }
    }
}

fn report(residual: f64, bytes: usize) -> Report {
    Report {
        method: METHOD,
        iterations: 0,
        residual,
        bytes,
    }
}

/// Order of elimination and shape of the factor.
fn analysed<const D: usize>(matrix: &Matrix<D>, blocks: bool) -> Result<Workspace, SolveError> {
    let upper = shape(&matrix.pattern, if blocks { D } else { 1 });
    let factor = sparse::Cholesky::analyse(&upper, Order::MinimumDegree);
    Ok(Workspace {
        pattern: matrix.pattern.clone(),
        blocks,
        factor: factor.map_err(|_| SolveError::NoMemory(METHOD, matrix.rows()))?,
        upper,
    })
}

fn factorise(kept: &mut Workspace, rows: usize) -> Result<(), SolveError> {
    if kept.upper.values.iter().any(|v| !v.is_finite()) {
        return Err(SolveError::NotFinite(METHOD, "the matrix"));
    }
    let done = kept.factor.factorise(&kept.upper);
    done.map_err(|refused| match refused {
        SparseError::NotPositive(row, unknowns) => {
            SolveError::NotPositive(METHOD, row * rows / unknowns)
        }
        _ => SolveError::NoMemory(METHOD, rows),
    })
}

fn solve<const D: usize>(kept: &mut Workspace, right: &[Vect<D>], x: &mut [Vect<D>]) {
    let places = x.iter_mut().enumerate();
    if kept.blocks {
        let solution = kept.factor.solve_columns(1, |r, _| right[r / D][r % D]);
        places.for_each(|(i, x)| *x = Vect::from_fn(|c, _| solution(i * D + c, 0)));
    } else {
        let solution = kept.factor.solve_columns(D, |r, c| right[r][c]);
        places.for_each(|(i, x)| *x = Vect::from_fn(|c, _| solution(i, c)));
    }
}

/// Starts of the columns and rows of the values; `size` components per particle.
fn shape(pattern: &Pattern, size: usize) -> UpperTriangle {
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for i in 0..pattern.len() {
        for c in 0..size {
            let before = pattern.columns[pattern.row(i)].iter();
            for &j in before.take_while(|j| (**j as usize) < i) {
                rows.extend((0..size).map(|r| j * size as u32 + r as u32));
            }
            rows.extend((0..=c).map(|r| (i * size + r) as u32));
            starts.push(rows.len() as u32);
        }
    }
    UpperTriangle {
        starts,
        rows,
        values: Vec::new(),
    }
}

fn fill<const D: usize, E: Entry<D>>(
    upper: &mut UpperTriangle,
    pattern: &Pattern,
    values: &Values<E>,
    size: usize,
) {
    let all = &mut upper.values;
    all.clear();
    for i in 0..pattern.len() {
        for c in 0..size {
            for k in pattern.row(i) {
                if pattern.columns[k] as usize >= i {
                    break;
                }
                // A_ji = A_ijᵀ.
                let other = &values.others[k];
                all.extend((0..size).map(|r| other.component(c, r)));
            }
            let own = &values.diagonal[i];
            all.extend((0..=c).map(|r| own.component(r, c)));
        }
    }
}

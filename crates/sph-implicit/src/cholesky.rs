//! Sparse Cholesky factorisation.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Mat, Par, Side, Spec};
use sph_core::{Vect, plugin};

use crate::matrix::{Entries, Matrix, Values};
use crate::vector::norm;
use crate::{Entry, LinearSolver, LinearSolverEntry, Operator, Pattern, Report, SolveError};

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
    kept: Option<Kept>,
}

impl Cholesky {
    /// Bytes of the factor that is kept; nothing before the first solve.
    pub fn bytes(&self) -> usize {
        let numbers = |k: &Kept| k.factor.len() + k.upper.values.len();
        8 * self.kept.as_ref().map_or(0, numbers)
    }
}

/// What outlives a solve.
struct Kept {
    pattern: Arc<Pattern>,
    blocks: bool,
    upper: Upper,
    symbolic: SymbolicCholesky<u32>,
    factor: Vec<f64>,
    stack: Option<MemBuffer>,
}

/// The upper triangle, column by column.
#[derive(Default)]
struct Upper {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

const METHOD: &str = "Cholesky";
/// Residual above which the solution is refined once.
const REFINE: f64 = 1e-10;
/// Residual above which the solution is refused.
const REFUSE: f64 = 1e-4;

impl<const D: usize> LinearSolver<D> for Cholesky {
    fn solve(
        &mut self,
        operator: &dyn Operator<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
    ) -> Result<Report, SolveError> {
        let matrix = operator.whole(METHOD)?;
        if right.is_empty() {
            return Ok(report(0.0, 0));
        }
        let blocks = matches!(matrix.entries, Entries::Block(_));
        let fits = |kept: &Kept| kept.blocks == blocks && kept.pattern == matrix.pattern;
        if !self.kept.as_ref().is_some_and(fits) {
            self.kept = Some(analysed(matrix, blocks)?);
        }
        let Some(kept) = &mut self.kept else {
            return Err(no_memory(right.len()));
        };
        match &matrix.entries {
            Entries::Scalar(values) => kept.upper.fill::<D, _>(&matrix.pattern, values, 1),
            Entries::Block(values) => kept.upper.fill::<D, _>(&matrix.pattern, values, D),
        }
        factorise(kept, right.len())?;
        solve(kept, right, x, blocks)?;
        let scale = norm(right).max(f64::MIN_POSITIVE);
        let mut rest = Vec::new();
        operator.residual(right, x, &mut rest);
        if norm(&rest) > REFINE * scale {
            let mut correction = vec![Vect::zeros(); rest.len()];
            solve(kept, &rest, &mut correction, blocks)?;
            crate::vector::add(x, 1.0, &correction);
            operator.residual(right, x, &mut rest);
        }
        let relative = norm(&rest) / scale;
        match relative <= REFUSE {
            true => Ok(report(relative, self.bytes())),
            false if relative.is_finite() => Err(SolveError::NotConverged {
                method: METHOD.into(),
                wanted: REFUSE,
                iterations: 0,
                history: vec![relative],
            }),
            false => Err(SolveError::NotFinite {
                method: METHOD.into(),
                what: "the solution",
            }),
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

fn no_memory(rows: usize) -> SolveError {
    SolveError::NoMemory {
        method: METHOD.into(),
        rows,
    }
}

/// Order of elimination and shape of the factor.
fn analysed<const D: usize>(matrix: &Matrix<D>, blocks: bool) -> Result<Kept, SolveError> {
    let mut upper = Upper::default();
    upper.shape(&matrix.pattern, if blocks { D } else { 1 });
    let n = upper.starts.len() - 1;
    let shape = SymbolicSparseColMatRef::new_checked(n, n, &upper.starts, None, &upper.rows);
    let symbolic = factorize_symbolic_cholesky(
        shape,
        Side::Upper,
        SymmetricOrdering::Amd,
        CholeskySymbolicParams::default(),
    )
    .map_err(|_| no_memory(matrix.rows()))?;
    let mut factor = Vec::new();
    let room = factor.try_reserve_exact(symbolic.len_val());
    room.map_err(|_| no_memory(matrix.rows()))?;
    factor.resize(symbolic.len_val(), 0.0);
    Ok(Kept {
        pattern: matrix.pattern.clone(),
        blocks,
        upper,
        symbolic,
        factor,
        stack: None,
    })
}

fn factorise(kept: &mut Kept, rows: usize) -> Result<(), SolveError> {
    if kept.upper.values.iter().any(|v| !v.is_finite()) {
        return Err(SolveError::NotFinite {
            method: METHOD.into(),
            what: "the matrix",
        });
    }
    let n = kept.upper.starts.len() - 1;
    let shape =
        SymbolicSparseColMatRef::new_checked(n, n, &kept.upper.starts, None, &kept.upper.rows);
    let matrix = SparseColMatRef::new(shape, &kept.upper.values);
    let room = kept
        .symbolic
        .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
    let room = room.or(kept.symbolic.solve_in_place_scratch::<f64>(4, Par::Seq));
    if kept.stack.is_none() {
        kept.stack = Some(MemBuffer::try_new(room).map_err(|_| no_memory(rows))?);
    }
    let Some(stack) = &mut kept.stack else {
        return Err(no_memory(rows));
    };
    let done = kept.symbolic.factorize_numeric_llt(
        &mut kept.factor,
        matrix,
        Side::Upper,
        Default::default(),
        Par::Seq,
        MemStack::new(stack),
        Spec::default(),
    );
    match done {
        Ok(_) => Ok(()),
        Err(LltError::NonPositivePivot { index }) => Err(SolveError::NotPositive {
            method: METHOD.into(),
            row: index * rows / n,
        }),
    }
}

fn solve<const D: usize>(
    kept: &mut Kept,
    right: &[Vect<D>],
    x: &mut [Vect<D>],
    blocks: bool,
) -> Result<(), SolveError> {
    let factor = LltRef::new(&kept.symbolic, &kept.factor);
    let Some(stack) = &mut kept.stack else {
        return Err(no_memory(right.len()));
    };
    let mut dense = match blocks {
        true => Mat::from_fn(right.len() * D, 1, |r, _| right[r / D][r % D]),
        false => Mat::from_fn(right.len(), D, |r, c| right[r][c]),
    };
    factor.solve_in_place_with_conj(Conj::No, dense.as_mut(), Par::Seq, MemStack::new(stack));
    for (i, x) in x.iter_mut().enumerate() {
        *x = Vect::from_fn(|c, _| match blocks {
            true => dense[(i * D + c, 0)],
            false => dense[(i, c)],
        });
    }
    Ok(())
}

impl Upper {
    /// Rows of every column; `size` components per particle.
    fn shape(&mut self, pattern: &Pattern, size: usize) {
        self.starts.push(0);
        for i in 0..pattern.len() {
            for c in 0..size {
                let before = pattern.columns[pattern.row(i)].iter();
                for &j in before.take_while(|j| (**j as usize) < i) {
                    self.rows
                        .extend((0..size).map(|r| j * size as u32 + r as u32));
                }
                self.rows.extend((0..=c).map(|r| (i * size + r) as u32));
                self.starts.push(self.rows.len() as u32);
            }
        }
    }

    fn fill<const D: usize, E: Entry<D>>(
        &mut self,
        pattern: &Pattern,
        values: &Values<E>,
        size: usize,
    ) {
        self.values.clear();
        for i in 0..pattern.len() {
            for c in 0..size {
                for k in pattern.row(i) {
                    if pattern.columns[k] as usize >= i {
                        break;
                    }
                    // A_ji = A_ijᵀ.
                    let other = &values.others[k];
                    self.values.extend((0..size).map(|r| other.component(c, r)));
                }
                let own = &values.diagonal[i];
                self.values.extend((0..=c).map(|r| own.component(r, c)));
            }
        }
    }
}

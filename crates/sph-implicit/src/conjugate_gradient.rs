//! Preconditioned conjugate gradients.

use std::sync::Arc;

use sph_core::{Shelf, Vect, plugin};

use crate::krylov::{Tolerance, Watch};
use crate::vector::{add, scale_and_add};
use crate::{LinearSolver, LinearSolverEntry, Operator, Preconditioner, Report, SolveError};

/// Conjugate gradients (Hestenes & Stiefel 1952), warm from the present state.
///
/// With scalar entries all components share one set of search directions. Little memory, any
/// dimension; the number of iterations grows with √(νΔt)/δr and with contrasts of viscosity.
///
/// ```toml
/// [linear-solver.conjugate-gradient]
/// preconditioner = "incomplete-diagonal"
/// ```
#[plugin(LinearSolverEntry [2, 3], "conjugate-gradient",
    "preconditioned conjugate gradients: little memory, best where steps are moderate or in 3D",
    source: "Hestenes & Stiefel 1952")]
#[derive(Clone)]
pub struct ConjugateGradient {
    /// What shortens the iteration.
    #[parameter(default, source: "docs/validation/implicit.md: iterations against contrast")]
    pub preconditioner: Preconditioner,
    /// Relative residual |b − A x| / |b| at which it ends.
    #[parameter(default: 1e-8, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    /// Iterations after which it gives up; the step is then tried again with half its length.
    #[parameter(default: ITERATIONS, unit: "1", min: 1, source: "ours")]
    pub iterations: usize,
    /// Vectors and factors of solves before, kept for their memory; solvers may share them.
    #[serde(skip)]
    pub shelf: Arc<Shelf>,
}

/// The vectors of a solve.
#[derive(Default)]
struct Vectors<const D: usize> {
    r: Vec<Vect<D>>,
    z: Vec<Vect<D>>,
    direction: Vec<Vect<D>>,
    image: Vec<Vect<D>>,
}

/// Iterations after which it gives up, unless a scene says otherwise.
pub(crate) const ITERATIONS: usize = 2000;
const METHOD: &str = "conjugate gradients";
/// Iterations after which the matrix is put into a form that is read faster: to do so takes as long as two products.
const PREPARE: usize = 3;

impl<const D: usize> LinearSolver<D> for ConjugateGradient {
    fn solve(
        &mut self,
        operator: &dyn Operator<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
    ) -> Result<Report, SolveError> {
        self.solve_roughly(operator, right, x, 0.0)
    }

    fn wants_entries(&self, _: &dyn Operator<D>) -> bool {
        self.preconditioner.factorises()
    }

    fn solve_roughly(
        &mut self,
        operator: &dyn Operator<D>,
        right: &[Vect<D>],
        x: &mut [Vect<D>],
        enough: f64,
    ) -> Result<Report, SolveError> {
        let tolerance = Tolerance {
            residual: self.tolerance.max(enough),
            iterations: self.iterations,
        };
        let shelf = &*self.shelf;
        let mut watch = Watch::new(METHOD, tolerance, operator, right, shelf)?;
        let mut vectors = shelf.lend::<Vectors<D>>();
        let Vectors {
            r,
            z,
            direction,
            image,
        } = &mut *vectors;
        operator.residual(right, x, r);
        if let Some(residual) = watch.reached(operator.norm(r))? {
            return Ok(watch.report(residual, size_of_val(&r[..])));
        }
        let precondition = self.preconditioner.bind(operator, METHOD, shelf);
        if !operator.all(precondition.is_ok()) {
            return Err(precondition.err().unwrap_or_else(|| watch.not_positive()));
        }
        let precondition = precondition?;
        let bytes = 4 * size_of_val(&r[..]) + precondition.bytes();
        z.resize(r.len(), Vect::zeros());
        precondition.apply(r, z);
        direction.clone_from(z);
        direction.resize(operator.columns(), Vect::zeros());
        image.resize(r.len(), Vect::zeros());
        let mut slope = operator.inner(r, z);
        let mut prepared = None;
        loop {
            if watch.iterations() == PREPARE {
                prepared = operator.prepared(shelf);
            }
            match &prepared {
                Some(prepared) => prepared.multiply(direction, image),
                None => operator.apply(direction, image),
            }
            let curvature = operator.inner(direction, image);
            if curvature <= 0.0 || slope <= 0.0 {
                return Err(watch.not_positive());
            }
            let length = slope / curvature;
            add(x, length, direction);
            add(r, -length, image);
            if let Some(residual) = watch.reached(operator.norm(r))? {
                return Ok(watch.report(residual, bytes));
            }
            precondition.apply(r, z);
            let next = operator.inner(r, z);
            scale_and_add(&mut direction[..z.len()], next / slope, z);
            slope = next;
        }
    }
}

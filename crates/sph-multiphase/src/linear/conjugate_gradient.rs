//! Preconditioned conjugate gradients, and their memory from solve to solve.

use sph_core::{Vect, plugin};

use crate::linear::operator::{add, scale_and_add};
use crate::linear::precondition::Factors;
use crate::linear::solver::{SolveMonitor, Tolerance};
use crate::linear::{
    Halves, LinearSolver, LinearSolverEntry, LinearSystem, Operator, Preconditioner, SolveResult,
};

/// Conjugate gradients (Hestenes & Stiefel 1952), warm from the present state.
///
/// With scalar entries all components share one set of search directions. Little memory, any
/// dimension; the number of iterations grows with √(νΔt)/δr and with contrasts of viscosity.
///
/// ```toml
/// [linear-solver.conjugate-gradient]
/// preconditioner = "incomplete-diagonal"
/// ```
#[plugin(LinearSolverEntry [2 => ConjugateGradient<2>, 3 => ConjugateGradient<3>], "conjugate-gradient",
    "preconditioned conjugate gradients: little memory, best where steps are moderate or in 3D",
    source: "Hestenes & Stiefel 1952")]
#[derive(Clone)]
#[schemars(rename = "ConjugateGradient")]
pub struct ConjugateGradient<const D: usize> {
    /// The preconditioner.
    #[parameter(default, source: "docs/validation/implicit.md: iterations against contrast")]
    pub preconditioner: Preconditioner,
    /// Relative residual |b − A x| / |b| at which it ends.
    #[parameter(default: 1e-8, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    /// Largest number of iterations; a step that needs more is tried again with half its length.
    #[parameter(default: ITERATIONS, unit: "1", min: 1, source: "ours")]
    pub iterations: usize,
    /// Vectors and factors of solves before, kept for their memory.
    #[serde(skip)]
    pub memory: Memory<D>,
}

/// Default of the largest number of iterations.
pub(crate) const ITERATIONS: usize = 2000;
const METHOD: &str = "conjugate gradients";
/// Iterations after which the matrix is put into a form that is read faster: to do so takes as long as two products.
const PREPARE: usize = 3;

impl<const D: usize> LinearSolver<D> for ConjugateGradient<D> {
    fn needs_entries(&self, _: &dyn Operator<D>) -> bool {
        self.preconditioner.factorises()
    }

    fn solve_to(&mut self, system: LinearSystem<'_, D>, enough: f64) -> SolveResult {
        let tolerance = Tolerance::new(self.tolerance.max(enough), self.iterations);
        iterate(self.preconditioner, tolerance, &mut self.memory, system)
    }
}

/// Solves A x = b, starting from x, in the memory of solves before.
///
/// # Errors
/// If the residual is above the tolerance.
pub(crate) fn iterate<const D: usize>(
    preconditioner: Preconditioner,
    tolerance: Tolerance,
    memory: &mut Memory<D>,
    (operator, right, x): LinearSystem<'_, D>,
) -> SolveResult {
    let Memory {
        history,
        r,
        z,
        direction,
        image,
        factors,
        halves,
    } = memory;
    let mut watch = SolveMonitor::new(METHOD, tolerance, operator, right, history)?;
    operator.residual(right, x, r);
    if let Some(residual) = watch.reached(operator.norm(r))? {
        return Ok(watch.report(residual, size_of_val(&r[..])));
    }
    let precondition = preconditioner.bind(operator, METHOD, factors);
    if !operator.all(precondition.is_ok()) {
        return Err(precondition.err().unwrap_or_else(|| watch.not_positive()));
    }
    let precondition = precondition?;
    let bytes = 4 * size_of_val(&r[..]) + precondition.bytes();
    z.resize(r.len(), Vect::zeros());
    precondition.apply(r, z);
    direction.clone_from(z);
    image.resize(r.len(), Vect::zeros());
    let mut slope = operator.inner(r, z);
    let (mut prepared, mut halves) = (None, Some(halves));
    loop {
        if watch.iterations() == PREPARE {
            prepared = halves.take().and_then(|halves| operator.prepared(halves));
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
        scale_and_add(direction, next / slope, z);
        slope = next;
    }
}

/// Vectors and factors of the solves before, for vectors of D components.
#[derive(Default)]
pub struct Memory<const D: usize> {
    /// Residuals of the solve at hand.
    history: Vec<f64>,
    r: Vec<Vect<D>>,
    z: Vec<Vect<D>>,
    direction: Vec<Vect<D>>,
    image: Vec<Vect<D>>,
    factors: Factors<D>,
    halves: Halves<D>,
}

impl<const D: usize> Clone for Memory<D> {
    /// None yet: a memory is not shared.
    fn clone(&self) -> Self {
        Memory::default()
    }
}

//! The left side of a system with implicit friction: products in lanes, and a matrix where one is needed.

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use sph_core::Vect;
use sph_neighbours::{CouplingsAt, Owned, Space, Visitor};

use crate::linear::{
    Assembly, Block, Diagonal, Entries, Entry, Halved, Halves, Matrix, Operator, Rows, Values,
    coupling_ratio,
};

#[derive(Default)]
pub(crate) struct Matrices<const D: usize> {
    pub scalar: Assembly<f64, D>,
    pub block: Assembly<Block<D>, D>,
}

/// The content of a lock; a panic elsewhere leaves memory that is as good as any.
fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The own entries of every row, and its whole diagonal.
#[derive(Clone, Copy)]
pub(crate) enum RowsOf<'a, const D: usize> {
    Scalar(&'a [f64], &'a [f64]),
    Block(&'a [Block<D>], &'a [Block<D>]),
}

/// (M + θΔt K) u = M u + θΔt (W u + Σ_b C_ab (u_a − u_b)).
///
/// Products take the couplings as they are kept. [`assembled`](Operator::assembled) writes the matrix down when it is first asked for.
pub struct FrictionOperator<'a, const D: usize> {
    pub(crate) couplings: CouplingsAt<'a, D>,
    pub(crate) coupling_bytes: usize,
    pub(crate) rows: RowsOf<'a, D>,
    pub(crate) matrix: OnceLock<Matrix<D>>,
    pub(crate) matrices: &'a Mutex<Matrices<D>>,
    pub(crate) space: &'a Space<D>,
}

impl<const D: usize> FrictionOperator<'_, D> {
    /// Memory of couplings and diagonals, and of the matrix if there is one.
    pub fn bytes(&self) -> usize {
        let rows = match self.rows {
            RowsOf::Scalar(own, whole) => size_of_val(own) + size_of_val(whole),
            RowsOf::Block(own, whole) => size_of_val(own) + size_of_val(whole),
        };
        self.coupling_bytes + rows + self.matrix.get().map_or(0, Matrix::bytes)
    }

    fn written(&self) -> Matrix<D> {
        let mut matrices = held(self.matrices);
        match self.rows {
            RowsOf::Scalar(own, _) => self.of_pairs(own, &mut matrices.scalar, Entries::Scalar),
            RowsOf::Block(own, _) => self.of_pairs(own, &mut matrices.block, Entries::Block),
        }
    }

    fn of_pairs<E: Entry<D>>(
        &self,
        own: &[E],
        assembly: &mut Assembly<E, D>,
        entries: fn(Values<E>) -> Entries<D>,
    ) -> Matrix<D> {
        assembly.fill_blocks([self.couplings.blocks(), own.len()], |block, rows| {
            let mut writer = Writer {
                own,
                rows,
                owned: &self.space.owned,
                particle: 0,
                left_out: E::ZERO,
            };
            self.couplings.each(block, &mut writer);
        });
        let values = std::mem::take(&mut assembly.values);
        Matrix::on(assembly.pattern.clone(), entries(values))
    }
}

impl<const D: usize> Drop for FrictionOperator<'_, D> {
    /// Lets the memory of the matrix be used again.
    fn drop(&mut self) {
        let Some(matrix) = self.matrix.take() else {
            return;
        };
        let mut matrices = held(self.matrices);
        match matrix.entries {
            Entries::Scalar(values) => matrices.scalar.values = values,
            Entries::Block(values) => matrices.block.values = values,
        }
    }
}

/// Writes rows of a matrix; couplings to copies are on the diagonal alone.
struct Writer<'a, E, const D: usize> {
    own: &'a [E],
    rows: &'a mut Rows<E, D>,
    owned: &'a Owned,
    particle: usize,
    left_out: E,
}

impl<E: Entry<D>, const D: usize> Visitor<D> for Writer<'_, E, D> {
    #[inline(always)]
    fn begin(&mut self, particle: usize, most: usize) {
        self.rows.begin(most);
        (self.particle, self.left_out) = (particle, E::ZERO);
    }
    #[inline(always)]
    fn pair(&mut self, neighbour: u32, [even, along]: [f64; 2], separation: &Vect<D>) {
        let entry = E::central(even, along, separation);
        let counts = self.owned.has(self.particle) && self.owned.has(neighbour as usize);
        if !counts {
            self.left_out = self.left_out + entry;
        }
        self.rows.couple(neighbour, &entry, counts);
    }
    #[inline(always)]
    fn end(&mut self, particle: usize) {
        let own = match self.owned.all() {
            true => self.own[particle],
            false => self.own[particle] + self.left_out,
        };
        self.rows.end(own, Vect::zeros());
    }
}

/// Largest of Σ C over the rest of the diagonal, of blocks with the means of their diagonals: Σ C is the whole less the
/// row's own part.
fn stiffness<E: Entry<D>, const D: usize>(own: &[E], whole: &[E]) -> f64 {
    let row = |(own, whole): (&E, &E)| coupling_ratio(whole.mean() - own.mean(), own.mean());
    own.iter().zip(whole).map(row).fold(0.0, f64::max)
}

impl<const D: usize> Operator<D> for FrictionOperator<'_, D> {
    fn rows(&self) -> usize {
        match self.rows {
            RowsOf::Scalar(own, _) => own.len(),
            RowsOf::Block(own, _) => own.len(),
        }
    }
    fn multiply(&self, x: &[Vect<D>], y: &mut [Vect<D>]) {
        let couplings = &self.couplings;
        match self.rows {
            RowsOf::Scalar(own, _) => couplings.sums(x, y, |i, sum| x[i] * own[i] + sum),
            RowsOf::Block(own, _) => couplings.sums(x, y, |i, sum| own[i].apply(&x[i]) + sum),
        }
        self.space.refresh(y);
    }
    fn import(&self, x: &mut [Vect<D>]) {
        self.space.refresh(x);
    }
    fn inner(&self, x: &[Vect<D>], y: &[Vect<D>]) -> f64 {
        self.space.inner(x, y)
    }
    fn all(&self, holds: bool) -> bool {
        self.space.all(holds)
    }
    fn is_whole(&self) -> bool {
        self.space.is_whole()
    }
    fn prepared<'a>(&'a self, memory: &'a mut Halves<D>) -> Option<Halved<'a, D>> {
        let whole = self.matrix.get().filter(|_| self.space.is_whole());
        whole.and_then(|matrix| matrix.prepared(memory))
    }
    fn diagonal(&self) -> Option<Diagonal<'_, D>> {
        Some(match self.rows {
            RowsOf::Scalar(_, whole) => Diagonal::Scalar(whole),
            RowsOf::Block(_, whole) => Diagonal::Block(whole),
        })
    }
    fn stiffness(&self) -> Option<f64> {
        // Rows of copies lack couplings, and are softer than those of their owners.
        let here = match self.rows {
            RowsOf::Scalar(own, whole) => stiffness::<f64, D>(own, whole),
            RowsOf::Block(own, whole) => stiffness(own, whole),
        };
        Some(self.space.largest(here))
    }
    fn assembled(&self) -> Option<&Matrix<D>> {
        Some(self.matrix.get_or_init(|| self.written()))
    }
}

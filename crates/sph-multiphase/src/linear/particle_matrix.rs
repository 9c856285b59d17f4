//! A system with one component whose rows are those of particles.

use std::sync::OnceLock;

use sph_core::Vect;
use sph_neighbours::{Owned, Space};

use crate::linear::{Entries, Halved, Halves, Matrix, Operator, Pattern, Values};

/// A matrix whose rows and columns are those of particles. Where some of these are copies of particles that are at home
/// elsewhere, they follow their owners in every product.
pub struct ParticleMatrix<'a, const D: usize> {
    matrix: &'a Matrix<1>,
    space: &'a Space<D>,
    /// Particles of the rows, if not all have one.
    places: Option<&'a [u32]>,
    /// The rows that count.
    owned: Owned,
    inside: OnceLock<Matrix<1>>,
}

impl<'a, const D: usize> ParticleMatrix<'a, D> {
    /// Of the rows of all particles, or of those at `places`; rows of copies are here, and need not be right.
    pub fn new(matrix: &'a Matrix<1>, space: &'a Space<D>, places: Option<&'a [u32]>) -> Self {
        ParticleMatrix {
            matrix,
            space,
            places,
            owned: match places {
                None => space.owned.clone(),
                Some(places) => space.owned.of_rows(places),
            },
            inside: OnceLock::new(),
        }
    }

    /// Copies follow their owners.
    fn refresh(&self, x: &mut [Vect<1>]) {
        if self.space.is_whole() {
            return;
        }
        let Some(places) = self.places else {
            self.space.refresh(x);
            return;
        };
        let mut all = vec![Vect::<1>::zeros(); self.space.particles];
        for (place, x) in places.iter().zip(&*x) {
            all[*place as usize] = *x;
        }
        self.space.refresh(&mut all);
        for (place, x) in places.iter().zip(x) {
            *x = all[*place as usize];
        }
    }

    /// The matrix without couplings to copies: its preconditioner reaches as far.
    fn cut(&self) -> Matrix<1> {
        let mut pattern = Pattern::from_rows(&[]);
        let mut cut = Values::default();
        if let Entries::Scalar(values) = &self.matrix.entries {
            cut.diagonal.clone_from(&values.diagonal);
            for i in 0..self.matrix.rows() {
                let row = self.matrix.pattern.row(i);
                for k in row {
                    let j = self.matrix.pattern.columns[k];
                    if self.owned.has(j as usize) {
                        pattern.columns.push(j);
                        cut.others.push(values.others[k]);
                    }
                }
                pattern.starts.push(pattern.columns.len() as u32);
            }
        }
        Matrix::new(pattern, Entries::Scalar(cut))
    }
}

impl<const D: usize> Operator<1> for ParticleMatrix<'_, D> {
    fn rows(&self) -> usize {
        self.matrix.rows()
    }
    fn multiply(&self, x: &[Vect<1>], y: &mut [Vect<1>]) {
        self.matrix.multiply(x, y);
        self.refresh(y);
    }
    fn import(&self, x: &mut [Vect<1>]) {
        self.refresh(x);
    }
    fn inner(&self, x: &[Vect<1>], y: &[Vect<1>]) -> f64 {
        self.space.inner_of(&self.owned, x, y)
    }
    fn all(&self, holds: bool) -> bool {
        self.space.all(holds)
    }
    fn is_whole(&self) -> bool {
        self.space.is_whole()
    }
    fn prepared<'b>(&'b self, memory: &'b mut Halves<1>) -> Option<Halved<'b, 1>> {
        match self.is_whole() {
            true => self.matrix.prepared(memory),
            false => None,
        }
    }
    fn assembled(&self) -> Option<&Matrix<1>> {
        Some(match self.is_whole() {
            true => self.matrix,
            false => self.inside.get_or_init(|| self.cut()),
        })
    }
}

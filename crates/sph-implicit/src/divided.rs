//! A system with one component whose rows are divided between ranks.

use std::sync::OnceLock;

use sph_core::Vect;
use sph_neighbours::{SharedRows, inner};

use crate::{Entries, Matrix, Operator, Pattern, Values};

/// A matrix whose rows are divided between ranks. Its columns are one's own particles and copies of others', which follow their
/// owners in every product.
pub struct DividedMatrix<'a, const D: usize> {
    matrix: &'a Matrix<1>,
    rows: SharedRows<D>,
    /// Particles of the rows, if not all have one.
    places: Option<&'a [u32]>,
    own: Vec<bool>,
    inside: OnceLock<Matrix<1>>,
}

impl<'a, const D: usize> DividedMatrix<'a, D> {
    /// Of the rows of all particles, or of those at `places`; rows of copies are here, and need not be right.
    pub fn new(matrix: &'a Matrix<1>, rows: SharedRows<D>, places: Option<&'a [u32]>) -> Self {
        let own = match places {
            None => rows.own.clone(),
            Some(places) => places.iter().map(|p| rows.own[*p as usize]).collect(),
        };
        DividedMatrix {
            matrix,
            rows,
            places,
            own,
            inside: OnceLock::new(),
        }
    }

    /// Copies follow their owners.
    fn mirror(&self, x: &mut [Vect<1>]) {
        let Some(places) = self.places else {
            self.rows.team.mirror_scalars(x);
            return;
        };
        let mut all = vec![Vect::<1>::zeros(); self.rows.own.len()];
        for (place, x) in places.iter().zip(&*x) {
            all[*place as usize] = *x;
        }
        self.rows.team.mirror_scalars(&mut all);
        for (place, x) in places.iter().zip(x) {
            *x = all[*place as usize];
        }
    }

    /// The matrix without what couples rows of different ranks: its preconditioner reaches as far.
    fn cut(&self) -> Matrix<1> {
        let mut pattern = Pattern {
            starts: vec![0],
            columns: Vec::new(),
        };
        let mut cut = Values::default();
        if let Entries::Scalar(values) = &self.matrix.entries {
            cut.diagonal.clone_from(&values.diagonal);
            for i in 0..self.matrix.rows() {
                let row = self.matrix.pattern.row(i);
                for (j, value) in row
                    .clone()
                    .map(|k| (self.matrix.pattern.columns[k], values.others[k]))
                {
                    if self.own[j as usize] {
                        pattern.columns.push(j);
                        cut.others.push(value);
                    }
                }
                pattern.starts.push(pattern.columns.len() as u32);
            }
        }
        Matrix::new(pattern, Entries::Scalar(cut))
    }
}

impl<const D: usize> Operator<1> for DividedMatrix<'_, D> {
    fn rows(&self) -> usize {
        self.matrix.rows()
    }
    fn multiply(&self, x: &[Vect<1>], y: &mut [Vect<1>]) {
        self.matrix.multiply(x, y);
        self.mirror(y);
    }
    fn import(&self, x: &mut [Vect<1>]) {
        self.mirror(x);
    }
    fn inner(&self, x: &[Vect<1>], y: &[Vect<1>]) -> f64 {
        self.rows.team.add(inner(x, y, &self.own))
    }
    fn all(&self, holds: bool) -> bool {
        self.rows.all(holds)
    }
    fn is_whole(&self) -> bool {
        false
    }
    fn assembled(&self) -> Option<&Matrix<1>> {
        Some(self.inside.get_or_init(|| self.cut()))
    }
}

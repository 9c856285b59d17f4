//! The upper triangle of a symmetric matrix, column by column.

/// A symmetric matrix by the columns of its upper triangle: rows of each column ascending, the diagonal last.
#[derive(Clone, Debug, Default)]
pub struct UpperTriangle {
    /// Begin of each column, and the end of the last one.
    pub starts: Vec<u32>,
    /// Row of each value.
    pub rows: Vec<u32>,
    /// Column by column.
    pub values: Vec<f64>,
}

impl UpperTriangle {
    /// From a diagonal and entries (column, row, value) with row < column, in any order; entries of one place
    /// are added up in the order given.
    pub fn new(diagonal: &[f64], mut entries: Vec<(u32, u32, f64)>) -> Self {
        entries.sort_by_key(|(column, row, _)| (*column, *row));
        let mut matrix = Self {
            starts: vec![0],
            ..Self::default()
        };
        let mut entries = entries.into_iter().peekable();
        for (column, own) in (0_u32..).zip(diagonal) {
            let first = matrix.rows.len();
            while let Some((_, row, value)) = entries.next_if(|e| e.0 == column) {
                if matrix.rows.len() > first && matrix.rows.last() == Some(&row) {
                    let last = matrix.values.len() - 1;
                    matrix.values[last] += value;
                } else {
                    matrix.rows.push(row);
                    matrix.values.push(value);
                }
            }
            matrix.rows.push(column);
            matrix.values.push(*own);
            matrix.starts.push(matrix.rows.len() as u32);
        }
        matrix
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// True if there are no unknowns.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Place of a diagonal value.
    pub fn diagonal(&self, i: usize) -> usize {
        self.starts[i + 1] as usize - 1
    }

    /// y = A x.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for j in 0..self.len() {
            let own = self.diagonal(j);
            for k in self.starts[j] as usize..own {
                let (i, a) = (self.rows[k] as usize, self.values[k]);
                y[i] += a * x[j];
                y[j] += a * x[i];
            }
            y[j] += self.values[own] * x[j];
        }
    }
}

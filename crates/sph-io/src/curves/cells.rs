//! Values sorted into cells by their places.

use std::collections::HashMap;

/// Values by the cubic cell of their place.
pub(crate) struct PlaceCells<T> {
    side: f64,
    cells: HashMap<[i64; 3], Vec<T>>,
}

impl<T> PlaceCells<T> {
    /// No values, in cells of this side.
    pub(crate) fn new(side: f64) -> Self {
        PlaceCells {
            side,
            cells: HashMap::new(),
        }
    }

    fn cell(&self, x: [f64; 3]) -> [i64; 3] {
        x.map(|x| (x / self.side).floor() as i64)
    }

    /// Adds a value at a place.
    pub(crate) fn add(&mut self, x: [f64; 3], value: T) {
        self.cells.entry(self.cell(x)).or_default().push(value);
    }

    /// The values in the cell of a place and in those around it: all that are nearer than a side, and more.
    pub(crate) fn around(&self, x: [f64; 3]) -> impl Iterator<Item = &T> {
        let middle = self.cell(x);
        let cells = (0..27).map(|k| [k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1]);
        let here = cells.filter_map(move |d| self.cells.get(&[0, 1, 2].map(|k| middle[k] + d[k])));
        here.flatten()
    }
}

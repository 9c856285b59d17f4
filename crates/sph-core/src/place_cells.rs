//! Values sorted into cells by their places.

use std::collections::HashMap;

/// Values by the cubic cell of their place.
pub struct PlaceCells<const D: usize, T> {
    side: f64,
    cells: HashMap<[i64; D], Vec<T>>,
}

/// All vectors with entries −1, 0 and 1.
pub fn offsets<const D: usize>() -> impl Iterator<Item = [i64; D]> {
    let digit = |n: usize, k: usize| (n / 3_usize.pow(k as u32) % 3) as i64 - 1;
    (0..3_usize.pow(D as u32)).map(move |n| std::array::from_fn(|k| digit(n, k)))
}

impl<const D: usize, T> PlaceCells<D, T> {
    /// Values with their places, in cells of this side.
    pub fn new(side: f64, values: impl IntoIterator<Item = ([f64; D], T)>) -> Self {
        let cells = HashMap::new();
        let mut all = PlaceCells { side, cells };
        for (x, value) in values {
            all.add(x, value);
        }
        all
    }

    fn cell(&self, x: [f64; D]) -> [i64; D] {
        x.map(|x| (x / self.side).floor() as i64)
    }

    /// Adds a value at a place.
    pub fn add(&mut self, x: [f64; D], value: T) {
        self.cells.entry(self.cell(x)).or_default().push(value);
    }

    /// The values in the cell of a place and in those around it: all that are nearer than a side, and more.
    pub fn around(&self, x: [f64; D]) -> impl Iterator<Item = &T> {
        let middle = self.cell(x);
        let beside = move |d: [i64; D]| std::array::from_fn(|k| middle[k].saturating_add(d[k]));
        let cells = offsets().filter_map(move |d| self.cells.get::<[i64; D]>(&beside(d)));
        cells.flatten()
    }
}

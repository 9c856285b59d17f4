//! The time series of a run, and its other tables.

use std::path::Path;

use sph_io::{Table, read_table};

/// Columns by their names, which must be there.
pub struct Series(Table);

impl Series {
    /// That of a folder of results.
    #[track_caller]
    pub fn read(results: &Path) -> Self {
        Series::of(&results.join("series.csv"))
    }

    /// Any other table.
    #[track_caller]
    pub fn of(path: &Path) -> Self {
        Series(read_table(path).unwrap_or_else(|e| panic!("{e}")))
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.0.rows()
    }

    /// The values of a column.
    #[track_caller]
    pub fn column(&self, name: &str) -> &[f64] {
        let column = self.0.column(name);
        column.unwrap_or_else(|| panic!("no column `{name}`"))
    }

    /// The values of some columns.
    #[track_caller]
    pub fn columns<const N: usize>(&self, names: [&str; N]) -> [&[f64]; N] {
        names.map(|name| self.column(name))
    }

    /// The last value of a column.
    #[track_caller]
    pub fn last(&self, name: &str) -> f64 {
        *self.column(name).last().expect("a row")
    }

    /// The change of a column from the first row to the last.
    #[track_caller]
    pub fn change(&self, name: &str) -> f64 {
        self.last(name) - self.column(name)[0]
    }

    /// The largest value of a column.
    #[track_caller]
    pub fn largest(&self, name: &str) -> f64 {
        let values = self.column(name).iter().copied();
        values.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The largest size of a column's values.
    #[track_caller]
    pub fn largest_size(&self, name: &str) -> f64 {
        let values = self.column(name).iter();
        values.fold(0.0, |most: f64, x| most.max(x.abs()))
    }

    /// The value of a column in the last row up to a time, and the time of that row.
    #[track_caller]
    pub fn at(&self, name: &str, time: f64) -> (f64, f64) {
        let mut rows = self.column("time").iter().zip(self.column(name));
        let row = rows.rfind(|(t, _)| **t <= time + 1e-9).expect("a row");
        (*row.0, *row.1)
    }

    /// The mean of a column from a time on.
    #[track_caller]
    pub fn mean(&self, name: &str, from: f64) -> f64 {
        let rows = self.column("time").iter().zip(self.column(name));
        let late: Vec<f64> = rows.filter(|(t, _)| **t >= from).map(|(_, x)| *x).collect();
        late.iter().sum::<f64>() / late.len() as f64
    }
}

//! A table that is written at once.

use std::path::Path;

use crate::error::Result;
use crate::files::atomic::{Durability, write_atomic};
use crate::files::series::{headings, line};

/// Writes a CSV file with a header `x[m],height[m],…`, all or nothing.
///
/// Columns are (name, unit); reals are written in the shortest form that reads back to the same bits.
///
/// ```
/// # use sph_io::{read_table, write_table};
/// # let folder = tempfile::tempdir()?;
/// let path = folder.path().join("line.csv");
/// write_table(&path, [("x", "m"), ("height", "m")], &[vec![0.0, 0.1], vec![0.5, 0.3]])?;
/// assert_eq!(read_table(&path)?.column("height"), Some(&[0.1, 0.3][..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_table<N: AsRef<str>, U: AsRef<str>>(
    path: impl AsRef<Path>,
    columns: impl IntoIterator<Item = (N, U)>,
    rows: &[Vec<f64>],
) -> Result<()> {
    let path = path.as_ref();
    let cells = headings(path, columns)?;
    let lines = rows.iter().map(|row| line(path, row, cells.len()));
    let text = (cells.join(",") + "\n") + &lines.collect::<Result<String>>()?;
    write_atomic(path, Durability::Process, |file| {
        file.write_all(text.as_bytes())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::table::read_table;

    #[test]
    fn a_table_reads_back_to_its_bits_and_a_ragged_one_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let rows = [vec![0.1, f64::NAN], vec![1.0 / 3.0, -0.0]];
        write_table(&path, [("a", "m"), ("b", "")], &rows).unwrap();
        let table = read_table(&path).unwrap();
        let [a, b] = [0, 1].map(|k| table.columns[k].values.clone());
        assert_eq!(a, [0.1, 1.0 / 3.0]);
        assert!(b[0].is_nan() && b[1].to_bits() == (-0.0_f64).to_bits());
        let error = write_table(&path, [("a", "m")], &rows).unwrap_err();
        assert!(error.to_string().contains("2 values for 1"), "{error}");
        assert_eq!(read_table(&path).unwrap().rows(), 2, "the old one stays");
    }
}

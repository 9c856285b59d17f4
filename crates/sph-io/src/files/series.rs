//! Tables that are written: by one row at a time while the run goes on, or at once.

use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::{IoError, Result};
use crate::files::disk::write_whole;

/// Writes a CSV file with a header `time[s],dt[s],…`, one flushed row at a time.
///
/// Reals are written in the shortest form that reads back to the same bits (but for the payload of a NaN). A row that
/// cannot be written whole is taken back, so that the file always ends after a row.
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    file: File,
    columns: usize,
    position: u64,
}

/// True if the path is a pipe, which would wait for a reader, or a link, which may lead to files of other users.
fn leads_elsewhere(path: &Path) -> bool {
    let kind = std::fs::symlink_metadata(path).map(|known| known.file_type());
    kind.is_ok_and(|kind| {
        #[cfg(unix)]
        let pipe = std::os::unix::fs::FileTypeExt::is_fifo(&kind);
        #[cfg(not(unix))]
        let pipe = false;
        pipe || kind.is_symlink()
    })
}

impl SeriesWriter {
    /// Starts a series with columns given as (name, unit); an empty unit stands for a pure number.
    ///
    /// ```
    /// # use sph_io::{SeriesWriter, read_table};
    /// # let folder = tempfile::tempdir()?;
    /// let path = folder.path().join("series.csv");
    /// let mut series = SeriesWriter::create(&path, [("time", "s"), ("energy", "J")])?;
    /// series.row(&[0.0, 12.5])?;
    /// assert_eq!(read_table(&path)?.column("energy"), Some(&[12.5][..]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn create<N: AsRef<str>, U: AsRef<str>>(
        path: impl AsRef<Path>,
        columns: impl IntoIterator<Item = (N, U)>,
    ) -> Result<Self> {
        let path = path.as_ref();
        let cells = headings(path, columns)?;
        let failed = |e| IoError::write(path, e);
        if leads_elsewhere(path) {
            let why = "what has this name is a link or a pipe";
            return Err(failed(std::io::Error::other(why)));
        }
        let mut series = Self {
            path: path.into(),
            file: File::create(path).map_err(failed)?,
            columns: cells.len(),
            position: 0,
        };
        series.append(&(cells.join(",") + "\n"))?;
        Ok(series)
    }

    /// Continues the series at the byte `offset` that [`position`](Self::position) gave when the run was checkpointed;
    /// the rest is cut off.
    ///
    /// A file that is shorter, has no end of row there, or has other columns, is refused untouched.
    pub fn open_truncated<N: AsRef<str>, U: AsRef<str>>(
        path: impl AsRef<Path>,
        offset: u64,
        columns: impl IntoIterator<Item = (N, U)>,
    ) -> Result<Self> {
        let path = path.as_ref();
        let cells = headings(path, columns)?;
        let failed = |e| IoError::read(path, e);
        let opened = OpenOptions::new().read(true).write(true).open(path);
        let mut file = opened.map_err(failed)?;
        let found = file.metadata().map_err(failed)?.len();
        if found < offset {
            return Err(IoError::TooShort(path.into(), found, "bytes", offset));
        }
        let malformed = |problem: &str| IoError::Malformed(path.into(), problem.into());
        let mut header = Vec::new();
        let mut start = BufReader::new((&file).take(offset));
        start.read_until(b'\n', &mut header).map_err(failed)?;
        if header.pop() != Some(b'\n') {
            return Err(malformed("it has no header before that place"));
        }
        if let Some(problem) = difference(&String::from_utf8_lossy(&header), &cells) {
            return Err(malformed(&problem));
        }
        let mut end = [0];
        file.seek(SeekFrom::Start(offset - 1)).map_err(failed)?;
        file.read_exact(&mut end).map_err(failed)?;
        if end != *b"\n" {
            return Err(malformed("no row ends at that place"));
        }
        file.set_len(offset).map_err(|e| IoError::write(path, e))?;
        Ok(Self {
            path: path.into(),
            file,
            columns: cells.len(),
            position: offset,
        })
    }

    /// Appends one row and hands it to the operating system.
    pub fn row(&mut self, values: &[f64]) -> Result<()> {
        let line = line(&self.path, values, self.columns)?;
        self.append(&line)
    }

    /// Length of the file in bytes; give it to [`open_truncated`](Self::open_truncated) to continue from here.
    pub fn position(&self) -> u64 {
        self.position
    }

    fn append(&mut self, line: &str) -> Result<()> {
        let written = self.file.write_all(line.as_bytes());
        if let Err(error) = written.and_then(|()| self.file.flush()) {
            // A device cannot be shortened; the error that matters is the first.
            let _ = self.file.set_len(self.position);
            let _ = self.file.seek(SeekFrom::Start(self.position));
            return Err(IoError::write(&self.path, error));
        }
        self.position += line.len() as u64;
        Ok(())
    }
}

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
    write_whole(path, text)
}

/// Difference of a header from the columns that are to be written under it.
fn difference(header: &str, cells: &[String]) -> Option<String> {
    let before: Vec<&str> = header.split(',').collect();
    let new = cells.iter().find(|c| !before.contains(&c.as_str()));
    let gone = before.iter().find(|b| !cells.iter().any(|c| c == *b));
    match (new, gone) {
        _ if before == *cells => None,
        (Some(cell), _) => Some(format!("it has no column `{cell}`")),
        (None, Some(cell)) => Some(format!("its column `{cell}` is no longer measured")),
        (None, None) => Some("its columns are in another order".into()),
    }
}

fn line(path: &Path, values: &[f64], columns: usize) -> Result<String> {
    if values.len() != columns {
        let problem = format!("a row of {} values for {columns} columns", values.len());
        return Err(IoError::input(path, problem));
    }
    let cells: Vec<String> = values.iter().map(|v| format!("{v:?}")).collect();
    Ok(cells.join(",") + "\n")
}

/// The cells of a header for columns given as (name, unit).
fn headings<N: AsRef<str>, U: AsRef<str>>(
    path: &Path,
    columns: impl IntoIterator<Item = (N, U)>,
) -> Result<Vec<String>> {
    let mut cells = Vec::new();
    for (name, unit) in columns {
        let name = name.as_ref();
        let cell = match unit.as_ref() {
            "" => name.to_string(),
            unit => format!("{name}[{unit}]"),
        };
        if cell.contains([',', '"', '\n', '\r', '#']) || name.trim().is_empty() {
            let problem = format!("`{cell}` cannot be the heading of a column");
            return Err(IoError::input(path, problem));
        }
        if cells.contains(&cell) {
            return Err(IoError::input(path, format!("two columns `{cell}`")));
        }
        cells.push(cell);
    }
    if cells.is_empty() {
        return Err(IoError::input(path, "a series needs a column"));
    }
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::table::read_table;

    const COLUMNS: [(&str, &str); 3] = [("time", "s"), ("x", "m"), ("steps", "")];

    #[test]
    fn every_real_reads_back_to_its_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.csv");
        let mut series = SeriesWriter::create(&path, COLUMNS).unwrap();
        let odd = [0.1, -0.0, 5e-324, f64::MAX, 1.0 / 3.0, f64::INFINITY];
        for x in odd {
            series.row(&[x, -x, f64::NAN]).unwrap();
        }
        let table = read_table(&path).unwrap();
        let back = table.column("time").unwrap();
        let back: Vec<u64> = back.iter().map(|x| x.to_bits()).collect();
        assert_eq!(back, odd.map(f64::to_bits));
        assert!(table.column("steps").unwrap()[0].is_nan());
        assert_eq!(std::fs::metadata(&path).unwrap().len(), series.position());
    }

    #[test]
    fn a_resumed_series_is_the_uninterrupted_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.csv");
        let mut series = SeriesWriter::create(&path, COLUMNS).unwrap();
        series.row(&[0.0, 1.0, 2.0]).unwrap();
        let mark = series.position();
        series.row(&[1.0, 1.0, 2.0]).unwrap();
        let whole = std::fs::read(&path).unwrap();
        series.row(&[9.0, 9.0, 9.0]).unwrap();
        drop(series);

        let mut series = SeriesWriter::open_truncated(&path, mark, COLUMNS).unwrap();
        series.row(&[1.0, 1.0, 2.0]).unwrap();
        assert!(series.row(&[1.0]).is_err());
        assert_eq!(std::fs::read(&path).unwrap(), whole);

        let beyond = SeriesWriter::open_truncated(&path, 1 << 20, COLUMNS).unwrap_err();
        assert!(matches!(beyond, IoError::TooShort { .. }), "{beyond}");
        for inside in [0, 3, mark - 1] {
            let error = SeriesWriter::open_truncated(&path, inside, COLUMNS).unwrap_err();
            assert!(matches!(error, IoError::Malformed(..)), "{error}");
        }
        let more = COLUMNS.into_iter().chain([("front", "m")]);
        let turned = COLUMNS.into_iter().rev();
        let other =
            |columns: Vec<_>| SeriesWriter::open_truncated(&path, mark, columns).unwrap_err();
        for (columns, why) in [
            (more.collect(), "no column `front[m]`"),
            (COLUMNS[..2].to_vec(), "`steps` is no longer measured"),
            (turned.collect(), "another order"),
        ] {
            let error = other(columns).to_string();
            assert!(error.contains(why), "{error}");
        }
        assert_eq!(std::fs::read(&path).unwrap(), whole);
    }

    #[test]
    fn headings_that_would_break_the_table_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.csv");
        for bad in ["a,b", "", "a\nb", "#a"] {
            assert!(SeriesWriter::create(&path, [(bad, "m")]).is_err(), "{bad}");
        }
        assert!(SeriesWriter::create(&path, [("a", "m"), ("a", "m")]).is_err());
        assert!(!path.exists());
    }

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

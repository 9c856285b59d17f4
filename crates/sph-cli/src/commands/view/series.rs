//! The series of a run with no more rows than a curve shows.

use std::fs::File;
use std::io::{BufRead, BufReader, Result};
use std::path::Path;

/// Parts of the rows, of which the lowest and the highest are kept.
const PARTS: usize = 1000;
/// Rows at the end, all of which are kept.
const LAST: usize = 8;

/// The head of a series and, row by row, what a curve of a column needs: the first row, of every part the lowest and
/// the highest, and the last ones. Without such a column it is the one after the time.
pub fn thinned(file: &Path, column: &str) -> Result<String> {
    let lines = || Ok::<_, std::io::Error>(BufReader::new(File::open(file)?).lines());
    let rows = lines()?.count().saturating_sub(1);
    let mut lines = lines()?;
    let mut text = lines.next().transpose()?.unwrap_or_default();
    let columns = text.split(',').count();
    let place = text.split(',').position(|name| name == column).unwrap_or(1);
    let per_part = rows.div_ceil(PARTS).max(1);
    // The lowest and the highest row of a part.
    let mut ends: [Option<(usize, f64, String)>; 2] = [None, None];
    for (k, line) in (0..rows).zip(lines) {
        let line = line?;
        // A row that is being written may lack its end.
        let whole = line.split(',').count() == columns;
        let value = line.split(',').nth(place).map(|cell| cell.trim().parse());
        let value: f64 = value.and_then(|v| v.ok()).unwrap_or(f64::NAN);
        if whole && (k == 0 || k + LAST >= rows || per_part <= 2) {
            text.push('\n');
            text.push_str(&line);
        } else if whole && value.is_finite() {
            for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
                if end
                    .as_ref()
                    .is_none_or(|(_, most, _)| sign * value > sign * most)
                {
                    *end = Some((k, value, line.clone()));
                }
            }
        }
        if (k + 1) % per_part == 0 || k + 1 + LAST == rows {
            let mut kept: Vec<_> = ends.iter_mut().filter_map(Option::take).collect();
            kept.sort_by_key(|(k, ..)| *k);
            kept.dedup_by_key(|(k, ..)| *k);
            for (_, _, line) in kept {
                text.push('\n');
                text.push_str(&line);
            }
        }
    }
    text.push('\n');
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_series_keeps_its_ends_and_its_peaks() {
        let folder = sph_io::Scratch::new(".sph-series-").expect("a folder");
        let file = folder.path().join("series.csv");
        let row = |k: usize| format!("{k},{},{}\n", if k == 77_777 { 9 } else { k % 2 }, k % 3);
        let rows: String = (0..200_000).map(row).collect();
        std::fs::write(&file, format!("time[s],a,b\n{rows}200000,4")).expect("written");
        for (column, most) in [("a", "9"), ("", "9"), ("b", "2")] {
            let text = thinned(&file, column).expect("read");
            assert!((1000..3000).contains(&text.lines().count()));
            let place = if column == "b" { 2 } else { 1 };
            let found = text
                .lines()
                .skip(1)
                .map(|l| l.split(',').nth(place).expect("a number"));
            assert_eq!(found.max(), Some(most));
            let times = text
                .lines()
                .skip(1)
                .map(|l| l.split(',').next().and_then(|t| t.parse().ok()));
            let times: Vec<usize> = times.map(|t| t.expect("a time")).collect();
            assert!(times.is_sorted() && times[0] == 0);
            assert_eq!(
                times[times.len() - 7..],
                [
                    199_993, 199_994, 199_995, 199_996, 199_997, 199_998, 199_999
                ]
            );
        }
    }
}

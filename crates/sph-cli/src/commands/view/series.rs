//! The series of a run with no more rows than a curve shows.

use std::fs::File;
use std::io::{BufRead, BufReader, Result};
use std::path::Path;

/// Parts of the rows, of which the lowest and the highest are kept.
const PARTS: usize = 1000;
/// Rows at the end, all of which are kept.
const LAST: usize = 8;

/// The head of a series and, row by row, the data for a curve of a column: the first row, of every part the lowest and
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
            text.push_str(&format!("\n{line}"));
        } else if whole && value.is_finite() {
            for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
                let kept = end.as_ref();
                if kept.is_none_or(|(_, most, _)| sign * value > sign * most) {
                    *end = Some((k, value, line.clone()));
                }
            }
        }
        if (k + 1) % per_part == 0 || k + 1 + LAST == rows {
            let mut kept: Vec<_> = ends.iter_mut().filter_map(Option::take).collect();
            kept.sort_by_key(|(k, ..)| *k);
            kept.dedup_by_key(|(k, ..)| *k);
            text.extend(kept.into_iter().map(|(.., line)| format!("\n{line}")));
        }
    }
    text.push('\n');
    Ok(text)
}

/// Columns that every run has.
const COMMON: &str = "dt momentum kinetic_energy potential_energy internal_energy \
                      largest_speed least_density_ratio largest_density_ratio";

/// The column that a page opens on: the first one of a probe that changes, else the first of a probe, else the kinetic energy,
/// else the first one after the time.
pub fn first_shown(file: &Path) -> Option<String> {
    let mut lines = BufReader::new(File::open(file).ok()?).lines();
    let head = lines.next()?.ok()?;
    let names: Vec<&str> = head.split(',').collect();
    let plain = |k: usize| names[k].split(['[', '.']).next().unwrap_or_default();
    let probes = (1..names.len()).filter(|k| !COMMON.split(' ').any(|name| name == plain(*k)));
    let probes: Vec<usize> = probes.collect();
    let mut seen = vec![None; names.len()];
    let mut changes = vec![false; names.len()];
    for line in lines.map_while(Result::ok) {
        for (k, cell) in line.split(',').enumerate().take(names.len()) {
            if let Some(x) = cell.trim().parse::<f64>().ok().filter(|x| x.is_finite()) {
                changes[k] |= *seen[k].get_or_insert(x) != x;
            }
        }
        if probes.first().is_none_or(|k| changes[*k]) {
            break;
        }
    }
    let changing = probes.iter().find(|k| changes[**k]);
    let energy = || (1..names.len()).find(|k| plain(*k) == "kinetic_energy");
    let shown = changing.or(probes.first()).copied().or_else(energy);
    Some(names.get(shown.unwrap_or(1))?.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_opens_on_a_probe_that_has_something_to_show() {
        let folder = sph_io::Scratch::new(".sph-series-").expect("a folder");
        let file = folder.path().join("series.csv");
        let opens_on = |text: &str| {
            std::fs::write(&file, text).expect("written");
            first_shown(&file)
        };
        let head = "time[s],dt[s],momentum.x[kg m/s],kinetic_energy[J]";
        let probes = format!("{head},gate[m],front[m]\n0,1,2,3,0,0.1\n1,1,2,4,0,0.2\n");
        assert_eq!(opens_on(&probes).as_deref(), Some("front[m]"));
        let still = format!("{head},gate[m]\n0,1,2,3,nan\n");
        assert_eq!(opens_on(&still).as_deref(), Some("gate[m]"));
        let energy = opens_on(&format!("{head}\n0,1,2,3\n"));
        assert_eq!(energy.as_deref(), Some("kinetic_energy[J]"));
        let height = opens_on("time[s],height[m]\n");
        assert_eq!(height.as_deref(), Some("height[m]"));
    }

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
            let cells = |place: usize| {
                let rows = text.lines().skip(1);
                rows.map(move |row| row.split(',').nth(place).expect("a number"))
            };
            assert_eq!(cells(place).max(), Some(most));
            let times = cells(0).map(|t| t.parse().expect("a time"));
            let times: Vec<usize> = times.collect();
            assert!(times.is_sorted() && times[0] == 0);
            let last: Vec<usize> = (199_993..=199_999).collect();
            assert_eq!(times[times.len() - 7..], last);
        }
    }
}

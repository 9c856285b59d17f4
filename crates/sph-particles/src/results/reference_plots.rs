//! Pictures of probes beside their references.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use sph_core::labelled;
use sph_io::{Plot, Series, read_table};
use sph_scene::{Norm, Scene};

use crate::failure::error::Result;
use crate::results::references::measured;
use crate::setup::reference_series;

/// More points than this are drawn as a line: markers would cover one another, and the run.
const MOST_MARKERS: usize = 200;

/// Longest list of authors in a legend, characters.
const LONGEST: usize = 40;

/// A reference is shown this much beyond the end of the run, over its length.
const BEYOND: f64 = 0.05;

/// A picture of every probe beside its reference, `plots/NAME.png`.
pub fn plots(scene: &Scene, folder: &Path) -> Result<()> {
    let compared = scene.reference.iter().filter_map(|(name, r)| {
        let (probe, path) = r.probe.as_ref().zip(r.path.as_ref())?;
        Some((name, r, probe, path))
    });
    let compared: Vec<_> = compared.collect();
    if compared.is_empty() {
        return Ok(());
    }
    let table = read_table(folder.join("series.csv"))?;
    let plots = folder.join("plots");
    sph_io::writable(&plots)?;
    for (name, reference, probe, path) in compared {
        let Some((times, values)) = measured(&table, reference, probe) else {
            continue;
        };
        let Ok([at, low, high]) = reference_series(reference, path) else {
            continue;
        };
        let shown = shown(&at, scene.run.end);
        let of = |column: Vec<f64>| -> Vec<f64> {
            let of_column = shown.iter().filter_map(|k| column.get(*k));
            of_column.copied().collect()
        };
        let pairs = |x: &[f64], y: &[f64]| -> Vec<[f64; 2]> {
            x.iter().zip(y).map(|(x, y)| [*x, *y]).collect()
        };
        let lower = pairs(&of(at), &of(low));
        let source = source(path).unwrap_or_else(|| name.clone());
        let given = match reference.norm() {
            Norm::Band => Series::band(format!("band: {source}"), lower, of(high)),
            _ if lower.len() > MOST_MARKERS => Series::line(source, lower),
            _ => Series::markers(source, lower),
        };
        let column = table.columns.iter().find(|c| c.name == *probe);
        let y_label = labelled(probe, column.map_or("", |c| &c.unit));
        let plot = Plot {
            title: format!("{}: {name}", scene.title),
            x_label: "time [s]".into(),
            y_label,
            series: vec![given, Series::line("this run", pairs(times, &values))],
            ..Plot::default()
        };
        plot.save(plots.join(format!("{name}.png")))?;
    }
    Ok(())
}

/// Authors of the reference: the text of a line `# Source: …` of its file up to the year.
fn source(path: &Path) -> Option<String> {
    let lines = BufReader::new(File::open(path).ok()?).lines();
    let lines = lines.map_while(Result::ok);
    let mut heads = lines.take_while(|line| line.starts_with('#'));
    heads.find_map(|line| cited(line.split_once("Source:")?.1))
}

/// Authors and year of a source; of many authors the first.
fn cited(source: &str) -> Option<String> {
    let source = source.trim();
    let year = |(k, _): &(usize, &str)| {
        let digits = source[k + 1..].chars().take_while(char::is_ascii_digit);
        digits.count() == 4
    };
    let Some((open, _)) = source.match_indices('(').find(year) else {
        // The source of a reference that this project has computed names it before its first colon.
        let what = source.split([':', ';', ',']).next()?.trim();
        return (!what.is_empty()).then(|| what.to_string());
    };
    let authors = source[..open].trim();
    let year = format!("({})", &source[open + 1..open + 5]);
    Some(match authors.chars().count() > LONGEST {
        true => format!(
            "{} et al. {year}",
            authors.split([',', '&', ';']).next()?.trim()
        ),
        false => format!("{authors} {year}"),
    })
}

/// Times of a reference that a picture shows: those to a little beyond the end of the run, or all if there are none.
fn shown(times: &[f64], end: f64) -> Vec<usize> {
    let shown = (0..times.len()).filter(|k| times[*k] <= end * (1.0 + BEYOND));
    match shown.collect::<Vec<_>>() {
        none if none.is_empty() => (0..times.len()).collect(),
        shown => shown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_names_authors_and_year() {
        let faltinsen = " Faltinsen O.M., Rognebakke O.F., Lukovsky I.A., Timokha A.N. (2000) J. Fluid Mech. (407)";
        let enet = "Enet F., Grilli S.T. (2007) Exp";
        let own = "computed for this project: potential flow (linear)";
        for (source, legend) in [
            (faltinsen, "Faltinsen O.M. et al. (2000)"),
            (enet, "Enet F., Grilli S.T. (2007)"),
            (own, "computed for this project"),
        ] {
            assert_eq!(cited(source).as_deref(), Some(legend));
        }
        assert_eq!(cited(" "), None);
    }

    #[test]
    fn a_picture_ends_with_the_run_unless_nothing_were_left() {
        assert_eq!(shown(&[0.0, 2.6, 1.0, 2.7], 2.5), [0, 1, 2]);
        assert_eq!(shown(&[3.0, 4.0], 2.5), [0, 1]);
        assert!(shown(&[], 2.5).is_empty());
    }
}

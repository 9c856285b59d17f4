//! Plots of a study, error against time and against refinement, and tables of pages.

use std::collections::BTreeMap;

use sph_core::some_unit;
use sph_io::{Plot, Series, Style, escape};

use crate::{Orders, Results, SeriesCost, SeriesResult};

/// Most series of which all are named.
const MOST: usize = 12;
/// Series that are named where there are more than that.
const BEST: usize = 6;

fn logarithmic(results: &Results, x_label: String, y_label: String, series: Vec<Series>) -> Plot {
    Plot {
        title: results.title.clone(),
        x_label,
        y_label,
        log_x: true,
        log_y: true,
        series,
    }
}

/// Error against wall seconds, one line per series, with the Pareto line, if errors are judged.
pub fn work_precision(results: &Results) -> Option<Plot> {
    results.errors.first()?;
    let time_and_error = |names: &[String]| -> Vec<[f64; 2]> {
        let point = |name: &String| {
            let variant = results.variant(name)?;
            Some([variant.wall_seconds.min?, variant.error(results.judged())?])
        };
        names.iter().filter_map(point).collect()
    };
    let of = |s: &SeriesResult| (label(results, s), time_and_error(&s.variants));
    let mut all = drawn(results, of);
    if results.pareto.len() > 1 {
        let line = time_and_error(&results.pareto);
        all.push(Series::styled("Pareto", line, Style::Highlight));
    }
    let x_label = "wall time [s]".into();
    Some(logarithmic(results, x_label, y_label(results), all))
}

/// Error against refinement with the observed orders, if there is a refinement.
pub fn convergence(results: &Results) -> Option<Plot> {
    let key = results.refinement.as_ref()?;
    results.errors.first()?;
    let of = |s: &SeriesResult| {
        let points = results.convergence(&s.variants, results.judged());
        let order = s.orders.get(results.judged()).and_then(Orders::main);
        let name = match order {
            Some(order) => format!("{}: order {order:.2}", label(results, s)),
            None => label(results, s),
        };
        (name, points.into_iter().map(|(_, p)| p).collect())
    };
    let unit = sph_scene::unit(key).filter(|u| u != "1");
    let x_label = unit.map_or_else(|| key.clone(), |u| format!("{key} [{u}]"));
    let series = drawn(results, of);
    Some(logarithmic(results, x_label, y_label(results), series))
}

/// Means of two references against each other, if the study asks for it: markers for every number of particles, and the
/// references' own values as a line of dashes.
pub fn means(results: &Results) -> Option<Plot> {
    let plot = results.means.as_ref()?;
    let mut by_size: BTreeMap<usize, [Vec<[f64; 2]>; 2]> = BTreeMap::new();
    for variant in &results.variants {
        let of = |name: &String| variant.errors.get(name)?.means;
        let (Some(x), Some(y)) = (of(&plot.x), of(&plot.y)) else {
            continue;
        };
        let [measured, exact] = by_size.entry(variant.size.particles).or_default();
        measured.push([x[0], y[0]]);
        exact.push([x[1], y[1]]);
    }
    let mut series = Vec::new();
    for (particles, [measured, exact]) in by_size {
        let name = format!("{particles} particles");
        series.push(Series::styled(name, measured, Style::Markers));
        let name = format!("reference, {particles}");
        series.push(Series::styled(name, exact, Style::Dashes));
    }
    Some(logarithmic(results, plot.x.clone(), plot.y.clone(), series))
}

/// Seconds against particles, of studies that have costs.
pub fn costs(results: &Results) -> Option<Plot> {
    let scale = results.scale.as_ref()?;
    let of = |s: &SeriesCost| {
        let name = match s.exponent {
            Some(p) => format!("{}: exponent {p:.2}", s.name),
            None => s.name.clone(),
        };
        Series::styled(name, s.points.clone(), Style::LineAndMarkers)
    };
    let y_label = format!("{} [s]", scale.cost.name());
    let series = scale.series.iter().map(of).collect();
    Some(logarithmic(results, "particles".into(), y_label, series))
}

/// Every series of which anything has run; if there are too many to be distinguished, only the most accurate on the
/// Pareto line by name, and the others in the background.
fn drawn(results: &Results, of: impl Fn(&SeriesResult) -> (String, Vec<[f64; 2]>)) -> Vec<Series> {
    let best = best(results);
    let mut named = Vec::new();
    let mut others = Vec::new();
    for series in &results.series {
        let (name, points) = of(series);
        if points.is_empty() {
            continue;
        }
        match results.series.len() <= MOST || best.contains(&series.name.as_str()) {
            true => named.push(Series::styled(name, points, Style::LineAndMarkers)),
            false => others.push(Series::styled(name, points, Style::Background)),
        }
    }
    named.extend(others);
    named
}

/// Names of the series with the most accurate variants of the Pareto line.
fn best(results: &Results) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for variant in results.pareto.iter().rev() {
        let series = results.series.iter().find(|s| s.variants.contains(variant));
        if let Some(series) = series.filter(|s| !names.contains(&s.name.as_str())) {
            names.push(&series.name);
        }
    }
    names.truncate(BEST);
    names
}

fn label(results: &Results, series: &SeriesResult) -> String {
    match series.name.as_str() {
        "" => results.scene.clone(),
        name => name.to_string(),
    }
}

fn y_label(results: &Results) -> String {
    let name = results.judged();
    let with = |v: &crate::VariantResult| v.errors.get(name).cloned();
    match results.variants.iter().find_map(with) {
        Some(e) => {
            let unit = some_unit(&e.unit).unwrap_or("1");
            format!("error of {name}, {} [{unit}]", e.norm)
        }
        None => format!("error of {name}"),
    }
}

/// A table with its heads, if there are any; every row has a class.
pub(crate) fn grid<H: AsRef<str>>(
    heads: &[H],
    rows: &[Vec<String>],
    class: impl Fn(usize) -> String,
) -> String {
    fn cells<C: AsRef<str>>(row: &[C], tag: &str) -> String {
        let cell = |c: &C| format!("<{tag}>{}</{tag}>", escape(c.as_ref()));
        row.iter().map(cell).collect()
    }
    let mut text = String::from("<div class=\"wide\"><table>\n");
    if !heads.is_empty() {
        text += &format!("<tr>{}</tr>\n", cells(heads, "th"));
    }
    for (k, row) in rows.iter().enumerate() {
        text += &match class(k).as_str() {
            "" => format!("<tr>{}</tr>\n", cells(row, "td")),
            class => format!("<tr class=\"{class}\">{}</tr>\n", cells(row, "td")),
        };
    }
    text + "</table></div>\n"
}

pub(crate) fn plain_grid(heads: &[&str], rows: &[Vec<String>]) -> String {
    grid(heads, rows, |_| String::new())
}

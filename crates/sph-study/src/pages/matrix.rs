//! The page of a study that goes along axes until they break, and its plots.

use std::fmt::Write as _;

use sph_core::number;
use sph_io::{IoError, Plot, Series, Style, escape};
use sph_run::Trouble;

use crate::pages::grid::grid;
use crate::results::Results;
use crate::results::frontier::Frontier;
use crate::results::variant_result::VariantResult;
use crate::running::record::Status;
use crate::running::verdict::Colour;

/// All between the head of the page and the study file.
///
/// # Errors
/// If a plot cannot be drawn.
pub fn body(results: &Results) -> Result<String, IoError> {
    let mut page = String::from("<h2>Frontiers</h2>\n");
    page.push_str(
        "<p>Every row is an axis, from harmless to absurd; a thick line stands behind the last value that \
         must survive. Green: within the first bounds of the axis. Yellow: beyond them, or a step had to be \
         tried again. Red: failed, lost particles through walls, took too long, or is beyond the second bounds; \
         what comes after is not run.</p>\n",
    );
    page.push_str(&frontiers(results));
    let plots = axes(results);
    for (name, plot) in &plots {
        let lines = results.frontiers.iter().filter(|f| f.axis == *name);
        let lines: Vec<&Frontier> = lines.collect();
        let _ = writeln!(
            page,
            "<h2 id=\"{0}\">{1}</h2>\n<p>{2}</p>",
            escape(name),
            escape(&lines[0].title),
            escape(&bounds(lines[0]))
        );
        page.push_str(&plot.to_svg()?);
        page.push_str(&runs(results, &lines));
    }
    Ok(page)
}

/// The bounds of an axis in words.
fn bounds(frontier: &Frontier) -> String {
    let one = |(name, [green, yellow]): (&String, &[f64; 2])| {
        format!(
            "{name}: green up to {}, yellow up to {}",
            number::plain(*green),
            number::plain(*yellow)
        )
    };
    let all: Vec<String> = frontier.judge.iter().map(one).collect();
    format!("Scene {}. {}", frontier.scene, all.join("; "))
}

fn frontiers(results: &Results) -> String {
    let mut text = String::from("<div class=\"wide\"><table class=\"frontier\">\n");
    for frontier in &results.frontiers {
        let _ = write!(
            text,
            "<tr><th>{}</th><td>{}</td>",
            escape(&frontier.axis),
            escape(&frontier.combination)
        );
        for (label, name) in frontier.values.iter().zip(&frontier.variants) {
            let verdict = results.variant(name).and_then(|v| v.verdict.clone());
            let (mut class, why) = match verdict {
                Some(v) => (v.colour.name().to_string(), v.why),
                None => ("none".to_string(), "not run".to_string()),
            };
            if frontier.must.as_ref() == Some(label) {
                class.push_str(" must");
            }
            let _ = write!(
                text,
                "<td class=\"{class}\" title=\"{}\">{}</td>",
                escape(&why),
                escape(label)
            );
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</table></div>\n");
    text
}

/// A run as a row, each cell with its head.
fn row(frontier: &Frontier, v: &VariantResult) -> [(&'static str, String); 12] {
    let none = || "–".to_string();
    let value = |name: &str| v.values.get(name).cloned().unwrap_or_default();
    let errors: Vec<String> = frontier
        .errors
        .iter()
        .filter_map(|e| Some(format!("{e} {}", number::plain(v.error(e)?))))
        .collect();
    let health = &v.health;
    let (colour, why) = match (&v.verdict, v.status) {
        (Some(found), _) => (found.colour.name().to_string(), found.why.clone()),
        (None, status) => (
            status.name().to_string(),
            v.reason.clone().unwrap_or_default(),
        ),
    };
    let seconds = v
        .wall_seconds
        .min
        .or((v.wall_seconds.spent > 0.0).then_some(v.wall_seconds.spent));
    let trouble = health.first_trouble.as_ref().map(trouble);
    let energy = health.energy_drift.map(|e| format!("{e:+.1e}"));
    let density = health.density_range;
    let density = density.map(|[low, high]| format!("{low:.3}…{high:.3}"));
    let steps = (v.steps > 0).then(|| number::count(v.steps as f64));
    let errors = (!errors.is_empty()).then(|| errors.join(", "));
    [
        ("combination", value("combination")),
        ("value", value("value")),
        ("colour", colour),
        ("why", why),
        ("first trouble", trouble.unwrap_or_else(none)),
        ("error", errors.unwrap_or_else(none)),
        ("energy", energy.unwrap_or_else(none)),
        ("density", density.unwrap_or_else(none)),
        ("Mach", health.mach.map_or_else(none, number::plain)),
        ("limited by", v.dt_limiter.clone().unwrap_or_else(none)),
        ("steps", steps.unwrap_or_else(none)),
        (
            "wall time",
            seconds.map_or_else(none, |s| format!("{s:.1} s")),
        ),
    ]
}

/// Date, program and machine.
pub fn trouble(first: &Trouble) -> String {
    let place: Vec<String> = first.position.iter().map(|x| number::plain(*x)).collect();
    let whose = match (first.particle, place.is_empty()) {
        (Some(particle), false) => format!(" of particle {particle} at ({})", place.join(", ")),
        (Some(particle), true) => format!(" of particle {particle}"),
        (None, _) => String::new(),
    };
    let value = first
        .value
        .map_or(String::new(), |x| format!(" = {}", number::plain(x)));
    format!(
        "t = {} s: {}{whose}{value}, {}",
        number::plain(first.time),
        first.quantity,
        first.reason
    )
}

fn runs(results: &Results, lines: &[&Frontier]) -> String {
    let (mut heads, mut rows, mut classes) = (Vec::new(), Vec::new(), Vec::new());
    for frontier in lines {
        for name in &frontier.variants {
            let Some(variant) = results.variant(name) else {
                continue;
            };
            let row = row(frontier, variant);
            heads = row.each_ref().map(|(head, _)| head.to_string()).to_vec();
            rows.push(row.map(|(_, cell)| cell).to_vec());
            classes.push(match (&variant.verdict, variant.status) {
                (Some(v), _) if v.colour == Colour::Red => "failed".to_string(),
                (None, Status::Pending | Status::Skipped) => "pending".to_string(),
                _ => String::new(),
            });
        }
    }
    grid(&heads, &rows, |k| classes[k].clone())
}

/// The table for a terminal: one row per axis and combination.
pub fn summary(results: &Results) -> Vec<Vec<String>> {
    let heads = [
        "axis",
        "combination",
        "green to",
        "holds to",
        "must",
        "met",
        "breaks at",
    ];
    let mut rows = vec![heads.map(String::from).to_vec()];
    let none = || "–".to_string();
    for f in &results.frontiers {
        rows.push(vec![
            f.axis.clone(),
            f.combination.clone(),
            f.green_to.clone().unwrap_or_else(none),
            f.holds_to.clone().unwrap_or_else(none),
            f.must.clone().unwrap_or_else(none),
            match f.met {
                Some(true) => "yes".into(),
                Some(false) => "NO".into(),
                None => none(),
            },
            match &f.breaks_at {
                Some([value, why]) => format!("{value}: {why}"),
                None => "nowhere".into(),
            },
        ]);
    }
    rows
}

/// The plot of every axis with its name, combinations of plugins as lines.
pub fn axes(results: &Results) -> Vec<(String, Plot)> {
    let mut plots: Vec<(String, Plot)> = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    for frontier in &results.frontiers {
        if !names.contains(&frontier.axis.as_str()) {
            names.push(&frontier.axis);
        }
    }
    for name in names {
        let lines = results.frontiers.iter().filter(|f| f.axis == name);
        let lines: Vec<&Frontier> = lines.collect();
        plots.push((name.to_string(), plot(results, &lines)));
    }
    plots
}

/// Ordinate of a run: the first error of its axis, or its largest deviation of the density.
fn ordinate(frontier: &Frontier, variant: &VariantResult) -> Option<f64> {
    match frontier.errors.first() {
        Some(error) => variant.error(error),
        None => variant.health.density_deviation(),
    }
}

fn plot(results: &Results, lines: &[&Frontier]) -> Plot {
    let first = lines[0];
    let mut series = Vec::new();
    let mut broken = Vec::new();
    let mut lowest = f64::INFINITY;
    for frontier in lines {
        let mut points = Vec::new();
        for (place, name) in frontier.places().into_iter().zip(&frontier.variants) {
            let Some(variant) = results.variant(name) else {
                continue;
            };
            let red = variant
                .verdict
                .as_ref()
                .is_some_and(|v| v.colour == Colour::Red);
            match ordinate(frontier, variant).filter(|y| y.is_finite()) {
                // A logarithmic axis cannot show an error of zero.
                Some(y) => points.push([place, y.max(1e-16)]),
                None if red => broken.push(place),
                None => {}
            }
        }
        lowest = points.iter().fold(lowest, |low, p| low.min(p[1]));
        let name = match frontier.combination.as_str() {
            "" => frontier.scene.clone(),
            name => name.to_string(),
        };
        series.push(Series::styled(name, points, Style::LineAndMarkers));
    }
    let quantity = first.errors.first().cloned();
    let judged = quantity.clone().unwrap_or("density".into());
    let places = first.places();
    let ends = [places[0], places[places.len() - 1]];
    if let Some([green, yellow]) = first.judge.get(&judged) {
        for (name, bound) in [("end of green", green), ("end of yellow", yellow)] {
            if *bound > 0.0 {
                let line = ends.iter().map(|x| [*x, *bound]).collect();
                series.push(Series::styled(name, line, Style::Dashes));
            }
        }
    }
    if !broken.is_empty() {
        let height = if lowest.is_finite() { lowest } else { 1.0 };
        let marks = broken.into_iter().map(|x| [x, height]).collect();
        series.push(Series::markers("did not come to its end", marks));
    }
    Plot {
        title: first.title.clone(),
        x_label: first.axis.replace('-', " "),
        y_label: match quantity {
            Some(error) => format!("error of {error}"),
            None => "largest deviation of the density [1]".into(),
        },
        log_x: first.is_wide(),
        log_y: true,
        series,
    }
}

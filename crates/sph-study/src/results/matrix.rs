//! The page of a study that goes along axes until they break.

use std::fmt::Write as _;

use sph_core::number;
use sph_io::{IoError, escape};
use sph_run::Trouble;

use crate::pages::matrix_plots;
use crate::pages::report::grid;
use crate::results::Results;
use crate::results::frontier::Frontier;
use crate::results::variant_result::VariantResult;
use crate::running::record::Status;

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
    let plots = matrix_plots::axes(results);
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
                (Some(v), _) if v.colour == crate::Colour::Red => "failed".to_string(),
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

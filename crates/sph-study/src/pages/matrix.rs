//! The page of a study that goes along axes until they break, and its plots.

use sph_core::{comma_list, number};
use sph_io::{IoError, Plot, Series, Style, escape};
use sph_run::Trouble;

use crate::pages::plots::grid;
use crate::{Colour, Frontier, Results, Status, VariantResult};

/// All between the head of the page and the study file.
pub fn body(results: &Results) -> Result<String, IoError> {
    let mut page = String::from("<h2>Frontiers</h2>\n");
    page.push_str(
        "<p>Every row is an axis, from harmless to absurd; a thick line stands behind the last value that \
         must survive. Green: within the first bounds of the axis. Yellow: beyond them, or a step had to be \
         tried again. Red: failed, lost particles through walls, took too long, or is beyond the second bounds; \
         what comes after is not run.</p>\n",
    );
    page.push_str(&frontiers(results));
    for (lines, plot) in axes(results) {
        let bounds = bounds(&lines[0]);
        let [axis, title, bounds] = [&lines[0].axis, &lines[0].title, &bounds].map(|t| escape(t));
        page += &format!("<h2 id=\"{axis}\">{title}</h2>\n<p>{bounds}</p>\n");
        page.push_str(&plot.to_svg()?);
        page.push_str(&runs(results, lines));
    }
    Ok(page)
}

fn bounds(frontier: &Frontier) -> String {
    let one = |(name, bounds): (&String, &[f64; 2])| {
        let [green, yellow] = bounds.map(number::plain);
        format!("{name}: green up to {green}, yellow up to {yellow}")
    };
    let all: Vec<String> = frontier.judge.iter().map(one).collect();
    format!("Scene {}. {}", frontier.scene, all.join("; "))
}

fn frontiers(results: &Results) -> String {
    let mut text = String::from("<div class=\"wide\"><table class=\"frontier\">\n");
    for frontier in &results.frontiers {
        let (axis, combination) = (escape(&frontier.axis), escape(&frontier.combination));
        text += &format!("<tr><th>{axis}</th><td>{combination}</td>");
        for (label, name) in frontier.values.iter().zip(&frontier.variants) {
            let verdict = results.variant(name).and_then(|v| v.verdict.as_ref());
            let (class, why) = verdict.map_or(("none", "not run"), |v| (v.colour.name(), &v.why));
            let must = match frontier.must.as_ref() == Some(label) {
                true => " must",
                false => "",
            };
            let (why, label) = (escape(why), escape(label));
            text += &format!("<td class=\"{class}{must}\" title=\"{why}\">{label}</td>");
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</table></div>\n");
    text
}

/// A run as a row, each cell with its head.
fn row(frontier: &Frontier, v: &VariantResult) -> [(&'static str, String); 12] {
    let value = |name: &str| v.values.get(name).cloned().unwrap_or_default();
    let error = |e: &String| Some(format!("{e} {}", number::plain(v.error(e)?)));
    let errors = comma_list(frontier.errors.iter().filter_map(error));
    let health = &v.health;
    let (colour, why) = match &v.verdict {
        Some(found) => (found.colour.name(), found.why.clone()),
        None => (v.status.name(), v.reason.clone().unwrap_or_default()),
    };
    let spent = Some(v.wall_seconds.spent).filter(|spent| *spent > 0.0);
    let seconds = v.wall_seconds.min.or(spent);
    let density = health.density_range;
    let density = density.map(|[low, high]| format!("{low:.3}…{high:.3}"));
    let steps = (v.size.steps > 0).then(|| number::count(v.size.steps as f64));
    let row = [
        ("combination", Some(value("combination"))),
        ("value", Some(value("value"))),
        ("colour", Some(colour.to_string())),
        ("why", Some(why)),
        ("first trouble", health.first_trouble.as_ref().map(trouble)),
        ("error", Some(errors).filter(|errors| !errors.is_empty())),
        ("energy", health.energy_drift.map(|e| format!("{e:+.1e}"))),
        ("density", density),
        ("Mach", health.mach.map(number::plain)),
        ("limited by", v.dt_limiter.clone()),
        ("steps", steps),
        ("wall time", seconds.map(|s| format!("{s:.1} s"))),
    ];
    row.map(|(head, cell)| (head, cell.unwrap_or("–".into())))
}

/// The first step that failed, in words.
pub fn trouble(first: &Trouble) -> String {
    let place = comma_list(first.position.iter().map(|x| number::plain(*x)));
    let whose = match (first.particle, place.as_str()) {
        (Some(particle), "") => format!(" of particle {particle}"),
        (Some(particle), place) => format!(" of particle {particle} at ({place})"),
        (None, _) => String::new(),
    };
    let value = first.value.map(number::plain);
    let value = value.map_or(String::new(), |x| format!(" = {x}"));
    let (time, quantity, reason) = (number::plain(first.time), &first.quantity, &first.reason);
    format!("t = {time} s: {quantity}{whose}{value}, {reason}")
}

fn runs(results: &Results, lines: &[Frontier]) -> String {
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
    let heads = "axis, combination, green to, holds to, must, met, breaks at";
    let rows = results.frontiers.iter().map(|f| {
        let met = f.met.map(|met| if met { "yes" } else { "NO" }.to_string());
        let marks = [f.green_to.clone(), f.holds_to.clone(), f.must.clone(), met];
        let broken = f.breaks_at.as_ref();
        let broken = broken.map(|[value, why]| format!("{value}: {why}"));
        let mut row = vec![f.axis.clone(), f.combination.clone()];
        row.extend(marks.map(|mark| mark.unwrap_or("–".into())));
        row.push(broken.unwrap_or("nowhere".into()));
        row
    });
    let heads = heads.split(", ").map(String::from).collect();
    std::iter::once(heads).chain(rows).collect()
}

/// The frontiers of every axis with their plot, combinations of plugins as lines.
pub fn axes(results: &Results) -> impl Iterator<Item = (&[Frontier], Plot)> {
    let axes = results.frontiers.chunk_by(|a, b| a.axis == b.axis);
    axes.map(|lines| (lines, plot(results, lines)))
}

fn plot(results: &Results, lines: &[Frontier]) -> Plot {
    let first = &lines[0];
    let mut series = Vec::new();
    let mut broken = Vec::new();
    let mut lowest = f64::INFINITY;
    for frontier in lines {
        let mut points = Vec::new();
        for (place, name) in frontier.places().into_iter().zip(&frontier.variants) {
            let Some(variant) = results.variant(name) else {
                continue;
            };
            let verdict = variant.verdict.as_ref();
            let red = verdict.is_some_and(|v| v.colour == Colour::Red);
            let ordinate = match frontier.errors.first() {
                Some(error) => variant.error(error),
                None => variant.health.density_deviation(),
            };
            match ordinate.filter(|y| y.is_finite()) {
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

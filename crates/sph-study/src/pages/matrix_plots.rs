//! A plot per axis: results of the runs along it.

use sph_io::{Plot, Series, Style};

use crate::results::Results;
use crate::results::frontier::Frontier;
use crate::results::variant_result::VariantResult;
use crate::running::verdict::Colour;

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

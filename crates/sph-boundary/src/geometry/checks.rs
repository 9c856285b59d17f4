//! Checks of walls: unusable and suspicious ones.

mod crossing;

use std::ops::ControlFlow;

use sph_core::BoxTree;

pub(crate) use crossing::check_crossings;

use crate::error::BoundaryError;
use crate::geometry::polyline::Polyline;
use crate::geometry::vector::{bounds, distance_to_segment, dot, sub, widened};
use crate::warning::WallWarning;

/// Edges shorter than this part of the spacing are remarked upon.
const SHORT: f64 = 0.25;

/// Part of the perimeter squared below which an area counts as zero.
const NO_AREA: f64 = 1e-12;

/// Points that are too few, not finite or repeated.
pub(crate) fn check_points(line: &Polyline) -> Result<(), BoundaryError> {
    if line.points.len() < 2 {
        let count = line.points.len();
        let why = format!("has {count} point(s), at least two are needed");
        return Err(BoundaryError::unfit(&line.name, why));
    }
    if let Some(point) = line
        .points
        .iter()
        .position(|p| p.iter().any(|x| !x.is_finite()))
    {
        return Err(BoundaryError::NotFinite {
            wall: line.name.clone(),
            point,
        });
    }
    if let Some(edge) = line.lengths().position(|length| length == 0.0) {
        let next = (edge + 1) % line.points.len();
        return Err(BoundaryError::ZeroLengthEdge {
            wall: line.name.clone(),
            edge,
            next,
            at: line.points[edge].into(),
        });
    }
    Ok(())
}

/// A closed wall that encloses nothing and is not a plate of zero thickness.
pub(crate) fn check_area(line: &Polyline, tolerance: f64) -> Result<(), BoundaryError> {
    let perimeter: f64 = line.lengths().sum();
    if line.closed
        && line.signed_area().abs() <= NO_AREA * perimeter * perimeter
        && let Some(edge) = unretraced_edge(line, tolerance)
    {
        return Err(BoundaryError::ZeroArea {
            wall: line.name.clone(),
            edge,
        });
    }
    Ok(())
}

/// Edges far shorter than the spacing.
pub(crate) fn short_edges(line: &Polyline, spacing: f64) -> impl Iterator<Item = WallWarning> {
    let lengths = line.lengths().enumerate();
    lengths
        .filter(move |(_, length)| *length < SHORT * spacing)
        .map(move |(edge, length)| WallWarning::ShortEdge {
            wall: line.name.clone(),
            edge,
            length,
            spacing,
        })
}

/// An edge whose middle is not on another edge in the opposite direction.
fn unretraced_edge(line: &Polyline, tolerance: f64) -> Option<usize> {
    let tree = BoxTree::new(line.edges().map(bounds).collect());
    line.edges().position(|[a, b]| {
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let retraces = |k: usize| {
            let [c, d] = line.edge(k);
            let opposite = dot(sub(b, a), sub(d, c)) < 0.0;
            opposite && distance_to_segment(middle, [c, d]) <= tolerance
        };
        let near = widened([middle; 2], tolerance);
        let found = tree.overlapping(near, &mut |k| match retraces(k) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        });
        found.is_continue()
    })
}

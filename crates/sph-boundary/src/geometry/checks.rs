//! Checks of walls: unusable and suspicious ones.

mod crossing;

use sph_core::BoxTree;

pub(crate) use crossing::check_crossings;

use crate::error::{BoundaryError, Place, Result};
use crate::geometry::polyline::Polyline;
use crate::geometry::vector::{bounds, distance_to_segment, dot, sub, widened};

/// Edges shorter than this part of the spacing are remarked upon.
const SHORT: f64 = 0.25;

/// Part of the perimeter squared below which an area counts as zero.
const NO_AREA: f64 = 1e-12;

pub(crate) fn check_points(line: &Polyline) -> Result<()> {
    if line.points.len() < 2 {
        let count = line.points.len();
        let why = format!("has {count} point(s), at least two are needed");
        return Err(BoundaryError::unfit(&line.name, why));
    }
    check_finite(&line.name, &line.points)?;
    if let Some(edge) = line.lengths().position(|length| length == 0.0) {
        let (next, at) = (
            (edge + 1) % line.points.len(),
            Place::from(line.points[edge]),
        );
        let why = format!("edge {edge} has zero length, points {edge} and {next} are both at {at}");
        return Err(BoundaryError::of_part(&line.name, why));
    }
    Ok(())
}

pub(crate) fn check_finite<const D: usize>(wall: &str, points: &[[f64; D]]) -> Result<()> {
    let finite = |p: &[f64; D]| p.iter().all(|x| x.is_finite());
    match points.iter().position(|p| !finite(p)) {
        None => Ok(()),
        Some(point) => {
            let why = format!("point {point} has a coordinate that is not finite");
            Err(BoundaryError::of_part(wall, why))
        }
    }
}

/// A closed wall that encloses nothing and is not a plate of zero thickness.
pub(crate) fn check_area(line: &Polyline, tolerance: f64) -> Result<()> {
    let perimeter: f64 = line.lengths().sum();
    if line.closed
        && line.signed_area().abs() <= NO_AREA * perimeter * perimeter
        && let Some(edge) = unretraced_edge(line, tolerance)
    {
        let why = format!(
            "is closed but encloses no area, and edge {edge} is not retraced in the opposite direction as it would be \
             on a plate of zero thickness"
        );
        return Err(BoundaryError::unfit(&line.name, why));
    }
    Ok(())
}

/// Remarks on edges far shorter than the spacing, each of which becomes one short segment.
pub(crate) fn short_edges(line: &Polyline, spacing: f64) -> impl Iterator<Item = String> {
    let lengths = line.lengths().enumerate();
    let short = lengths.filter(move |(_, length)| *length < SHORT * spacing);
    short.map(move |(edge, length)| {
        let wall = &line.name;
        format!(
            "edge {edge} of wall `{wall}` is {length} m long, far shorter than the spacing {spacing} m"
        )
    })
}

/// A remark on faces that end on the back of another wall: no fluid is before them.
pub(crate) fn unseen(wall: &str, faces: usize) -> String {
    format!(
        "{faces} faces of wall `{wall}` end on the back of another wall: they bound no fluid and are left out"
    )
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
        let mut found = false;
        tree.each(widened([middle; 2], tolerance), |k| found |= retraces(k));
        !found
    })
}

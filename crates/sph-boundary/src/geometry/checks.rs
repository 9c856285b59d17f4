//! Checks of walls: unusable and suspicious ones.

use std::ops::ControlFlow;

use sph_core::BoxTree;

use crate::error::{BoundaryError, Place, Result};
use crate::geometry::vector::{add, along, bounds, distance_to_segment, dot, perp, sub, widened};
use crate::{PeriodicBox, Polyline};

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

struct Edge {
    wall: usize,
    edge: usize,
    /// True if it is an image of another edge across a periodic side.
    image: bool,
    ends: [[f64; 2]; 2],
}

/// Refuses two edges, of one wall or of two, that cross properly; touching is allowed.
///
/// An end within `tolerance` metres of the other edge's line touches it. Returns how many pairs of edges were held
/// against each other: those whose boxes overlap, `most` of them.
pub(crate) fn check_crossings(
    polylines: &[Polyline],
    tolerance: f64,
    domain: &PeriodicBox,
    most: usize,
) -> Result<usize> {
    let edges = edges(polylines, domain);
    let tree = BoxTree::new(edges.iter().map(|e| bounds(e.ends)).collect());
    let mut pairs = 0;
    for (i, first) in edges.iter().enumerate().filter(|(_, e)| !e.image) {
        // The lowest of those that it crosses.
        let mut met: Option<(usize, [f64; 2])> = None;
        let whole = tree.overlapping(tree.corners(i), &mut |j| {
            if !edges[j].image && j <= i || met.is_some_and(|(k, _)| k < j) {
                return ControlFlow::Continue(());
            }
            pairs += 1;
            if let Some(place) = crossing(first.ends, edges[j].ends, tolerance) {
                met = Some((j, place));
            }
            match pairs > most {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        if let Some((j, at)) = met {
            let second = &edges[j];
            let edges = [first, second].map(|e| (&polylines[e.wall].name[..], e.edge));
            return Err(BoundaryError::crossing("edge", edges, at));
        }
        if whole.is_break() {
            return Err(BoundaryError::tangled("edges", &polylines[first.wall].name));
        }
    }
    Ok(pairs)
}

/// All edges, and their images across the periodic sides that come near the walls themselves.
fn edges(polylines: &[Polyline], domain: &PeriodicBox) -> Vec<Edge> {
    let points = polylines.iter().flat_map(|line| &line.points);
    let walls = bounds(points.copied());
    let mut edges = Vec::new();
    for (wall, line) in polylines.iter().enumerate() {
        for (edge, own) in line.edges().enumerate() {
            for image in domain.images_within(walls, bounds(own)) {
                let shift = domain.shift(image);
                edges.push(Edge {
                    wall,
                    edge,
                    image: image != [0; 2],
                    ends: own.map(|p| add(p, shift)),
                });
            }
        }
    }
    edges
}

/// Intersection of two edges, if the ends of each are on opposite sides of the other.
fn crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2], tolerance: f64) -> Option<[f64; 2]> {
    let [to_a, to_b] = [a, b].map(|p| distance_to_line(p, c, d));
    let [to_c, to_d] = [c, d].map(|p| distance_to_line(p, a, b));
    let opposite = |p: f64, q: f64| p * q < 0.0 && p.abs().min(q.abs()) > tolerance;
    if !(opposite(to_a, to_b) && opposite(to_c, to_d)) {
        return None;
    }
    let part = to_a / (to_a - to_b);
    Some(along(a, part, sub(b, a)))
}

/// Signed distance of `p` to the line from `c` to `d`, positive on its left.
fn distance_to_line(p: [f64; 2], c: [f64; 2], d: [f64; 2]) -> f64 {
    let [x, y] = sub(d, c);
    perp([x, y], sub(p, c)) / x.hypot(y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::MOST_PAIRS;

    /// A comb along x or along y with teeth of some length.
    fn comb(n: usize, along: usize, tooth: f64) -> Polyline {
        let corner = |k: usize| {
            let mut at = [(k / 2) as f64; 2];
            at[1 - along] = tooth * (k.div_ceil(2) % 2) as f64;
            at
        };
        Polyline::open("comb", (0..n).map(corner).collect())
    }

    #[test]
    fn an_edge_is_held_against_those_beside_it_only() {
        let none = PeriodicBox::none();
        for (along, tooth) in [(0, 1.0), (0, 1000.0), (1, 1000.0)] {
            let n = 20_000;
            let pairs = check_crossings(&[comb(n, along, tooth)], 1e-6, &none, MOST_PAIRS).unwrap();
            // An edge touches the boxes of the one before and of the one after.
            assert_eq!(pairs, n - 2, "{tooth} along {along}");
        }
        let mut crossed = comb(20_000, 0, 1000.0);
        crossed.points.extend([[10_001.0, 500.5], [-1.0, 500.5]]);
        let found = check_crossings(&[crossed], 1e-6, &none, MOST_PAIRS).unwrap_err();
        let first = found.0.starts_with("edge 0 of wall `comb` crosses edge");
        assert!(first, "{found}");
    }

    #[test]
    fn a_hatching_of_more_pairs_than_are_compared_is_refused() {
        let line = |k: usize| {
            let x = k as f64;
            Polyline::open("hatch", vec![[x, 0.0], [x + 1e6, 1e6]])
        };
        let lines: Vec<_> = (0..300).map(line).collect();
        let most = |most| check_crossings(&lines, 1e-6, &PeriodicBox::none(), most);
        // Every box overlaps every other.
        assert_eq!(most(300 * 299 / 2), Ok(300 * 299 / 2));
        let found = most(300 * 299 / 2 - 1).unwrap_err();
        let tangled = found.0.starts_with("from wall `hatch` on, more than");
        assert!(tangled, "{found}");
    }
}

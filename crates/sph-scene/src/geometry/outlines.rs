//! Lines of walls in the plane.

use std::ops::ControlFlow;

use sph_core::{BoxTree, bounds};

use crate::geometry::polygon::crosses_ray;
use crate::tables::wall::Face;
use crate::{FluidSide, Polygon};

/// A line of straight edges with the fluid on the left of travel.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Corners in the order of travel, m.
    pub points: Vec<[f64; 2]>,
    /// True if an edge leads from the last corner back to the first.
    pub closed: bool,
}

impl Line {
    pub(crate) fn closed(points: Vec<[f64; 2]>) -> Self {
        let closed = true;
        Line { points, closed }
    }

    /// The same line with the fluid on the other side.
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self
    }

    /// A line whose end is its beginning becomes closed; doubled corners are dropped.
    pub(crate) fn tidied(mut self, near: f64) -> Self {
        let same = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= near;
        self.points.dedup_by(|a, b| same(a, b));
        while let [first, .., last] = &self.points[..]
            && same(first, last)
        {
            self.closed = true;
            self.points.pop();
        }
        self
    }
}

/// Sides of a box without those in `open`, anticlockwise.
pub(crate) fn rectangle(lo: [f64; 2], hi: [f64; 2], open: &[Face]) -> Vec<Line> {
    let corners = [lo, [hi[0], lo[1]], hi, [lo[0], hi[1]]];
    let sides = [Face::YMinus, Face::XPlus, Face::YPlus, Face::XMinus];
    let kept = |k: usize| !open.contains(&sides[k % 4]);
    if (0..4).all(kept) {
        return vec![Line::closed(corners.to_vec())];
    }
    let begins = (0..4).filter(|&k| kept(k) && !kept(k + 3));
    let line = |begin: usize| {
        let count = (begin..begin + 4).take_while(|&k| kept(k)).count();
        let corner = |k: usize| corners[k % 4];
        let points = (begin..=begin + count).map(corner).collect();
        let closed = false;
        Line { points, closed }
    };
    begins.map(line).collect()
}

/// Most edges, of all lines together, that are passed on the way out from a corner of each.
const PASSED: usize = 200_000_000;

/// Turns closed lines so that the fluid is inside or outside of the enclosed area.
///
/// A line within another is the edge of a hole: it goes round the other way. Whether it lies within an odd
/// number of others shows in the number of edges that a ray from one of its corners to the right passes.
/// Or why they cannot be turned, and whether that is the number of edges.
pub(crate) fn oriented(lines: Vec<Line>, side: FluidSide) -> Result<Vec<Line>, (bool, String)> {
    if side == FluidSide::AsDrawn {
        return Ok(lines);
    }
    if let Some(open) = lines.iter().position(|l| !l.closed) {
        let message = format!(
            "line {open} of the drawing, counted from 0, is not closed and has no inside: close \
             it, or leave out `fluid` and draw it with the fluid on the left of travel"
        );
        return Err((false, message));
    }
    let polygons = lines.iter().map(|l| Polygon::new(l.points.clone()));
    let polygons: Vec<Polygon> = polygons.collect();
    let numbered = polygons.iter().enumerate();
    let edges = numbered.flat_map(|(k, polygon)| polygon.edges().map(move |(a, b)| (k, a, b)));
    let edges: Vec<_> = edges.collect();
    let boxes = edges.iter().map(|(_, a, b)| bounds([*a, *b])).collect();
    let tree = BoxTree::new(boxes);
    let mut passed = 0;
    let mut turned = Vec::with_capacity(lines.len());
    for (k, line) in lines.into_iter().enumerate() {
        let from = line.points[0];
        let ray = [from, [f64::INFINITY, from[1]]];
        let mut within = 0;
        let whole = tree.overlapping(ray, &mut |n| {
            let (of, a, b) = edges[n];
            within += usize::from(of != k && crosses_ray(from, a, b));
            passed += 1;
            match passed > PASSED {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        if whole.is_break() {
            let message = "its lines have too many edges beside each other to find which is within which: leave \
                           out `fluid` and draw them with the fluid on the left of travel";
            return Err((true, message.to_string()));
        }
        let anticlockwise = polygons[k].area() > 0.0;
        let wanted = (side == FluidSide::Inside) == within.is_multiple_of(2);
        let right = anticlockwise == wanted;
        turned.push(if right { line } else { line.reversed() });
    }
    Ok(turned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_sides_leave_lines_with_the_inside_on_the_left() {
        let tank = rectangle([0.0; 2], [2.0, 1.0], &[Face::YPlus]);
        let points = vec![[0.0, 1.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
        let closed = false;
        assert_eq!(tank, [Line { points, closed }]);
        let channel = rectangle([0.0; 2], [2.0, 1.0], &[Face::XPlus, Face::XMinus]);
        assert_eq!(channel.len(), 2);
        assert_eq!(channel[1].points, [[2.0, 1.0], [0.0, 1.0]]);
        assert!(rectangle([0.0; 2], [1.0; 2], &[])[0].closed);
    }

    #[test]
    fn a_hole_goes_round_the_other_way() {
        let square = |r: f64| Line::closed(vec![[-r, -r], [r, -r], [r, r], [-r, r]]);
        let lines = vec![square(1.0), square(3.0), square(2.0).reversed()];
        let area = |l: &Line| Polygon::new(l.points.clone()).area();
        let areas = |side| -> Vec<f64> {
            let oriented = oriented(lines.clone(), side).unwrap();
            oriented.iter().map(area).collect()
        };
        assert_eq!(areas(FluidSide::Inside), [4.0, 36.0, -16.0]);
        assert_eq!(areas(FluidSide::Outside), [-4.0, -36.0, 16.0]);
    }

    #[test]
    fn doubled_corners_go_and_a_line_that_returns_is_closed() {
        let points = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
        let closed = false;
        let tidy = Line { points, closed }.tidied(1e-12);
        assert!(tidy.closed && tidy.points.len() == 3);
    }
}

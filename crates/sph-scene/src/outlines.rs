//! Lines of walls in the plane.

use crate::wall_shapes::Face;
use crate::{Polygon, Side};

/// A line of straight edges with the fluid on the left of travel.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Corners in the order of travel, m.
    pub points: Vec<[f64; 2]>,
    /// Whether an edge leads from the last corner back to the first.
    pub closed: bool,
}

impl Line {
    pub(crate) fn closed(points: Vec<[f64; 2]>) -> Self {
        Line {
            points,
            closed: true,
        }
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
        Line {
            points: (begin..=begin + count).map(corner).collect(),
            closed: false,
        }
    };
    begins.map(line).collect()
}

/// Turns closed lines so that the fluid is inside or outside of what they enclose.
///
/// A line within another is the edge of a hole: it goes round the other way. Returns the number
/// of an open line, if there is one.
pub(crate) fn oriented(lines: Vec<Line>, side: Side) -> Result<Vec<Line>, usize> {
    if side == Side::AsDrawn {
        return Ok(lines);
    }
    if let Some(open) = lines.iter().position(|l| !l.closed) {
        return Err(open);
    }
    let loops: Vec<(Polygon, [[f64; 2]; 2])> = lines
        .iter()
        .map(|l| (Polygon::new(l.points.clone()), bounds(&l.points)))
        .collect();
    let around = |k: usize| {
        let x = lines[k].points[0];
        let holds = |(n, (polygon, [lo, hi])): (usize, &(Polygon, [[f64; 2]; 2]))| {
            n != k && (0..2).all(|i| lo[i] <= x[i] && x[i] <= hi[i]) && polygon.contains(x)
        };
        loops.iter().enumerate().filter(|l| holds(*l)).count()
    };
    let depths: Vec<usize> = (0..lines.len()).map(around).collect();
    let turned = lines.into_iter().enumerate().map(|(k, line)| {
        let anticlockwise = loops[k].0.area() > 0.0;
        let wanted = (side == Side::Inside) == depths[k].is_multiple_of(2);
        match anticlockwise == wanted {
            true => line,
            false => line.reversed(),
        }
    });
    Ok(turned.collect())
}

/// Lower and upper corner of the box around points.
pub(crate) fn bounds<const D: usize>(points: &[[f64; D]]) -> [[f64; D]; 2] {
    let mut found = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    for x in points {
        for k in 0..D {
            found[0][k] = found[0][k].min(x[k]);
            found[1][k] = found[1][k].max(x[k]);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_sides_leave_lines_with_the_inside_on_the_left() {
        let tank = rectangle([0.0; 2], [2.0, 1.0], &[Face::YPlus]);
        let points = vec![[0.0, 1.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
        assert_eq!(
            tank,
            [Line {
                points,
                closed: false
            }]
        );
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
        let inside = oriented(lines.clone(), Side::Inside).unwrap();
        assert_eq!(
            inside.iter().map(area).collect::<Vec<_>>(),
            [4.0, 36.0, -16.0]
        );
        let outside = oriented(lines, Side::Outside).unwrap();
        assert_eq!(
            outside.iter().map(area).collect::<Vec<_>>(),
            [-4.0, -36.0, 16.0]
        );
    }

    #[test]
    fn doubled_corners_go_and_a_line_that_returns_is_closed() {
        let line = Line {
            points: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]],
            closed: false,
        };
        let tidy = line.tidied(1e-12);
        assert!(tidy.closed && tidy.points.len() == 3);
    }
}

//! Walls of the plane that stand on each other.

use std::ops::ControlFlow;

use sph_core::BoxTree;

use crate::Polyline;
use crate::error::{BoundaryError, MOST_PAIRS, Result};
use crate::geometry::mesh::SAME_PLACE;
use crate::geometry::vector::{bounds, dot, perp, sub, widened};

/// Lines without the stretches on which two of them lie face to face, each with its number.
///
/// Where a block stands on a floor neither the floor under it nor its own base meets any fluid: the rest is the
/// boundary of the fluid, and the open ends join into one line. Lines are compared within a group (walls that move
/// together); a line is not compared with itself, as a plate of no thickness lies on itself on purpose.
///
/// # Errors
/// If too many edges are near each other.
pub(crate) fn without_shared(
    lines: &[Polyline],
    groups: &[usize],
    spacing: f64,
) -> Result<Vec<(usize, Polyline)>> {
    if lines.len() == 1 {
        return Ok(vec![(0, lines[0].clone())]);
    }
    let tolerance = SAME_PLACE * spacing;
    let of = |(k, line): (usize, &Polyline)| line.edges().map(|e| (k, e)).collect::<Vec<_>>();
    let edges: Vec<(usize, [[f64; 2]; 2])> = lines.iter().enumerate().flat_map(of).collect();
    let tree = BoxTree::new(edges.iter().map(|(_, e)| bounds(*e)).collect());
    let mut pairs = 0;
    let mut near = Vec::new();
    let mut cuts_of = |k: usize, edge: [[f64; 2]; 2]| {
        near.clear();
        let whole = tree.overlapping(widened(bounds(edge), tolerance), &mut |n| {
            let other = edges[n].0;
            pairs += 1;
            if other != k && groups[other] == groups[k] {
                near.push(n);
            }
            match pairs > MOST_PAIRS {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        if whole.is_break() {
            return Err(BoundaryError::tangled("edges", &lines[k].name));
        }
        near.sort_unstable();
        let faces = near.iter().map(|n| edges[*n].1);
        let mut cuts: Vec<_> = faces.filter_map(|f| shared(edge, f, tolerance)).collect();
        cuts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Ok(cuts)
    };
    let mut kept = Vec::new();
    for (k, line) in lines.iter().enumerate() {
        let cuts = line.edges().map(|edge| cuts_of(k, edge));
        let cuts: Vec<Vec<[f64; 2]>> = cuts.collect::<Result<_, _>>()?;
        if cuts.iter().all(Vec::is_empty) {
            kept.push((k, line.clone()));
        } else {
            kept.extend(rest(line, &cuts, tolerance).into_iter().map(|l| (k, l)));
        }
    }
    Ok(kept)
}

/// Abscissae along the first edge between which the second lies on it, facing it.
fn shared([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2], tolerance: f64) -> Option<[f64; 2]> {
    let along = sub(b, a);
    let length = along[0].hypot(along[1]);
    let t = along.map(|x| x / length);
    let frame = |p: [f64; 2]| (dot(sub(p, a), t), perp(sub(p, a), t));
    let ((from, above), (to, below)) = (frame(c), frame(d));
    if above.abs() > tolerance || below.abs() > tolerance || to >= from {
        return None;
    }
    let (low, high) = (to.max(0.0), from.min(length));
    (high - low > tolerance).then_some([low, high])
}

/// The stretches of a line outside its cuts, as open lines.
fn rest(line: &Polyline, cuts: &[Vec<[f64; 2]>], tolerance: f64) -> Vec<Polyline> {
    let mut pieces: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    for ([a, b], cuts) in line.edges().zip(cuts) {
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let at = |s: f64| [0, 1].map(|k| a[k] + (b[k] - a[k]) * (s / length));
        let mut from = 0.0;
        let mut stretch = |from: f64, to: f64, ends: bool| {
            let last = pieces.len() - 1;
            if to - from > tolerance {
                if pieces[last].is_empty() {
                    pieces[last].push(if from > 0.0 { at(from) } else { a });
                }
                pieces[last].push(if to < length { at(to) } else { b });
            }
            if ends && !pieces[last].is_empty() {
                pieces.push(Vec::new());
            }
        };
        for &[low, high] in cuts {
            stretch(from, low, true);
            from = f64::max(from, high);
        }
        stretch(from, length, false);
    }
    pieces.pop_if(|last| last.is_empty());
    // A closed line that is whole around its first corner goes on there.
    let start = pieces.first().and_then(|first| first.first()).copied();
    let several = pieces.len() > 1 && line.closed;
    if let Some(last) = pieces.pop_if(|last| several && last.last() == start.as_ref()) {
        let joined = last.into_iter().chain(pieces[0].drain(..).skip(1));
        pieces[0] = joined.collect();
    }
    let whole = pieces.into_iter().filter(|p| p.len() > 1);
    let open = |points| Polyline::open(line.name.clone(), points);
    whole.map(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tank() -> Polyline {
        Polyline::closed("tank", vec![[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])
    }

    /// The fluid is outside: clockwise.
    fn block(x: f64, y: f64) -> Polyline {
        let points = vec![[x, y], [x, y + 1.0], [x + 1.0, y + 1.0], [x + 1.0, y]];
        Polyline::closed("block", points)
    }

    #[test]
    fn a_block_on_the_floor_becomes_part_of_it() {
        let left = without_shared(&[tank(), block(1.0, 0.0)], &[0, 0], 0.1).unwrap();
        assert_eq!(left.len(), 2);
        let (tank, block) = (&left[0].1, &left[1].1);
        assert_eq!(
            tank.points,
            [
                [2.0, 0.0],
                [4.0, 0.0],
                [4.0, 3.0],
                [0.0, 3.0],
                [0.0, 0.0],
                [1.0, 0.0]
            ]
        );
        assert_eq!(
            block.points,
            [[1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]]
        );
        assert!(!tank.closed && !block.closed);
    }

    #[test]
    fn a_block_in_a_corner_loses_two_sides() {
        let left = without_shared(&[tank(), block(0.0, 0.0)], &[0, 0], 0.1).unwrap();
        let points: Vec<_> = left.iter().map(|(_, line)| line.points.clone()).collect();
        assert_eq!(
            points,
            [
                vec![[1.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0], [0.0, 1.0]],
                vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]],
            ]
        );
    }

    #[test]
    fn walls_apart_or_moving_apart_stay_whole() {
        let apart = [tank(), block(1.0, 0.5)];
        assert_eq!(without_shared(&apart, &[0, 0], 0.1).unwrap()[1].1, apart[1]);
        let sliding = [tank(), block(1.0, 0.0)];
        assert_eq!(
            without_shared(&sliding, &[0, 1], 0.1).unwrap()[0].1,
            sliding[0]
        );
    }
}

//! Lines that lie on each other, and corners of the plane and edges of space where more than two lines or faces meet.

use std::collections::{BTreeMap, HashSet};
use std::ops::ControlFlow;

use sph_core::{BoxTree, Sets};

use crate::Polyline;
use crate::error::{BoundaryError, MOST_PAIRS, Result};
use crate::geometry::checks::unseen;
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

type Piece = (usize, Polyline);

struct End {
    place: [f64; 2],
    group: usize,
    line: AdjacentFace,
}

/// Cuts lines at corners where another one of their group ends, and leaves out the pieces that then bound no fluid:
/// where an open face closes a channel whose walls have a thickness, their ends and outsides. Nothing is changed where
/// nothing is left out.
pub(crate) fn bounding(
    pieces: Vec<Piece>,
    groups: &[usize],
    tolerance: f64,
) -> (Vec<Piece>, Vec<String>) {
    let given = Ends::new(&pieces, groups, tolerance);
    let cut = |&(wall, ref line): &Piece| {
        let parts = cut(line, |place| !given.at(place, groups[wall]).is_empty());
        parts.into_iter().map(move |line| (wall, line))
    };
    let all: Vec<Piece> = pieces.iter().flat_map(cut).collect();
    let ends = Ends::new(&all, groups, tolerance);
    let mut parts = Sets::new(all.len());
    let mut severed: Vec<(usize, Vec<usize>)> = Vec::new();
    for (n, end) in ends.all.iter().enumerate() {
        let meet = ends.at(end.place, end.group);
        if meet.first() != Some(&n) || meet.len() < 2 {
            continue;
        }
        let around = meet.iter().map(|m| ends.all[*m].line);
        let pairs = wedges(around.clone().collect());
        pairs.iter().for_each(|pair| parts.join(*pair));
        let joined: Vec<usize> = pairs.into_iter().flatten().collect();
        if meet.len() > 2 {
            let alone = around.map(|line| line.piece);
            let alone = alone.filter(|piece| !joined.contains(piece));
            severed.extend(alone.map(|piece| (piece, joined.clone())));
        }
    }
    if severed.is_empty() {
        return (pieces, Vec::new());
    }
    let bounds = bound_fluid(parts, all.len(), &severed);
    let mut remarks = Vec::new();
    for (wall, name) in pieces.iter().map(|(wall, line)| (*wall, &line.name)) {
        let left_out = all.iter().zip(&bounds);
        let left_out = left_out.filter(|((own, _), bounds)| *own == wall && !**bounds);
        let faces = left_out.map(|((_, line), _)| line.edge_count()).sum();
        let remark = unseen(name, faces);
        if faces > 0 && !remarks.contains(&remark) {
            remarks.push(remark);
        }
    }
    if remarks.is_empty() {
        return (pieces, remarks);
    }
    let kept = all.into_iter().zip(bounds).filter(|(_, bounds)| *bounds);
    (kept.map(|(piece, _)| piece).collect(), remarks)
}

/// The pieces of a line between corners at which it is to be cut.
fn cut(line: &Polyline, ends_at: impl Fn([f64; 2]) -> bool) -> Vec<Polyline> {
    let count = line.points.len();
    let inner = match line.closed {
        true => 0..count,
        false => 1..count.saturating_sub(1),
    };
    let cuts: Vec<usize> = inner.filter(|k| ends_at(line.points[*k])).collect();
    let Some(first) = cuts.first() else {
        return vec![line.clone()];
    };
    // From corner to corner, of a closed line around.
    let bounds = match line.closed {
        true => [&cuts[..], &[first + count][..]].concat(),
        false => [&[0][..], &cuts[..], &[count - 1][..]].concat(),
    };
    let piece = |pair: &[usize]| {
        let points = (pair[0]..=pair[1]).map(|k| line.points[k % count]);
        Polyline::open(line.name.clone(), points.collect())
    };
    bounds.windows(2).map(piece).collect()
}

struct Ends {
    all: Vec<End>,
    tree: BoxTree<2>,
    tolerance: f64,
}

impl Ends {
    fn new(pieces: &[Piece], groups: &[usize], tolerance: f64) -> Self {
        let mut all = Vec::new();
        for (piece, (wall, line)) in pieces.iter().enumerate().filter(|(_, (_, l))| !l.closed) {
            let edges = [0, line.edge_count().saturating_sub(1)].map(|e| line.edge(e));
            for (with, [place, to]) in [(true, edges[0]), (false, [edges[1][1], edges[1][0]])] {
                let angle = (to[1] - place[1]).atan2(to[0] - place[0]);
                all.push(End {
                    place,
                    group: groups[*wall],
                    line: AdjacentFace { piece, with, angle },
                });
            }
        }
        let tree = BoxTree::new(all.iter().map(|end: &End| [end.place; 2]).collect());
        Ends {
            all,
            tree,
            tolerance,
        }
    }

    fn at(&self, place: [f64; 2], group: usize) -> Vec<usize> {
        let mut found = Vec::new();
        let around = widened([place; 2], self.tolerance);
        self.tree.each(around, |end| found.push(end));
        found.retain(|end| self.all[*end].group == group);
        found.sort_unstable();
        found
    }
}

/// A face at an edge, or a line at a corner.
#[derive(Clone, Copy)]
pub(crate) struct AdjacentFace {
    pub piece: usize,
    /// True if the fluid is on the side of rising angles: of lines, at the first end.
    pub with: bool,
    /// About the edge or corner, of a line from its end on, rad.
    pub angle: f64,
}

/// Neighbours about an edge or a corner with the fluid between them.
pub(crate) fn wedges(mut around: Vec<AdjacentFace>) -> Vec<[usize; 2]> {
    // Of two back to back, the one with the fluid before it comes first.
    around.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.with.cmp(&b.with)));
    let next = around.iter().cycle().skip(1);
    let pairs = around.iter().zip(next);
    let pairs = pairs.filter(|(a, b)| a.with && !b.with);
    pairs.map(|(a, b)| [a.piece, b.piece]).collect()
}

/// By piece, whether it bounds the fluid; `parts` are those that hang together.
///
/// `severed` are pieces that nothing continues at some place, each with those that do go on there. What hangs together
/// with one of them ends on the back of another wall, so that no fluid can be before it, if those others end nowhere.
pub(crate) fn bound_fluid(mut parts: Sets, n: usize, severed: &[(usize, Vec<usize>)]) -> Vec<bool> {
    let ends = severed.iter().map(|(piece, _)| parts.root(*piece));
    let ends: HashSet<usize> = ends.collect();
    let mut outside: BTreeMap<usize, bool> = ends.iter().map(|part| (*part, true)).collect();
    for (piece, others) in severed {
        let whole = others.iter().all(|o| !ends.contains(&parts.root(*o)));
        *outside.entry(parts.root(*piece)).or_default() &= whole && !others.is_empty();
    }
    let mut bounds = |piece| !outside.get(&parts.root(piece)).copied().unwrap_or(false);
    (0..n).map(&mut bounds).collect()
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

    #[test]
    fn plates_that_an_open_face_joins_keep_the_sides_within() {
        // Clockwise: the fluid is outside. The inlet travels down, the outlet up.
        let plate = |y: [f64; 2]| vec![[0.0, y[0]], [0.0, y[1]], [4.0, y[1]], [4.0, y[0]]];
        let pieces = vec![
            (0, Polyline::closed("floor", plate([-1.0, 0.0]))),
            (1, Polyline::closed("roof", plate([2.0, 3.0]))),
            (2, Polyline::open("inlet", vec![[0.0, 2.0], [0.0, 0.0]])),
            (3, Polyline::open("outlet", vec![[4.0, 0.0], [4.0, 2.0]])),
        ];
        let (kept, remarks) = bounding(pieces.clone(), &[0; 4], 1e-6);
        let points = kept.into_iter().map(|(wall, line)| (wall, line.points));
        let points: Vec<_> = points.collect();
        let within = [
            (0, vec![[0.0, 0.0], [4.0, 0.0]]),
            (1, vec![[4.0, 2.0], [0.0, 2.0]]),
            (2, pieces[2].1.points.clone()),
            (3, pieces[3].1.points.clone()),
        ];
        assert_eq!(points, within);
        assert_eq!(remarks.len(), 2);
        // Of walls that move apart nothing is cut, and without the faces nothing either.
        assert_eq!(bounding(pieces.clone(), &[0, 1, 2, 3], 1e-6).0, pieces);
        assert_eq!(bounding(pieces[..2].to_vec(), &[0; 2], 1e-6).0, pieces[..2]);
    }
}

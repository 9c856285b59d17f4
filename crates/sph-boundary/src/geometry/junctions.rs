//! Corners of the plane and edges of space where more than two lines or faces meet.

use std::collections::{BTreeMap, HashSet};

use sph_core::{BoxTree, Sets};

use crate::geometry::checks::unseen;
use crate::geometry::polyline::Polyline;
use crate::geometry::vector::widened;

type Piece = (usize, Polyline);

struct End {
    piece: usize,
    place: [f64; 2],
    /// True if the line begins there: the fluid is then on the side of rising angles.
    begins: bool,
    /// Of the line, from the end on, rad.
    angle: f64,
    group: usize,
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
        let around = meet.iter().map(|m| {
            let end = &ends.all[*m];
            AdjacentFace {
                piece: end.piece,
                with: end.begins,
                angle: end.angle,
            }
        });
        let pairs = wedges(around.collect());
        pairs.iter().for_each(|pair| parts.join(*pair));
        let joined: Vec<usize> = pairs.into_iter().flatten().collect();
        if meet.len() > 2 {
            let alone = meet.iter().map(|m| ends.all[*m].piece);
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
            for (begins, [place, to]) in [(true, edges[0]), (false, [edges[1][1], edges[1][0]])] {
                let angle = (to[1] - place[1]).atan2(to[0] - place[0]);
                all.push(End {
                    piece,
                    place,
                    begins,
                    angle,
                    group: groups[*wall],
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
pub(crate) struct AdjacentFace {
    pub piece: usize,
    /// True if the fluid is on the side of rising angles.
    pub with: bool,
    /// About the edge or corner, rad.
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

//! An order of elimination from places: nested dissection by bisection of coordinates.

use std::collections::VecDeque;

use nalgebra::Vector3;

use crate::{Groups, UpperTriangle};

/// Parts that are not cut further.
const SMALL: usize = 8;

/// Unknowns in the order of their elimination: both halves of a cut across the longest axis, each ordered so, then the
/// fewest unknowns that touch all that join the halves. Parts of eight and the fewest unknowns fill a sixth less than parts
/// of 48 and the unknowns of one half (5,000 spheres); minimum degree fills a third to a half more than the latter.
/// Source: George 1973; cuts by coordinates instead of a grid's lines.
pub fn nested_dissection(matrix: &UpperTriangle, places: &[Vector3<f64>]) -> Vec<u32> {
    let mut cutter = Cutter {
        neighbours: neighbours(matrix),
        places,
        side: vec![0; places.len()],
        number: vec![0; places.len()],
        mark: 0,
        order: Vec::with_capacity(places.len()),
    };
    cutter.cut((0..places.len() as u32).collect());
    cutter.order
}

struct Cutter<'a> {
    neighbours: Groups,
    places: &'a [Vector3<f64>],
    /// Number of the half in which an unknown was last.
    side: Vec<u32>,
    /// Number of an unknown among those of the upper half at the cut.
    number: Vec<u32>,
    mark: u32,
    order: Vec<u32>,
}

impl Cutter<'_> {
    fn cut(&mut self, mut part: Vec<u32>) {
        if part.len() <= SMALL {
            self.order.extend(part);
            return;
        }
        let at = |u: &u32| self.places[*u as usize];
        let first = at(&part[0]);
        let around = |(low, high): (Vector3<_>, Vector3<_>), x| (low.inf(&x), high.sup(&x));
        let (low, high) = part.iter().map(at).fold((first, first), around);
        let axis = (high - low).imax();
        let middle = part.len() / 2;
        part.select_nth_unstable_by(middle, |a, b| {
            at(a)[axis].total_cmp(&at(b)[axis]).then(a.cmp(b))
        });
        let upper = part.split_off(middle);
        self.mark += 1;
        let mark = self.mark;
        upper.iter().for_each(|u| self.side[*u as usize] = mark);
        part.iter().for_each(|u| self.side[*u as usize] = mark + 1);
        self.mark += 1;
        let between = self.separator(&part, mark);
        between.iter().for_each(|u| self.side[*u as usize] = 0);
        let inside = |u: &u32| self.side[*u as usize] != 0;
        let [lower, upper] = [part, upper].map(|half| half.into_iter().filter(inside).collect());
        self.cut(lower);
        self.cut(upper);
        self.order.extend(between);
    }

    /// The fewest unknowns without which nothing joins the lower half to the upper one of a mark, ascending.
    fn separator(&mut self, lower: &[u32], mark: u32) -> Vec<u32> {
        let (mut left, mut right, mut joins) = (Vec::new(), Vec::new(), Groups::default());
        for &u in lower {
            let over = self.neighbours.members(u as usize).iter();
            let before = joins.members.len();
            for &v in over.filter(|v| self.side[**v as usize] == mark) {
                let number = &mut self.number[v as usize];
                if right.get(*number as usize) != Some(&v) {
                    *number = right.len() as u32;
                    right.push(v);
                }
                joins.members.push(*number);
            }
            if joins.members.len() > before {
                left.push(u);
                joins.starts.push(before as u32);
            }
        }
        joins.starts.push(joins.members.len() as u32);
        let [of_left, of_right] = cover(&joins, right.len());
        let kept = |ends: &[u32], kept: &[bool]| {
            let all = ends.iter().zip(kept).filter(|(_, kept)| **kept);
            all.map(|(u, _)| *u).collect::<Vec<_>>()
        };
        let mut cover = kept(&left, &of_left);
        cover.extend(kept(&right, &of_right));
        cover.sort_unstable();
        cover
    }
}

/// Neighbours of every unknown.
fn neighbours(matrix: &UpperTriangle) -> Groups {
    let n = matrix.len();
    let pairs = (0..n as u32).flat_map(|c| {
        let range = matrix.starts[c as usize] as usize..matrix.diagonal(c as usize);
        let rows = matrix.rows[range].iter();
        rows.flat_map(move |r| [(*r, c), (c, *r)])
    });
    Groups::new(n, pairs)
}

/// No end.
const NONE: u32 = u32::MAX;

/// Marks of the ends on the left, and on the right of which there are `right`, that are in a smallest cover of the
/// joins of each end on the left with ends on the right. Source: König 1931, from a largest matching by augmenting
/// paths.
fn cover(joins: &Groups, right: usize) -> [Vec<bool>; 2] {
    let left = joins.starts.len() - 1;
    let mut mates = [vec![NONE; left], vec![NONE; right]];
    // The end on the left from which one on the right was reached, in the search of a number.
    let mut reached = vec![(NONE, NONE); right];
    let mut queue = VecDeque::new();
    for begin in 0..left as u32 {
        queue.clear();
        queue.push_back(begin);
        'search: while let Some(u) = queue.pop_front() {
            for &v in joins.members(u as usize) {
                if reached[v as usize].0 == begin {
                    continue;
                }
                reached[v as usize] = (begin, u);
                match mates[1][v as usize] {
                    NONE => {
                        augment(&mut mates, &reached, v);
                        break 'search;
                    }
                    mate => queue.push_back(mate),
                }
            }
        }
    }
    // Ends that alternating paths reach from unmatched ends on the left.
    let mut seen = [vec![false; left], vec![false; right]];
    let unmatched = (0..left as u32).filter(|u| mates[0][*u as usize] == NONE);
    let mut stack: Vec<u32> = unmatched.collect();
    while let Some(u) = stack.pop() {
        if std::mem::replace(&mut seen[0][u as usize], true) {
            continue;
        }
        for &v in joins.members(u as usize) {
            if !std::mem::replace(&mut seen[1][v as usize], true) {
                stack.push(mates[1][v as usize]);
            }
        }
    }
    let [of_left, of_right] = seen;
    [of_left.into_iter().map(|seen| !seen).collect(), of_right]
}

/// Matches along the path that reached an unmatched end on the right.
fn augment(mates: &mut [Vec<u32>; 2], reached: &[(u32, u32)], mut v: u32) {
    loop {
        let (begin, u) = reached[v as usize];
        mates[1][v as usize] = u;
        let before = std::mem::replace(&mut mates[0][u as usize], v);
        if u == begin {
            return;
        }
        v = before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joins(rows: &[&[u32]]) -> Groups {
        let mut joins = Groups::default();
        for row in rows {
            joins.starts.push(joins.members.len() as u32);
            joins.members.extend(*row);
        }
        joins.starts.push(joins.members.len() as u32);
        joins
    }

    /// Every join is touched, by as few ends as a search over all sets finds.
    #[test]
    fn covers_are_smallest() {
        let mut number = 7_u64;
        for _ in 0..300 {
            let mut draw = || {
                number = number
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                (number >> 33) as u32
            };
            let rows: Vec<Vec<u32>> = (0..5)
                .map(|_| (0..5).filter(|_| draw() % 3 == 0).collect())
                .collect();
            let rows: Vec<&[u32]> = rows.iter().map(Vec::as_slice).collect();
            let [left, right] = cover(&joins(&rows), 5);
            let touched = |left: &dyn Fn(usize) -> bool, right: &dyn Fn(usize) -> bool| {
                let mut all = rows.iter().enumerate();
                all.all(|(u, row)| row.iter().all(|v| left(u) || right(*v as usize)))
            };
            assert!(
                touched(&|u| left[u], &|v| right[v]),
                "{rows:?}: {left:?} {right:?}"
            );
            let size = left.iter().chain(&right).filter(|kept| **kept).count();
            let fits = |set: &u32| touched(&|u| set >> u & 1 == 1, &|v| set >> (5 + v) & 1 == 1);
            let least = (0_u32..1024).filter(fits).map(u32::count_ones).min();
            assert_eq!(Some(size as u32), least, "{rows:?}");
        }
    }
}

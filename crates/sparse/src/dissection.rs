//! An order of elimination from places: nested dissection by bisection of coordinates.

use nalgebra::Vector3;

use crate::vertex_cover::cover;
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

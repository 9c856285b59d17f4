//! Planar pieces of walls.

use std::collections::HashMap;

use super::drawn::{Drawn, Neighbours};
use super::places::{Places, Site};
use crate::geometry::vector::{Point, distance_to_segment, dot, sub};

/// Neighbours whose normals differ by more are never one plane, at any size.
const SAME_DIRECTION: f64 = 0.99;

#[derive(Clone, Debug)]
pub(super) struct Patch {
    pub wall: usize,
    pub group: usize,
    /// Unit normal, into the fluid.
    pub normal: Point,
    /// A point of its plane, m.
    pub origin: Point,
    /// Edges around it, the piece on their left; holes too.
    pub boundary: Vec<[Site; 2]>,
}

impl Patch {
    pub fn loops(&self) -> Vec<Vec<Site>> {
        let mut after: HashMap<Site, Vec<usize>> = HashMap::new();
        for (e, edge) in self.boundary.iter().enumerate() {
            after.entry(edge[0]).or_default().push(e);
        }
        let mut used = vec![false; self.boundary.len()];
        let mut loops = Vec::new();
        for first in 0..self.boundary.len() {
            let mut corners = Vec::new();
            let mut next = (!used[first]).then_some(first);
            while let Some(e) = next {
                used[e] = true;
                corners.push(self.boundary[e][0]);
                let edges = after.get(&self.boundary[e][1]);
                next = edges.and_then(|edges| edges.iter().copied().find(|e| !used[*e]));
            }
            if !corners.is_empty() {
                loops.push(corners);
            }
        }
        loops
    }

    /// Leaves out corners on the straight line between their neighbours, within the tolerance.
    pub fn straighten(&mut self, places: &Places, tolerance: f64) {
        let mut ends: HashMap<Site, u32> = HashMap::new();
        for edge in &self.boundary {
            for corner in edge {
                *ends.entry(*corner).or_default() += 1;
            }
        }
        let mut boundary = Vec::with_capacity(self.boundary.len());
        for corners in self.loops() {
            let at: Vec<Point> = corners.iter().map(|c| places.at(*c)).collect();
            let keep = |k: usize| ends[&corners[k]] != 2;
            let kept = straightened(&at, keep, tolerance);
            for (n, k) in kept.iter().enumerate() {
                let next = kept[(n + 1) % kept.len()];
                boundary.push([corners[*k], corners[next]]);
            }
        }
        self.boundary = boundary;
    }
}

/// Indices of the points of a loop that are needed to draw it; never fewer than three.
fn straightened(at: &[Point], keep: impl Fn(usize) -> bool, tolerance: f64) -> Vec<usize> {
    let n = at.len();
    if n <= 3 {
        return (0..n).collect();
    }
    let off = |k: usize| distance_to_segment(at[k], [at[(k + n - 1) % n], at[(k + 1) % n]]);
    // Start where the loop surely turns: at a point that stands out as far as any.
    let most = (0..n).map(off).fold(0.0, f64::max);
    let first = (0..n).find(|k| off(*k) >= 0.99 * most).unwrap_or(0);
    let point = |k: usize| at[(first + k) % n];
    let mut kept = vec![0];
    let mut from = 0;
    for k in 1..n {
        // Without point k, the line runs from the last kept point to point k + 1.
        let line = [point(from), point(k + 1)];
        let straight = (from + 1..=k)
            .all(|m| distance_to_segment(point(m), line) <= tolerance && !keep((first + m) % n));
        if !straight {
            kept.push(k);
            from = k;
        }
    }
    if kept.len() < 3 {
        return (0..n).collect();
    }
    kept.into_iter().map(|k| (first + k) % n).collect()
}

/// Cuts a wall into planar pieces of triangles that share edges; also the piece of each triangle.
///
/// Pieces grow from the largest triangles: what joins has its corners within `tolerance` of the
/// first one's plane. They end at the seam of a periodic side.
pub(super) fn patches(
    drawn: &[Drawn],
    neighbours: &Neighbours,
    tolerance: f64,
) -> (Vec<Patch>, Vec<u32>) {
    let mut by_area: Vec<u32> = (0..drawn.len() as u32).collect();
    let area = |t: u32| drawn[t as usize].area;
    by_area.sort_by(|a, b| area(*b).total_cmp(&area(*a)).then(a.cmp(b)));
    let mut seed_of = vec![u32::MAX; drawn.len()];
    for seed in by_area {
        if seed_of[seed as usize] != u32::MAX {
            continue;
        }
        let Drawn { places, normal, .. } = &drawn[seed as usize];
        seed_of[seed as usize] = seed;
        let mut front = vec![seed];
        while let Some(t) = front.pop() {
            for next in neighbours[t as usize].iter().flatten() {
                let d = &drawn[*next as usize];
                let off = |p: &Point| dot(sub(*p, places[0]), *normal).abs() <= tolerance;
                if seed_of[*next as usize] == u32::MAX
                    && dot(d.normal, *normal) > SAME_DIRECTION
                    && d.places.iter().all(off)
                {
                    seed_of[*next as usize] = seed;
                    front.push(*next);
                }
            }
        }
    }
    // Numbered in the order in which the triangles come.
    let mut numbers = vec![u32::MAX; drawn.len()];
    let mut patches: Vec<Patch> = Vec::new();
    let mut patch_of = Vec::with_capacity(drawn.len());
    for (t, d) in drawn.iter().enumerate() {
        let seed = seed_of[t] as usize;
        if numbers[seed] == u32::MAX {
            numbers[seed] = patches.len() as u32;
            patches.push(Patch {
                wall: d.wall,
                group: d.group,
                normal: drawn[seed].normal,
                origin: drawn[seed].places[0],
                boundary: Vec::new(),
            });
        }
        patch_of.push(numbers[seed]);
        let boundary = &mut patches[numbers[seed] as usize].boundary;
        for (edge, beyond) in neighbours[t].iter().enumerate() {
            let within = beyond.is_some_and(|n| seed_of[n as usize] == seed as u32);
            if !within {
                boundary.push([d.corners[edge], d.corners[(edge + 1) % 3]]);
            }
        }
    }
    (patches, patch_of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_a_side_are_left_out() {
        let side = |t: f64| {
            [
                [t, 0.0, 0.0],
                [4.0, t, 0.0],
                [4.0 - t, 4.0, 0.0],
                [0.0, 4.0 - t, 0.0],
            ]
        };
        let mut square = Vec::new();
        for k in 0..4 {
            square.extend([0.5, 1.0, 2.0, 3.0, 4.0].map(|t| side(t)[k]));
        }
        let kept = straightened(&square, |_| false, 1e-9);
        let mut kept: Vec<_> = kept.iter().map(|k| square[*k]).collect();
        kept.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let corners = [
            [0.0, 0.0, 0.0],
            [0.0, 4.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 4.0, 0.0],
        ];
        assert_eq!(kept, corners);
        assert_eq!(straightened(&square, |k| k == 1, 1e-9).len(), 5);
    }
}

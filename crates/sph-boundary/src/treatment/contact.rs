//! Pieces of walls near each other, and their distances.

use std::collections::BTreeMap;

use sph_core::Vect;

use crate::geometry::vector::{bounds, widened};
use crate::treatment::outline::Outline;
use crate::{Element, Node, Touch, WallMesh, WallSpec};

/// Distance at which surfaces begin to push, over the spacing: a row of particles fits between them. Particles that are
/// caught between surfaces half a spacing apart are few for their room, and tension draws them to a clump.
const GAP: f64 = 1.0;
/// The same of walls that are drawn as near, or nearer.
const LEAST_GAP: f64 = 0.5;
/// Greatest depth behind a surface from which a place is pushed out of it, over the spacing.
pub(crate) const DEPTH: f64 = 1.0;
/// Range of the search for surfaces, over the spacing: those that meet within a step, in which no wall goes farther
/// than half a spacing.
const REACH: f64 = GAP + 1.0;

/// A piece of a surface near another one.
pub(crate) struct SurfacePair<const D: usize> {
    /// The groups of walls that are pushed along `away`, and against it.
    pub pair: [usize; 2],
    /// The walls themselves.
    pub walls: [usize; 2],
    pub place: Vect<D>,
    /// Whole periods from the second wall to its image that the first one sees, m.
    pub image: Vect<D>,
    pub away: Vect<D>,
    /// Distance of the surfaces, m; negative where one is behind the other.
    pub height: f64,
    /// True if the first wall is beside a corner or an edge, so that the direction changes as it goes on.
    pub round: bool,
    /// Area that the place stands for, m^(D−1).
    pub area: f64,
}

impl<const D: usize> SurfacePair<D> {
    /// The first wall goes a way, m, against the second: along the plane of an element or past a corner.
    pub fn go(&mut self, way: &Vect<D>) {
        if !self.round {
            self.height += way.dot(&self.away);
            return;
        }
        let apart = self.away * self.height + way;
        self.height = apart.norm();
        if self.height > 0.0 {
            self.away = apart / self.height;
        }
    }
}

pub(crate) fn ordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl<const D: usize, M: WallMesh<D>> Outline<D, M> {
    /// Distances at which walls begin to push that are drawn nearer to each other than a spacing, m.
    pub fn drawn_gaps(&self) -> BTreeMap<[usize; 2], f64> {
        let mut gaps = BTreeMap::<[usize; 2], f64>::new();
        let near = self.near_pairs(&self.touches());
        for near in near.iter().filter(|n| n.height < GAP * self.spacing) {
            let gap = gaps.entry(ordered(near.pair)).or_insert(near.height);
            *gap = gap.min(near.height).max(LEAST_GAP * self.spacing);
        }
        gaps
    }

    /// Distance at which a pair of walls begins to push, m.
    pub(crate) fn gap(&self, pair: [usize; 2]) -> f64 {
        let drawn = self.gaps.get(&ordered(pair));
        drawn.copied().unwrap_or(GAP * self.spacing)
    }

    pub(crate) fn touches(&self) -> Vec<Option<Touch>> {
        let touch = |spec: &WallSpec<D>| spec.mover.as_ref().and_then(|m| m.touch());
        self.specs.iter().map(touch).collect()
    }

    /// All pieces of surfaces of which one moves freely and that may meet within a step.
    pub(crate) fn near_pairs(&self, touches: &[Option<Touch>]) -> Vec<SurfacePair<D>> {
        let nodes = self.mesh.nodes();
        let reach = REACH * self.spacing;
        let mut all = Vec::new();
        let free = (0..touches.len()).filter(|k| touches[*k].is_some() && self.groups[*k] == *k);
        for body in free {
            let own = nodes.iter().filter(|n| self.groups[n.wall] == body);
            let extent = widened(bounds(own.map(|n| n.position)), reach);
            let [low, high] = extent.map(Vect::<D>::from);
            let (centre, half) = ((low + high) * 0.5, (high - low) * 0.5);
            // True if a ball may reach into the box around the body.
            let meets = |x: &Vect<D>, radius: f64| {
                let apart = self.domain.nearest(x - centre);
                (0..D).all(|k| apart[k].abs() <= half[k] + radius)
            };
            let seen = |e: &&Element<D>| {
                let centre = Vect::from(e.centre);
                let arm = |n: usize| (Vect::from(nodes[n].position) - centre).norm();
                let size = e.nodes.map(arm);
                meets(&centre, size.into_iter().fold(0.0, f64::max))
            };
            let elements = self.mesh.elements().iter().filter(seen);
            let (own, others): (Vec<_>, Vec<_>) =
                elements.partition(|e| self.groups[e.wall] == body);
            if others.is_empty() {
                continue;
            }
            for node in nodes {
                let group = self.groups[node.wall];
                if group == body {
                    self.look(node, &others, &mut all);
                } else if touches[group].is_none() && meets(&node.position.into(), 0.0) {
                    self.look(node, &own, &mut all);
                }
            }
        }
        all
    }

    /// The nearest element of every other group of walls, if it is near enough.
    fn look(&self, node: &Node<D>, elements: &[&Element<D>], found: &mut Vec<SurfacePair<D>>) {
        let mut nearest = BTreeMap::<usize, (f64, Vect<D>, &Element<D>)>::new();
        let (nodes, here) = (self.mesh.nodes(), Vect::from(node.position));
        let to = |n: usize| Vect::from(nodes[n].position) - here;
        let over = |element: &Element<D>, way: &Vect<D>| Vect::from(element.normal).dot(way);
        for element in elements {
            let first = self.domain.nearest(to(element.nodes[0]));
            let corner = |n: usize| first + self.domain.nearest(to(n) - first);
            let corners = element.nodes.map(corner);
            let there = nearest_place(&corners);
            let distance = there.norm();
            let entry = nearest.entry(self.groups[element.wall]);
            let entry = entry.or_insert((f64::INFINITY, there, element));
            // At a corner the element that faces the place most gives its side.
            let faces = over(element, &there).abs() > over(entry.2, &entry.1).abs();
            let same = (distance - entry.0).abs() <= 1e-9 * self.spacing;
            if (same && faces) || (!same && distance < entry.0) {
                *entry = (distance, there, element);
            }
        }
        let (reach, depth) = (REACH * self.spacing, DEPTH * self.spacing);
        for (group, (distance, there, element)) in nearest {
            let outside = over(element, &there) <= 0.0;
            let height = if outside { distance } else { -distance };
            if height >= reach || height <= -depth {
                continue;
            }
            let away = match outside && distance > 1e-6 * self.spacing {
                true => there / -distance,
                false => element.normal.into(),
            };
            found.push(SurfacePair {
                pair: [self.groups[node.wall], group],
                walls: [node.wall, element.wall],
                place: here + there * 0.5,
                image: self.domain.nearest(to(element.nodes[0])) - to(element.nodes[0]),
                away,
                height,
                round: outside && over(element, &away) < 1.0 - 1e-9,
                area: node.size * self.spacing.powi(D as i32 - 1),
            });
        }
    }
}

/// The place of a segment or triangle that is nearest to the origin.
fn nearest_place<const D: usize>(corners: &[Vect<D>; D]) -> Vect<D> {
    let along = |a: &Vect<D>, b: &Vect<D>| {
        let edge = b - a;
        let s = (-a.dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
        a + edge * s
    };
    let edges = (0..corners.len()).map(|k| along(&corners[k], &corners[(k + 1) % corners.len()]));
    let nearer = |a: Vect<D>, b: Vect<D>| match a.norm_squared() <= b.norm_squared() {
        true => a,
        false => b,
    };
    let on_edge = edges.reduce(nearer).unwrap_or(corners[0]);
    let &[a, b, c] = &corners[..] else {
        return on_edge;
    };
    // Barycentric coordinates of the foot of the perpendicular.
    let (u, v, w) = (b - a, c - a, -a);
    let (uu, uv, vv) = (u.norm_squared(), u.dot(&v), v.norm_squared());
    let (wu, wv) = (w.dot(&u), w.dot(&v));
    let whole = uu * vv - uv * uv;
    let [s, t] = [(vv * wu - uv * wv) / whole, (uu * wv - uv * wu) / whole];
    match s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        true => a + u * s + v * t,
        false => on_edge,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_place_of_a_triangle_is_in_it_or_on_its_edge() {
        let corners =
            |z: f64| [[-1.0, -1.0, z], [2.0, -1.0, z], [-1.0, 2.0, z]].map(Vect::<3>::from);
        assert!((nearest_place(&corners(0.3)) - Vect::<3>::new(0.0, 0.0, 0.3)).norm() < 1e-15);
        let beside = corners(0.0).map(|c| c + Vect::<3>::new(0.0, 3.0, 0.0));
        assert!((nearest_place(&beside) - Vect::<3>::new(0.0, 2.0, 0.0)).norm() < 1e-15);
        let segment = [[1.0, 1.0], [1.0, 3.0]].map(Vect::<2>::from);
        assert_eq!(nearest_place(&segment), Vect::<2>::new(1.0, 1.0));
    }
}

//! Pieces of walls near each other, and their distances.

use std::collections::BTreeMap;

use sph_core::Vect;
use sph_neighbours::Domain;

use crate::geometry::wall_mesh::{MeshElement, MeshPoint, WallMesh};
use crate::treatment::outline::Outline;
use crate::{Touch, WallSpec};

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

fn ordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Bounds of a body.
struct Extent<const D: usize> {
    low: Vect<D>,
    high: Vect<D>,
}

impl<const D: usize> Extent<D> {
    fn bounds_of(places: impl Iterator<Item = Vect<D>>, margin: f64) -> Self {
        let none = Extent {
            low: Vect::repeat(f64::INFINITY),
            high: Vect::repeat(f64::NEG_INFINITY),
        };
        let mut extent = places.fold(none, |e: Self, x| Extent {
            low: e.low.inf(&x),
            high: e.high.sup(&x),
        });
        extent.low.add_scalar_mut(-margin);
        extent.high.add_scalar_mut(margin);
        extent
    }

    fn centre(&self) -> Vect<D> {
        (self.low + self.high) * 0.5
    }

    /// True if a ball may reach into it.
    fn sees(&self, x: &Vect<D>, radius: f64, domain: &Domain<D>) -> bool {
        let apart = domain.nearest(x - self.centre());
        let half = (self.high - self.low) * 0.5;
        (0..D).all(|k| apart[k].abs() <= half[k] + radius)
    }
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

    /// Contact law of each wall.
    pub(crate) fn touches(&self) -> Vec<Option<Touch>> {
        let touch = |spec: &WallSpec<D>| spec.mover.as_ref().and_then(|m| m.touch());
        self.specs.iter().map(touch).collect()
    }

    /// All pieces of surfaces of which one moves freely and that may meet within a step.
    pub(crate) fn near_pairs(&self, touches: &[Option<Touch>]) -> Vec<SurfacePair<D>> {
        let nodes: Vec<MeshPoint<D>> = self.mesh.points().collect();
        let elements: Vec<MeshElement<D>> = self.mesh.elements().collect();
        let reach = REACH * self.spacing;
        let mut all = Vec::new();
        let free = (0..touches.len()).filter(|k| touches[*k].is_some() && self.groups[*k] == *k);
        for body in free {
            let own = nodes.iter().filter(|n| self.groups[n.wall] == body);
            let extent = Extent::bounds_of(own.map(|n| n.position), reach);
            let seen = |e: &&MeshElement<D>| {
                let corners = e.corners.map(|c| nodes[c as usize].position);
                let size = corners.map(|c| (c - e.centre).norm()).into_iter();
                extent.sees(&e.centre, size.fold(0.0, f64::max), &self.domain)
            };
            let (own, others): (Vec<_>, Vec<_>) =
                (elements.iter().filter(seen)).partition(|e| self.groups[e.wall] == body);
            if others.is_empty() {
                continue;
            }
            for node in &nodes {
                let group = self.groups[node.wall];
                if group == body {
                    self.look(node, &others, &nodes, &mut all);
                } else if touches[group].is_none() && extent.sees(&node.position, 0.0, &self.domain)
                {
                    self.look(node, &own, &nodes, &mut all);
                }
            }
        }
        all
    }

    /// The nearest element of every other group of walls, if it is near enough.
    fn look(
        &self,
        node: &MeshPoint<D>,
        elements: &[&MeshElement<D>],
        nodes: &[MeshPoint<D>],
        found: &mut Vec<SurfacePair<D>>,
    ) {
        let mut nearest = BTreeMap::<usize, (f64, Vect<D>, &MeshElement<D>)>::new();
        let to = |c: u32| nodes[c as usize].position - node.position;
        for element in elements {
            let first = self.domain.nearest(to(element.corners[0]));
            let corners = element
                .corners
                .map(|c| first + self.domain.nearest(to(c) - first));
            let there = nearest_place(&corners);
            let distance = there.norm();
            let entry = nearest.entry(self.groups[element.wall]);
            let entry = entry.or_insert((f64::INFINITY, there, element));
            // At a corner the element that faces the place most gives its side.
            let faces = element.normal.dot(&there).abs() > entry.2.normal.dot(&entry.1).abs();
            let same = (distance - entry.0).abs() <= 1e-9 * self.spacing;
            if (same && faces) || (!same && distance < entry.0) {
                *entry = (distance, there, element);
            }
        }
        let (reach, depth) = (REACH * self.spacing, DEPTH * self.spacing);
        for (group, (distance, there, element)) in nearest {
            let outside = element.normal.dot(&there) <= 0.0;
            let height = if outside { distance } else { -distance };
            if height >= reach || height <= -depth {
                continue;
            }
            let away = match outside && distance > 1e-6 * self.spacing {
                true => there / -distance,
                false => element.normal,
            };
            found.push(SurfacePair {
                pair: [self.groups[node.wall], group],
                walls: [node.wall, element.wall],
                place: node.position + there * 0.5,
                image: self.domain.nearest(to(element.corners[0])) - to(element.corners[0]),
                away,
                height,
                round: outside && away.dot(&element.normal) < 1.0 - 1e-9,
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

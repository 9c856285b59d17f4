//! Walls that meet: a penalty on the distance between their surfaces.

use std::collections::BTreeMap;

use sph_core::Vect;
use sph_neighbours::{Domain, WallForce, cross};

use crate::geometry::wall_mesh::{MeshElement, MeshPoint, WallMesh};
use crate::treatment::outline::Outline;
use crate::{Touch, WallSpec};

/// Distance at which surfaces begin to push, over the spacing: a row of particles fits between them. Particles that are
/// caught between surfaces half a spacing apart are few for their room, and tension draws them to a clump.
const GAP: f64 = 1.0;

/// The same of walls that are drawn as near, or nearer.
const LEAST_GAP: f64 = 0.5;

/// How deep a place may be behind a surface to be pushed out of it, over the spacing.
const DEPTH: f64 = 1.0;

/// Both surfaces of a pair are looked at from the other.
const SHARE: f64 = 0.5;

/// A piece of a surface near another one.
struct Near<const D: usize> {
    /// Who is pushed along `away`, and who against it: groups of walls.
    pair: [usize; 2],
    place: Vect<D>,
    away: Vect<D>,
    /// Distance that is missing to the gap, m.
    missing: f64,
    /// Area that the place stands for, m^(D−1).
    area: f64,
    /// Velocity of the first against the second there, m/s.
    velocity: Vect<D>,
}

/// Where a body is.
struct Extent<const D: usize> {
    low: Vect<D>,
    high: Vect<D>,
}

impl<const D: usize> Extent<D> {
    fn of(places: impl Iterator<Item = Vect<D>>, margin: f64) -> Self {
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

    /// Whether a ball may reach into it.
    fn sees(&self, x: &Vect<D>, radius: f64, domain: &Domain<D>) -> bool {
        let apart = domain.nearest_image(x - self.centre());
        let half = (self.high - self.low) * 0.5;
        (0..D).all(|k| apart[k].abs() <= half[k] + radius)
    }
}

impl<const D: usize, M: WallMesh<D>> Outline<D, M> {
    /// What walls that touch do to each other, by the first of the walls that move together; empty if no mover asks.
    pub fn contacts(&self) -> Vec<WallForce<D>> {
        let touches = self.touches();
        if touches.iter().all(Option::is_none) {
            return Vec::new();
        }
        let near = self.near_pairs(&touches);
        let mut areas = BTreeMap::<[usize; 2], f64>::new();
        for n in &near {
            *areas.entry(ordered(n.pair)).or_default() += SHARE * n.area;
        }
        let mut forces = vec![WallForce::zero(); self.specs.len()];
        for n in &near {
            let law = Law::of(n.pair.map(|k| touches[k]), areas[&ordered(n.pair)]);
            let force = law.force(n);
            for (k, force) in n.pair.into_iter().zip([force, -force]) {
                forces[k].add(&WallForce {
                    force,
                    moment: cross(&n.place, &force),
                    ..WallForce::zero()
                });
            }
        }
        forces
    }

    /// Distances at which walls begin to push that are drawn nearer to each other than a spacing, m.
    pub fn drawn_gaps(&self) -> BTreeMap<[usize; 2], f64> {
        let mut gaps = BTreeMap::<[usize; 2], f64>::new();
        for near in self.near_pairs(&self.touches()) {
            let height = GAP * self.spacing - near.missing;
            let gap = gaps.entry(ordered(near.pair)).or_insert(height);
            *gap = gap.min(height).max(LEAST_GAP * self.spacing);
        }
        gaps
    }

    /// How each wall meets others.
    fn touches(&self) -> Vec<Option<Touch>> {
        let touch = |spec: &WallSpec<D>| spec.mover.as_ref().and_then(|m| m.touch());
        self.specs.iter().map(touch).collect()
    }

    fn near_pairs(&self, touches: &[Option<Touch>]) -> Vec<Near<D>> {
        let nodes: Vec<MeshPoint<D>> = self.mesh.points().collect();
        let elements: Vec<MeshElement<D>> = self.mesh.elements().collect();
        let reach = DEPTH * self.spacing;
        let mut all = Vec::new();
        let free = (0..touches.len()).filter(|k| touches[*k].is_some() && self.groups[*k] == *k);
        for body in free {
            let own = nodes.iter().filter(|n| self.groups[n.wall] == body);
            let extent = Extent::of(own.map(|n| n.position), reach);
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
        found: &mut Vec<Near<D>>,
    ) {
        let mut nearest = BTreeMap::<usize, (f64, Vect<D>, &MeshElement<D>)>::new();
        for element in elements {
            let to = |c: u32| {
                self.domain
                    .nearest_image(nodes[c as usize].position - node.position)
            };
            let first = to(element.corners[0]);
            let corners = element
                .corners
                .map(|c| first + self.domain.nearest_image(to(c) - first));
            let there = nearest_place(&corners);
            let distance = there.norm();
            let entry = nearest.entry(self.groups[element.wall]);
            let entry = entry.or_insert((f64::INFINITY, there, element));
            // At a corner the element that faces the place most tells on which side it is.
            let faces = element.normal.dot(&there).abs() > entry.2.normal.dot(&entry.1).abs();
            let same = (distance - entry.0).abs() <= 1e-9 * self.spacing;
            if (same && faces) || (!same && distance < entry.0) {
                *entry = (distance, there, element);
            }
        }
        for (group, (distance, there, element)) in nearest {
            let outside = element.normal.dot(&there) <= 0.0;
            let height = if outside { distance } else { -distance };
            let pair = [self.groups[node.wall], group];
            let gap = self.gaps.get(&ordered(pair));
            let gap = gap.copied().unwrap_or(GAP * self.spacing);
            if height >= gap || height <= -DEPTH * self.spacing {
                continue;
            }
            let away = match outside && distance > 1e-6 * self.spacing {
                true => there / -distance,
                false => element.normal,
            };
            let place = node.position + there * 0.5;
            let own = self.movement(node.wall, &node.position).velocity;
            let other = self
                .movement(element.wall, &(node.position + there))
                .velocity;
            found.push(Near {
                pair,
                place,
                away,
                missing: gap - height,
                area: node.size * self.spacing.powi(D as i32 - 1),
                velocity: own - other,
            });
        }
    }
}

fn ordered([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
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

/// Share of the velocity that is left of an impact on a spring and a damper that never pull, with the damping ratio ζ ≤ 1
/// (Schwager & Pöschel 2007): exp(−ζ/s · atan2(2 ζ s, 2 ζ² − 1)), s = √(1 − ζ²).
fn left_over(ratio: f64) -> f64 {
    let s = (1.0 - ratio * ratio).sqrt();
    (-ratio / s * (2.0 * ratio * s).atan2(2.0 * ratio * ratio - 1.0)).exp()
}

/// The damping ratio that leaves a share of the velocity; 1, which leaves e⁻², for shares below.
fn damping_ratio(restitution: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match left_over(middle) > restitution {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

/// What counts between two walls.
struct Law {
    stiffness: f64,
    /// c, Pa s/m.
    damping: f64,
    /// Largest friction over velocity, Pa s/m.
    grip: f64,
    friction: f64,
}

impl Law {
    fn of(pair: [Option<Touch>; 2], area: f64) -> Self {
        let mut all = pair.into_iter().flatten();
        let law = |t: Touch| {
            let critical = 2.0 * (t.stiffness * t.mass / area).sqrt();
            let ratio = damping_ratio(t.restitution);
            Law {
                stiffness: t.stiffness,
                damping: ratio * critical,
                grip: critical,
                friction: t.friction,
            }
        };
        let none = Touch {
            mass: 0.0,
            stiffness: 0.0,
            restitution: 0.0,
            friction: 0.0,
        };
        let first = all.next().unwrap_or(none);
        law(all.next().map_or(first, |second| Touch {
            mass: first.mass * second.mass / (first.mass + second.mass),
            stiffness: first.stiffness.min(second.stiffness),
            restitution: first.restitution.min(second.restitution),
            friction: (first.friction * second.friction).sqrt(),
        }))
    }

    /// The force on the first of a pair, N.
    fn force<const D: usize>(&self, near: &Near<D>) -> Vect<D> {
        let area = SHARE * near.area;
        let parting = near.velocity.dot(&near.away);
        let push = area * (self.stiffness * near.missing - self.damping * parting).max(0.0);
        let along = near.velocity - near.away * parting;
        let speed = along.norm();
        if speed == 0.0 {
            return near.away * push;
        }
        let rub = (self.friction * push).min(self.grip * area * speed);
        near.away * push - along * (rub / speed)
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

    /// By small steps: the share that is left is the one that was asked for.
    #[test]
    fn a_damped_impact_leaves_the_share_that_was_asked_for() {
        for restitution in [1.0, 0.8, 0.5, 0.2] {
            let ratio = damping_ratio(restitution);
            let (mut x, mut v, dt) = (0.0, 1.0, 1e-5);
            loop {
                let push = x + 2.0 * ratio * v;
                if push < 0.0 || x < 0.0 {
                    break;
                }
                v -= dt * push;
                x += dt * v;
            }
            assert!((v + restitution).abs() < 1e-3, "{restitution}: {v}");
        }
        assert!(damping_ratio(0.0) > 0.999_999);
    }
}

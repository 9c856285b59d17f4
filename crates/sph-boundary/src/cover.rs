//! Walls that slide along each other or part: what one takes of the other's fluid.

use rayon::prelude::*;
use sph_core::Vect;

use crate::wall_mesh::{MeshPoint, WallMesh};

/// Samples along a radius of the ball around a node; half a sample from its centre is the first.
const SAMPLES: i32 = 3;

/// Nodes near walls that move otherwise than their own, and what is left of their fluid.
///
/// A node stands for the fluid in a ball of half a spacing around it. Of that ball a wall that
/// moves otherwise (a gate that stands on a floor, a piston that sweeps it) may take a part, which
/// changes continuously with its position, and what is within half a spacing of both walls is
/// stood for by the nodes of both. The visible share is the mean over samples of the ball of
/// H(d_own) [H(d_other) + H(d_other − δr/2)]/2 over that of H(d_own), d being signed distances and
/// H a ramp as wide as the samples are apart.
#[derive(Debug, Default)]
pub(crate) struct Cover {
    /// Nodes within reach of other walls at the last search.
    near: Vec<usize>,
    /// Positions of all nodes at the last search, m.
    searched_at: Vec<[f64; 3]>,
}

impl Cover {
    /// The nodes whose visible share may differ from 1, with that share.
    pub fn shares<const D: usize, M: WallMesh<D>>(
        &mut self,
        mesh: &M,
        points: &[MeshPoint<D>],
        groups: &[usize],
        spacing: f64,
    ) -> Vec<(usize, f64)> {
        let nodes = points.iter().map(|p| (p.position, groups[p.wall]));
        let nodes: Vec<_> = nodes.collect();
        if self.outdated(&nodes, spacing) {
            let others = |(x, group): &(Vect<D>, usize)| {
                let others = nearby(mesh, x, 2.0 * spacing, |w| groups[w] != *group);
                M::signed_distance(&others, &Vect::zeros(), 2.0 * spacing).is_some()
            };
            let all = nodes.par_iter().enumerate();
            let near = all.filter(|(_, node)| others(node)).map(|(v, _)| v);
            self.near = near.collect();
            self.searched_at = nodes.iter().map(|(x, _)| padded(x)).collect();
        }
        let share = |&v: &usize| {
            let (x, group) = &nodes[v];
            (v, visible(mesh, groups, *group, x, spacing))
        };
        self.near.par_iter().map(share).collect()
    }

    /// Whether a node may have come near since the search: from 2 spacings to where it is covered (7/6) two walls may each
    /// come nearer by 0.4.
    fn outdated<const D: usize>(&self, nodes: &[(Vect<D>, usize)], spacing: f64) -> bool {
        if self.searched_at.len() != nodes.len() {
            return true;
        }
        let moved = nodes.iter().zip(&self.searched_at).map(|((x, _), old)| {
            let now = padded(x);
            (0..3).map(|k| (now[k] - old[k]).powi(2)).sum::<f64>()
        });
        moved.fold(0.0, f64::max) > (0.4 * spacing).powi(2)
    }
}

fn padded<const D: usize>(x: &Vect<D>) -> [f64; 3] {
    std::array::from_fn(|k| x.get(k).copied().unwrap_or(0.0))
}

/// Elements of some walls that may be within a radius of a point, as seen from there.
fn nearby<const D: usize, M: WallMesh<D>>(
    mesh: &M,
    x: &Vect<D>,
    radius: f64,
    of: impl Fn(usize) -> bool,
) -> Vec<M::Seen> {
    let near = mesh.near(x, radius).into_iter();
    let of_these = near.filter(|n| of(mesh.wall_of(*n)));
    of_these.map(|n| mesh.seen(x, n)).collect()
}

fn visible<const D: usize, M: WallMesh<D>>(
    mesh: &M,
    groups: &[usize],
    group: usize,
    x: &Vect<D>,
    spacing: f64,
) -> f64 {
    let apart = 0.5 * spacing / f64::from(SAMPLES);
    let mut others = nearby(mesh, x, 2.0 * spacing, |w| groups[w] != group);
    let Some(distance) = M::signed_distance(&others, &Vect::zeros(), 2.0 * spacing) else {
        return 1.0;
    };
    if distance >= spacing + apart {
        return 1.0;
    }
    if distance <= -(0.5 * spacing + apart) {
        return 0.0;
    }
    let ramp = |d: f64| (0.5 + d / apart).clamp(0.0, 1.0);
    let left = |d: f64| 0.5 * (ramp(d) + ramp(d - 0.5 * spacing));
    // What is farther from the node than its wall by twice the radius of the ball is the nearest of no sample.
    let reach = [0.0, distance.abs()].map(|d| d + 0.5 * spacing + apart);
    let own = nearby(mesh, x, reach[0] + 0.5 * spacing, |w| groups[w] == group);
    let around = reach[1] + 0.5 * spacing;
    let alone = std::slice::from_ref;
    others.retain(|n| M::signed_distance(alone(n), &Vect::zeros(), around).is_some());
    let (mut all, mut both) = (0.0, 0.0);
    // No sample is in a plane through the node, where a side would be undecided.
    let side = 2 * SAMPLES;
    let middle = f64::from(SAMPLES) - 0.5;
    for n in 0..side.pow(D as u32) {
        let step = |k: usize| f64::from(n / side.pow(k as u32) % side) - middle;
        let offset = Vect::<D>::from_fn(|k, _| apart * step(k));
        if offset.norm() > 0.5 * spacing {
            continue;
        }
        let mine = M::signed_distance(&own, &offset, reach[0]).map_or(1.0, ramp);
        if mine > 0.0 {
            let other = M::signed_distance(&others, &offset, reach[1]);
            all += mine;
            both += mine * other.map_or(1.0, left);
        }
    }
    if all > 0.0 { both / all } else { 1.0 }
}

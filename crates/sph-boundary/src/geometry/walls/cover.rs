//! Walls that slide along each other or part: the part of the other's fluid that one takes.

use rayon::prelude::*;
use sph_core::Vect;

use crate::{NearElement, SeenElement, WallMesh};

/// Samples along a radius of the ball around a node; half a sample from its centre is the first.
const SAMPLES: i32 = 3;
/// Radius of the search for elements around a node, over the spacing: those within 2 spacings, and those that may come
/// there until the next search.
const FAR: f64 = 2.8;

/// Nodes near walls that move otherwise than their own, and the rest of their fluid.
///
/// A node stands for the fluid in a ball of half a spacing around it. Of that ball a wall that moves otherwise (a gate
/// that stands on a floor, a piston that sweeps it) may take a part, which changes continuously with its position, and
/// what is within half a spacing of both walls is stood for by the nodes of both. The visible share is the mean over
/// samples of the ball of H(d_own) [H(d_other) + H(d_other − δr/2)]/2 over that of H(d_own), d being signed distances
/// and H a ramp as wide as the samples are apart.
#[derive(Debug, Default)]
pub(crate) struct Cover<const D: usize> {
    /// Nodes within reach of other walls at the last search.
    near: Vec<NodeNeighbours<D>>,
    /// Positions of all nodes at the last search, m.
    searched_at: Vec<Vect<D>>,
}

/// A node and the elements that may be near it until the next search.
#[derive(Debug)]
struct NodeNeighbours<const D: usize> {
    node: usize,
    /// Elements of walls that move with it, and of others.
    own: Vec<NearElement<D>>,
    others: Vec<NearElement<D>>,
}

impl<const D: usize> Cover<D> {
    /// The nodes whose visible share may differ from 1, with that share.
    pub fn shares<M: WallMesh<D>>(
        &mut self,
        mesh: &M,
        groups: &[usize],
        spacing: f64,
    ) -> Vec<(usize, f64)> {
        let nodes = mesh.nodes().iter();
        let nodes = nodes.map(|n| (Vect::from(n.position), groups[n.wall]));
        let nodes: Vec<_> = nodes.collect();
        if self.outdated(&nodes, spacing) {
            let near = |(node, (x, group)): (usize, &(Vect<D>, usize))| {
                let all = mesh.near(x, FAR * spacing).into_iter();
                let own = |n: &NearElement<D>| groups[mesh.wall_of(*n)] == *group;
                let (own, others): (Vec<_>, Vec<_>) = all.partition(own);
                let seen = mesh.seen(x, &others);
                let found = SeenElement::signed_distance(&seen, [0.0; D], 2.0 * spacing);
                found.map(|_| NodeNeighbours { node, own, others })
            };
            self.near = nodes.par_iter().enumerate().filter_map(near).collect();
            self.searched_at = nodes.iter().map(|(x, _)| *x).collect();
        }
        let share = |near: &NodeNeighbours<D>| {
            let (x, _) = &nodes[near.node];
            (near.node, visible(mesh, near, x, spacing))
        };
        self.near.par_iter().map(share).collect()
    }

    /// True if a node may have come near since the search: from 2 spacings to where it is covered (7/6) two walls may
    /// each come nearer by 0.4.
    fn outdated(&self, nodes: &[(Vect<D>, usize)], spacing: f64) -> bool {
        if self.searched_at.len() != nodes.len() {
            return true;
        }
        let both = nodes.iter().zip(&self.searched_at);
        let moved = both.map(|((x, _), old)| (x - old).norm_squared());
        moved.fold(0.0, f64::max) > (0.4 * spacing).powi(2)
    }
}

fn visible<const D: usize, M: WallMesh<D>>(
    mesh: &M,
    around: &NodeNeighbours<D>,
    x: &Vect<D>,
    spacing: f64,
) -> f64 {
    let apart = 0.5 * spacing / f64::from(SAMPLES);
    let mut others = mesh.seen(x, &around.others);
    let Some(distance) = SeenElement::signed_distance(&others, [0.0; D], 2.0 * spacing) else {
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
    let mut own = mesh.seen(x, &around.own);
    for (elements, reach) in [&mut own, &mut others].into_iter().zip(reach) {
        let (alone, far) = (std::slice::from_ref, reach + 0.5 * spacing);
        elements.retain(|e| SeenElement::signed_distance(alone(e), [0.0; D], far).is_some());
    }
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
        let mine = SeenElement::signed_distance(&own, offset.into(), reach[0]).map_or(1.0, ramp);
        if mine > 0.0 {
            let other = SeenElement::signed_distance(&others, offset.into(), reach[1]);
            all += mine;
            both += mine * other.map_or(1.0, left);
        }
    }
    if all > 0.0 { both / all } else { 1.0 }
}

//! Walls that slide along each other or part: what one takes of the other's fluid.

use rayon::prelude::*;
use sph_core::Vect;

use crate::wall_mesh::WallMesh;

/// Samples along a radius of the ball around a node.
const SAMPLES: i32 = 3;

/// Nodes near walls that move otherwise than their own, and what is left of their fluid.
///
/// A node stands for the fluid in a ball of half a spacing around it. Of that ball a wall that
/// moves otherwise (a gate that stands on a floor, a piston that sweeps it) may take a part, which
/// changes continuously with its position: the visible share is the mean over samples of the ball
/// of H(d_own) H(d_other) over that of H(d_own), d being signed distances and H a ramp as wide as
/// the samples are apart.
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
        groups: &[usize],
        spacing: f64,
    ) -> Vec<(usize, f64)> {
        let nodes: Vec<_> = mesh
            .points()
            .map(|p| (p.position, groups[p.wall]))
            .collect();
        if self.outdated(&nodes, spacing) {
            let others = |(x, group): &(Vect<D>, usize)| {
                let other = |wall: usize| groups[wall] != *group;
                mesh.signed_distance(x, 2.0 * spacing, &other).is_some()
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

    /// Whether nodes have moved against each other by more than half a spacing since the search.
    fn outdated<const D: usize>(&self, nodes: &[(Vect<D>, usize)], spacing: f64) -> bool {
        if self.searched_at.len() != nodes.len() {
            return true;
        }
        let moved = nodes.iter().zip(&self.searched_at).map(|((x, _), old)| {
            let now = padded(x);
            (0..3).map(|k| (now[k] - old[k]).powi(2)).sum::<f64>()
        });
        moved.fold(0.0, f64::max) > (0.5 * spacing).powi(2)
    }
}

fn padded<const D: usize>(x: &Vect<D>) -> [f64; 3] {
    std::array::from_fn(|k| x.get(k).copied().unwrap_or(0.0))
}

fn visible<const D: usize, M: WallMesh<D>>(
    mesh: &M,
    groups: &[usize],
    group: usize,
    x: &Vect<D>,
    spacing: f64,
) -> f64 {
    let apart = 0.5 * spacing / f64::from(SAMPLES);
    let ramp = |distance: Option<f64>| match distance {
        Some(d) => (0.5 + d / apart).clamp(0.0, 1.0),
        None => 1.0,
    };
    let (mut own, mut both) = (0.0, 0.0);
    let side = 2 * SAMPLES + 1;
    for n in 0..side.pow(D as u32) {
        let offset =
            Vect::<D>::from_fn(|k, _| apart * f64::from(n / side.pow(k as u32) % side - SAMPLES));
        if offset.norm() > 0.5 * spacing * (1.0 + 1e-9) {
            continue;
        }
        let at = x + offset;
        let reach = 2.0 * spacing;
        let mine = ramp(mesh.signed_distance(&at, reach, &|w| groups[w] == group));
        if mine > 0.0 {
            own += mine;
            both += mine * ramp(mesh.signed_distance(&at, reach, &|w| groups[w] != group));
        }
    }
    if own > 0.0 { both / own } else { 1.0 }
}

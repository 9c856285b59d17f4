//! Filling bodies with particles on a square lattice.

use sph_core::place_cells::{PlaceCells, offsets};

use crate::Region;
use crate::filling::nodes::{Nodes, Offset};
use crate::geometry::periodic_place::{PeriodicRegion, ROUNDING, wrapped};
use crate::geometry::vector::distance;

/// The particles of one body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyParticles<const D: usize> {
    /// Number of the body in the list that was filled.
    pub body: usize,
    /// Positions, m.
    pub positions: Vec<[f64; D]>,
}

/// Positions of particles for bodies on square lattices of one spacing, m.
///
/// Every body has its own lattice, see [`Offset`]. Along a periodic axis (lower and upper bound,
/// m) that a body fills entirely, the lattice is the period divided evenly, and the two ends
/// are no surfaces. Where two bodies touch, the surface that they share is no surface either:
/// a node near it is kept unless another particle is nearer than three quarters of a spacing, so
/// that a row neither is missing from an interface nor stands there twice.
///
/// The bodies must not overlap, and the caller has asked [`estimate`](crate::estimate) whether
/// there is room.
pub fn fill<const D: usize>(
    bodies: &[Region<D>],
    spacing: f64,
    offset: Offset,
    periodic: &[Option<[f64; 2]>; D],
) -> Vec<BodyParticles<D>> {
    let placed: Vec<_> = bodies
        .iter()
        .map(|b| PeriodicRegion::new(b, spacing, periodic))
        .collect();
    let (firm, reach) = match offset {
        Offset::None => (
            0.5 * spacing * (1.0 - ROUNDING),
            0.5 * spacing * (1.0 - ROUNDING),
        ),
        Offset::Half => (ROUNDING * spacing, 1e-3 * spacing),
    };
    // Particles near surfaces.
    let least = 0.75 * spacing;
    let mut taken = PlaceCells::new(least, []);
    let mut doubtful = Vec::new();
    let mut filled = Vec::with_capacity(bodies.len());
    for (body, region) in placed.iter().enumerate() {
        let mut positions = Vec::new();
        for node in Nodes::new(region, spacing, offset).iter() {
            let depth = region.depth(&node);
            if depth >= firm {
                positions.push(wrapped(&node, periodic));
                if bodies.len() > 1 && depth < 2.0 * spacing {
                    taken.add(node, node);
                }
            } else if bodies.len() > 1 && depth >= -ROUNDING * spacing {
                doubtful.push((body, node));
            }
        }
        filled.push(BodyParticles { body, positions });
    }
    let around = directions::<D>();
    for (body, node) in doubtful {
        let within = |x: [f64; D]| placed.iter().any(|p| p.depth(&x) >= -ROUNDING * spacing);
        let beside = |d: &[f64; D]| std::array::from_fn(|k| node[k] + reach * d[k]);
        let near = |shift: &[f64; D]| {
            let x = std::array::from_fn(|k| node[k] + shift[k]);
            taken.around(x).any(|y| distance(&x, y) < least)
        };
        let free = || !placed[body].shifts().iter().any(near);
        if free() && around.iter().all(|d| within(beside(d))) {
            taken.add(node, node);
            filled[body].positions.push(wrapped(&node, periodic));
        }
    }
    filled
}

/// Unit vectors to all neighbours of a cell.
fn directions<const D: usize>() -> Vec<[f64; D]> {
    let all = offsets::<D>().filter(|o| o.iter().any(|c| *c != 0));
    all.map(|o| {
        let length = o.iter().map(|c| (c * c) as f64).sum::<f64>().sqrt();
        o.map(|c| c as f64 / length)
    })
    .collect()
}

//! Filling bodies with particles on a square lattice, and random displacements and velocities of these, the same on
//! every machine.

use sph_core::SplitMix;
use sph_core::place_cells::{PlaceCells, offsets};

use crate::Region;
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
/// Every body has its own lattice, see [`Offset`]. Along a periodic axis (lower and upper bound, m) that a body fills
/// entirely, the lattice is the period divided evenly, and the two ends are no surfaces. Where two bodies touch, the
/// surface that they share is no surface either: a node near it is kept unless another particle is nearer than three
/// quarters of a spacing, so that a row neither is missing from an interface nor stands there twice.
///
/// The bodies must not overlap, and the caller has asked [`estimate`](crate::estimate) whether there is room.
pub fn fill<const D: usize>(
    bodies: &[Region<D>],
    spacing: f64,
    offset: Offset,
    periodic: &[Option<[f64; 2]>; D],
) -> Vec<BodyParticles<D>> {
    let placed = bodies
        .iter()
        .map(|b| PeriodicRegion::new(b, spacing, periodic));
    let placed: Vec<_> = placed.collect();
    let half = 0.5 * spacing * (1.0 - ROUNDING);
    let (firm, reach) = match offset {
        Offset::None => (half, half),
        Offset::Half => (ROUNDING * spacing, 1e-3 * spacing),
    };
    // Particles near surfaces.
    let least = 0.75 * spacing;
    let mut taken = PlaceCells::new(least, []);
    let mut doubtful = Vec::new();
    let mut filled = Vec::with_capacity(bodies.len());
    for (body, region) in placed.iter().enumerate() {
        let mut positions = Vec::new();
        for node in nodes(region, spacing, offset) {
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
        let free = || !placed[body].shifts.iter().any(near);
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
    let unit = |o: [i64; D]| {
        let length = o.iter().map(|c| (c * c) as f64).sum::<f64>().sqrt();
        o.map(|c| c as f64 / length)
    };
    all.map(unit).collect()
}

/// Origin of the lattice of a body, counted from the lower corner of the box around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Offset {
    /// Nodes at whole spacings: a row stands one spacing off the body's side. A node is kept if
    /// it is at least half a spacing inside.
    None,
    /// Nodes at half spacings: a row stands half a spacing off the body's side. A node is kept if it is inside.
    Half,
}

/// Nodes lo + (k + shift)·δr for k below the count, along every axis, the first axis running slowest.
fn nodes<const D: usize>(
    placed: &PeriodicRegion<'_, D>,
    spacing: f64,
    offset: Offset,
) -> impl Iterator<Item = [f64; D]> {
    let (lo, hi) = placed.bounds();
    let spans = placed.spans();
    let shift = if offset == Offset::Half { 0.5 } else { 0.0 };
    let length = |k: usize| (hi[k] - lo[k]) / spacing;
    let whole = |k: usize| length(k).round().max(1.0);
    let counts: [usize; D] = std::array::from_fn(|k| match (spans[k], offset) {
        (true, _) => whole(k) as usize,
        (false, Offset::None) => (length(k) + ROUNDING).floor() as usize + 1,
        (false, Offset::Half) => (length(k) + 0.5).ceil() as usize,
    });
    let step: [f64; D] = std::array::from_fn(|k| match spans[k] {
        true => (hi[k] - lo[k]) / whole(k),
        false => spacing,
    });
    let origin: [f64; D] = std::array::from_fn(|k| lo[k] + shift * step[k]);
    (0..counts.iter().product()).map(move |number| {
        let mut rest: usize = number;
        let mut node = origin;
        for k in (0..D).rev() {
            node[k] += (rest % counts[k]) as f64 * step[k];
            rest /= counts[k];
        }
        node
    })
}

/// About how many particles [`fill`](crate::fill) will place, from the boxes around the bodies.
///
/// No lattice node is visited, so that a scene of 10¹² particles can be refused at once.
/// Regions that are cut out, and the corners beside a disc, count as if they were filled.
///
/// ```
/// use sph_scene::{Region, Shape, estimate};
///
/// let body = Region::whole(Shape::Cuboid { lo: [0.0; 3], hi: [1.0; 3] });
/// assert_eq!(estimate(&[body], 1e-4), 1e12);
/// ```
pub fn estimate<const D: usize>(bodies: &[Region<D>], spacing: f64) -> f64 {
    let along = |lo: f64, hi: f64| ((hi - lo) / spacing).round().max(1.0);
    let count = |region: &Region<D>| {
        let (lo, hi) = region.base.bounds();
        (0..D).map(|k| along(lo[k], hi[k])).product::<f64>()
    };
    bodies.iter().map(count).sum()
}

/// Displaces every particle along each axis by at most `fraction` of the spacing, at random.
///
/// The same seed gives the same displacements. A particle that leaves a periodic box enters it on the other side.
pub fn disturb<const D: usize>(
    bodies: &mut [BodyParticles<D>],
    spacing: f64,
    fraction: f64,
    seed: u64,
    periodic: &[Option<[f64; 2]>; D],
) {
    if fraction == 0.0 {
        return;
    }
    let mut random = SplitMix(seed);
    for x in bodies.iter_mut().flat_map(|b| b.positions.iter_mut()) {
        let moved = x.map(|c| c + fraction * spacing * (2.0 * random.unit() - 1.0));
        *x = wrapped(&moved, periodic);
    }
}

/// A random velocity, along each axis at most `amplitude`, that depends on the particle's number and the seed alone.
pub fn noise<const D: usize>(particle: u32, amplitude: f64, seed: u64) -> [f64; D] {
    // The numbers of a seed that displacements do not use.
    let mut random = SplitMix(SplitMix(!seed).next() ^ u64::from(particle));
    std::array::from_fn(|_| amplitude * (2.0 * random.unit() - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_repeats_is_bounded_and_has_no_mean() {
        let all: Vec<[f64; 2]> = (0..10_000).map(|i| noise(i, 0.1, 3)).collect();
        assert_eq!(all[7], noise(7, 0.1, 3));
        assert_ne!(all[7], noise(7, 0.1, 4));
        for axis in 0..2 {
            let mean = all.iter().map(|u| u[axis]).sum::<f64>() / 1e4;
            let square = all.iter().map(|u| u[axis].powi(2)).sum::<f64>() / 1e4;
            assert!(all.iter().all(|u| u[axis].abs() <= 0.1));
            // Five standard errors, 0.1/√3/100 of the mean; a third of the square.
            assert!(mean.abs() < 5.0 * 0.1 / 3f64.sqrt() / 100.0, "{mean}");
            assert!((square / (0.01 / 3.0) - 1.0).abs() < 0.05, "{square}");
        }
    }

    #[test]
    fn displacements_repeat_and_stay_within_the_fraction() {
        let start = || {
            vec![BodyParticles {
                body: 0,
                positions: vec![[0.5, 0.5]; 100],
            }]
        };
        let (mut a, mut b) = (start(), start());
        disturb(&mut a, 0.1, 0.2, 7, &[None; 2]);
        disturb(&mut b, 0.1, 0.2, 7, &[None; 2]);
        assert_eq!(a, b);
        let near = |x: &[f64; 2]| x.iter().all(|c| (c - 0.5).abs() <= 0.02);
        assert!(a[0].positions.iter().all(near));
        assert_ne!(a[0].positions[0], a[0].positions[1]);
    }
}

//! Walls within a support of each other.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use rayon::prelude::*;
use sph_core::{StepError, Vect};
use sph_kernels::Sampler;

use crate::{CellGrid, WallForce, World, cross};

/// Corners that are as near to each other are one, over the size of an element.
const SAME_PLACE: f64 = 1e-6;

/// Intervals of the table of the kernel's outer part.
const INTERVALS: usize = 64;

/// Forces that walls within a support of each other exert through the fluid that is not between them, on the wanted
/// ones.
///
/// The sum of a wall's ∇γ over the particles before it is that over its whole support; a second wall at a distance g leaves
/// out the part beyond g, and the force on the first one is p S (1 − 2 (1 − γ₂)), γ₂ that of the second wall at the
/// first one. The missing part is 2 p ∫∫ ∇w over both solids, which is equal and opposite. Over the elements s of this
/// wall and t of others, with δ_st the part of 1 − γ at s that t leaves,
///
/// F = −Σ_st ½ (p_s + p_t) [S_s n_s δ_st − S_t n_t δ_ts],
///
/// exact for linear pressures between parallel faces. Walls with a common corner bound the fluid as one, and have none of it.
/// Ours.
///
/// Walls that scale the kernel have no such part: their forces are the reactions to those on particles.
pub(crate) fn facing_forces<const D: usize>(
    world: &World<D>,
    wanted: &[bool],
) -> Result<Vec<WallForce<D>>, StepError> {
    let mut forces = vec![WallForce::zero(); wanted.len()];
    if world.walls.scales {
        return Ok(forces);
    }
    let pairs = pairs(world, wanted);
    if pairs.is_empty() {
        return Ok(forces);
    }
    let elements = &world.walls.elements;
    let owned = world.owned_elements()?;
    // From the pressure of one of the two, which one rank has.
    let part = |facing: &Facing, pressure: f64| {
        let ([s, t], [to_t, to_s]) = (facing.pair, facing.parts);
        let half = -0.5 * pressure;
        let on = |e: usize, share: f64| elements.normal[e] * (half * elements.measure[e] * share);
        let (on_s, on_t) = (on(s, to_t), on(t, -to_s));
        let at_s = elements.centre[s] + world.walls.round(elements.wall[s]);
        let apart = elements.centre[s] - elements.centre[t];
        let at_t = at_s - world.domain.nearest_image(apart);
        let [first, second] = [(at_s, on_s), (at_t, on_t)].map(|(x, f)| WallForce::parts(&x, &f));
        std::array::from_fn(|k| first[k] + second[k])
    };
    let parts = |facing: &Facing| {
        let pressure = |e: usize| owned.has(e).then_some(elements.pressure[e]);
        let known = facing.pair.map(pressure);
        known.map(|p| p.map(|p| part(facing, p)))
    };
    for (wall, force) in forces.iter_mut().enumerate() {
        let of_wall = |pair: &&Facing| elements.wall[pair.pair[0]] as usize == wall;
        if !pairs.iter().any(|pair| of_wall(&pair)) {
            continue;
        }
        let one = |k: usize| {
            let pair = &pairs[k / 2];
            of_wall(&pair).then(|| parts(pair)[k % 2]).flatten()
        };
        *force = WallForce::from_sums(world.sums_of(2 * pairs.len(), &one)?);
    }
    Ok(forces)
}

struct Facing {
    /// The first is one of a wanted wall.
    pair: [usize; 2],
    /// The part of 1 − γ that each leaves at the other: the second at the first, the first at the second.
    parts: [f64; 2],
}

/// The elements of wanted walls with all those of other walls within a support, but for walls with a common corner.
fn pairs<const D: usize>(world: &World<D>, wanted: &[bool]) -> Vec<Facing> {
    let (elements, names) = (&world.walls.elements, &world.walls.names);
    if names.iter().all(|name| *name == names[0]) || !wanted.contains(&true) {
        return Vec::new();
    }
    // The number of the first wall with the same name.
    let first = |name: &String| names.iter().position(|other| other == name);
    let numbers: Vec<_> = names.iter().map(first).collect();
    let number = |s: usize| numbers[elements.wall[s] as usize];
    let mut all = near(world, wanted, number);
    let walls = |[s, t]: [usize; 2]| [number(s).min(number(t)), number(s).max(number(t))];
    let joined = all.par_iter().with_min_len(256);
    let joined = joined.filter(|([s, t], _)| are_joined(world, *s, *t));
    let joined: BTreeSet<_> = joined.map(|(pair, _)| walls(*pair)).collect();
    all.retain(|(pair, _)| !joined.contains(&walls(*pair)));
    let outer = OuterPart::new(&*world.kernel);
    let all = all.into_par_iter().with_min_len(64);
    let parts = all.map(|(pair, distance)| {
        let part = outer.at(distance) / (2.0 * TAU);
        let [s, t] = pair;
        let parts = [(t, s), (s, t)].map(|(of, at)| part * angle(world, of, at));
        Facing { pair, parts }
    });
    parts.collect()
}

/// The elements of wanted walls with all those of walls with another number within a support, and their distances, m.
fn near<const D: usize, N: PartialEq + Sync>(
    world: &World<D>,
    wanted: &[bool],
    number: impl Fn(usize) -> N + Sync,
) -> Vec<([usize; 2], f64)> {
    let elements = &world.walls.elements;
    let radius = world.kernel.support_radius();
    let held = (0..elements.centre.len()).filter(|s| wanted[elements.wall[*s] as usize]);
    let held: Vec<usize> = held.collect();
    let place = |s: usize| world.domain.wrapped(elements.centre[s]);
    let places: Vec<_> = held.iter().map(|s| place(*s)).collect();
    let grid = CellGrid::new(&places, radius, &world.domain);
    // Boxes around the elements of every wall.
    let mut boxes: Vec<(N, [Vect<D>; 2])> = Vec::new();
    for (s, x) in held.iter().zip(&places) {
        match boxes.iter_mut().find(|(other, _)| *other == number(*s)) {
            Some((_, [low, high])) => (*low, *high) = (low.inf(x), high.sup(x)),
            None => boxes.push((number(*s), [*x; 2])),
        }
    }
    let within = |x: &Vect<D>, [low, high]: &[Vect<D>; 2]| {
        let along = |k: usize| x[k] > low[k] - radius && x[k] < high[k] + radius;
        (0..D).all(|k| world.domain.periodic[k] || along(k))
    };
    let before = |t: usize| {
        let mut found = Vec::new();
        let (x, own) = (place(t), number(t));
        let mut others = boxes.iter().filter(|(other, _)| *other != own);
        if !others.any(|(_, of)| within(&x, of)) {
            return found;
        }
        grid.ranges(&x, radius, |range| {
            let near = grid.order()[range].iter().map(|k| held[*k as usize]);
            for s in near.filter(|s| number(*s) != own) {
                let apart = elements.centre[s] - elements.centre[t];
                let distance = world.domain.nearest_image(apart).norm();
                if distance < radius {
                    found.push(([s, t], distance));
                }
            }
        });
        found
    };
    let all = (0..elements.centre.len()).into_par_iter().with_min_len(256);
    all.flat_map_iter(before).collect()
}

fn are_joined<const D: usize>(world: &World<D>, first: usize, second: usize) -> bool {
    let (elements, points) = (&world.walls.elements, &world.walls.points.position);
    let [first, second] = [first, second].map(|e| elements.corners[e].map(|c| points[c as usize]));
    let size = (first[0] - first[1]).norm();
    let mut pairs = first.iter().flat_map(|a| second.iter().map(move |b| a - b));
    pairs.any(|apart| world.domain.nearest_image(apart).norm() < SAME_PLACE * size)
}

/// Solid angle of an element at the centre of another one, of 4π, or twice its angle in the plane; positive where that
/// centre is on the fluid's side of it.
fn angle<const D: usize>(world: &World<D>, element: usize, at: usize) -> f64 {
    let (elements, points) = (&world.walls.elements, &world.walls.points.position);
    let centre = elements.centre[element];
    let to_centre = world.domain.nearest_image(centre - elements.centre[at]);
    let corners = elements.corners[element]
        .map(|c| to_centre + world.domain.nearest_image(points[c as usize] - centre));
    let size = match &corners[..] {
        [a, b] => 2.0 * cross(a, b)[2].abs().atan2(a.dot(b)),
        [a, b, c] => {
            // Van Oosterom & Strackee (1983).
            let sizes = [a, b, c].map(|x| x.norm());
            let volume: f64 = (0..3).map(|k| a[k] * cross(b, c)[k]).sum();
            let pairs = a.dot(b) * sizes[2] + b.dot(c) * sizes[0] + c.dot(a) * sizes[1];
            2.0 * volume.abs().atan2(sizes.iter().product::<f64>() + pairs)
        }
        _ => 0.0,
    };
    -size.copysign(to_centre.dot(&elements.normal[element]))
}

struct OuterPart {
    support: f64,
    /// At the ends of the intervals.
    values: Vec<f64>,
}

impl OuterPart {
    fn new(kernel: &dyn Sampler) -> Self {
        let (support, dimension) = (kernel.support_radius(), kernel.dimension());
        let sphere = if dimension == 2 { TAU } else { 2.0 * TAU };
        let shell = |r: f64| sphere * r.powi(dimension as i32 - 1) * kernel.at(r).0;
        let width = support / INTERVALS as f64;
        let mut values = vec![0.0; INTERVALS + 1];
        for k in (0..INTERVALS).rev() {
            let [near, middle, far] = [0.0, 0.5, 1.0].map(|x| shell((k as f64 + x) * width));
            values[k] = values[k + 1] + width / 6.0 * (near + 4.0 * middle + far);
        }
        OuterPart { support, values }
    }

    fn at(&self, distance: f64) -> f64 {
        let place = distance / self.support * INTERVALS as f64;
        let first = (place as usize).min(INTERVALS - 1);
        let between = place - first as f64;
        self.values[first] * (1.0 - between) + self.values[first + 1] * between
    }
}

//! Fit of the lattices of bodies to each other and to the walls where they touch.
//!
//! The lattice of a body starts at the corner of its box. Where two bodies are not whole spacings apart, or a body is not from a flat
//! wall, the pressure of the first steps pushes them into place, with currents of a good part of a metre per second.

use std::collections::BTreeMap;

use sph_core::fields;
use sph_neighbours::CellGrid;
use sph_scene::{OFF_LATTICE, Scene};
use sph_solver::{Flow, SolverError};

/// Deviation from one spacing, in spacings, from which a contact is remarked upon.
const MISFIT: f64 = 0.2;
/// Distance in spacings within which two rows are in contact.
const CONTACT: f64 = 1.45;
/// Scatter of the distances, in spacings, above which the contact is none of two flat rows.
const FLAT: f64 = 0.1;
/// Particles that make a contact.
const ROW: usize = 4;

/// Mean of the distances along one contact where it is far from the fitting one, all along.
fn misfit(distances: &[f64], fitting: f64) -> Option<f64> {
    let number = distances.len() as f64;
    let mean = distances.iter().sum::<f64>() / number;
    let squares = distances.iter().map(|d| d * d).sum::<f64>();
    let scatter = (squares / number - mean * mean).max(0.0).sqrt();
    let told = distances.len() >= ROW && scatter < FLAT && (mean - fitting).abs() > MISFIT;
    told.then_some(mean)
}

/// Remarks on bodies whose rows are not a spacing apart where they touch, or not from a flat wall; `body_of` gives the body of a
/// particle's number.
pub fn remarks<const D: usize>(
    scene: &Scene,
    flow: &Flow<D>,
    body_of: &[u32],
) -> Result<Vec<String>, SolverError> {
    // Settled or far displaced particles stand on no lattice.
    if scene.numerics.relax.is_some() || scene.jitter() > OFF_LATTICE {
        return Ok(Vec::new());
    }
    let world = &flow.world;
    let position = world.free.get(fields::POSITION)?;
    let identity = world.free.get(fields::IDENTITY)?;
    let body = |k: usize| body_of[identity[k] as usize];
    let names: Vec<&String> = scene.body.keys().collect();
    let mut contacts: BTreeMap<[u32; 2], Vec<f64>> = BTreeMap::new();
    let mut at_walls: BTreeMap<(u32, String), Vec<f64>> = BTreeMap::new();
    let walls = flow.walls.as_deref();
    // Where the first row belongs, in spacings from the wall.
    let first = walls.as_ref().map_or(1.0, |w| 1.0 - w.lattice_offset());
    // A single body touches no other, and lists need not be there yet.
    let reach = CONTACT * world.spacing;
    let grid = (names.len() > 1).then(|| CellGrid::new(position, reach, &world.domain));
    for (k, x) in position.iter().enumerate() {
        let mut nearest: BTreeMap<u32, f64> = BTreeMap::new();
        let mut look = |j: usize| {
            if body(j) > body(k) {
                let apart = world.domain.nearest_image(x - position[j]).norm() / world.spacing;
                let least = nearest.entry(body(j)).or_insert(f64::INFINITY);
                *least = least.min(apart);
            }
        };
        if let Some(grid) = &grid {
            grid.ranges(x, reach, |range| {
                grid.order()[range].iter().for_each(|j| look(*j as usize));
            });
        }
        for (other, apart) in nearest.into_iter().filter(|(_, d)| *d < CONTACT) {
            contacts.entry([body(k), other]).or_default().push(apart);
        }
        let near = (first + CONTACT - 1.0) * world.spacing;
        if let Some((distance, name)) = walls.and_then(|w| w.clearance(x, near)) {
            let contact = at_walls.entry((body(k), name.to_string())).or_default();
            contact.push(distance / world.spacing);
        }
    }
    let mut remarks = Vec::new();
    for ([a, b], contact) in contacts {
        remarks.extend(misfit(&contact, 1.0).map(|apart| {
            format!(
                "the particles of `{}` and `{}` are {apart:.2} spacings apart where the bodies touch, and start currents: let the bodies start whole spacings from each other",
                names[a as usize], names[b as usize]
            )
        }));
    }
    for ((a, wall), contact) in at_walls {
        remarks.extend(misfit(&contact, first).map(|apart| {
            format!(
                "the first row of `{}` is {apart:.2} spacings from the wall `{wall}`, and {first} fit, which starts currents: let the body start whole spacings from the wall",
                names[a as usize]
            )
        }));
    }
    Ok(remarks)
}

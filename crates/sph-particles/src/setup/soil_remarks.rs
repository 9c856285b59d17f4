//! Remarks on the soils of a scene before they move.

use sph_core::place_cells::PlaceCells;
use sph_core::{Vect, comma_list, fields};
use sph_rheology::Rheology;
use sph_scene::Scene;
use sph_solver::{Flow, SolverError};

/// Spacings per grain above which a continuum of particles finer than its grains is remarked upon.
const COARSE_GRAINS: f64 = 10.0;
/// Distance in spacings under the lowest particles of a bed above which nothing carries them.
const GAP: f64 = 1.6;
/// Spacings by which a soil may stand over the water that is to fill its pores.
const DRY: f64 = 2.0;

/// Marks of phases whose law reads a pressure.
pub fn soils(rheologies: &[Box<dyn Rheology>]) -> Vec<bool> {
    let marks = rheologies.iter().map(|law| law.needs().pressure);
    marks.collect()
}

/// Remarks on soils that are finer than their grains, stand dry while their pores are taken as `saturated`, full of
/// water, or hang over a gap.
pub fn remarks<const D: usize>(
    scene: &Scene,
    flow: &Flow<D>,
    rheologies: &[Box<dyn Rheology>],
    saturated: bool,
) -> Result<Vec<String>, SolverError> {
    let spacing = flow.world.spacing;
    let mut remarks = Vec::new();
    for (name, law) in scene.phase.keys().zip(rheologies) {
        let ratio = law.grain_diameter().unwrap_or(0.0) / spacing;
        if ratio > COARSE_GRAINS {
            remarks.push(format!(
                "a grain of `{name}` is {ratio:.0} spacings wide: the law is that of many grains in every \
                 particle, best with one to three diameters per spacing, and erosion is too strong below"
            ));
        }
    }
    if flow.world.gravity.norm() > 0.0 {
        let free = &flow.world.free;
        let (position, phase) = (free.get(fields::POSITION)?, free.get(fields::PHASE).ok());
        let phase = (0..position.len()).map(|k| phase.map_or(0, |p| p[k] as usize));
        let phase: Vec<usize> = phase.collect();
        let particles = (position, &phase[..]);
        let soil = soils(rheologies);
        for (number, name) in scene.phase.keys().enumerate().filter(|(k, _)| soil[*k]) {
            if saturated {
                remarks.extend(dry((number, name), &soil, particles, flow));
            }
            remarks.extend(hanging((number, name), particles, flow));
        }
    }
    Ok(remarks)
}

/// A remark if a soil stands above the highest water.
fn dry<const D: usize>(
    (number, name): (usize, &str),
    soil: &[bool],
    (position, phase): Particles<'_, D>,
    flow: &Flow<D>,
) -> Option<String> {
    let up = -flow.world.gravity.normalize();
    let heights = || position.iter().map(|x| x.dot(&up)).zip(phase);
    let fluid = heights().filter(|(_, phase)| !soil[**phase]);
    let water = fluid.map(|(height, _)| height);
    let water = water.fold(f64::NEG_INFINITY, f64::max);
    let own = || heights().filter(|(_, phase)| **phase == number);
    let dry = |height: f64| height > water + DRY * flow.world.spacing;
    let (all, above) = (own().count(), own().filter(|(h, _)| dry(*h)).count());
    // A soil without any water beside it may stand for one under water that rests.
    (above > 0 && water.is_finite()).then(|| {
        format!(
            "{:.0} % of `{name}` stands above the highest water, at {water:.4} m, but \
             `effective-pressure` takes its pores as full of water: there it presses with its weight under water",
            100.0 * above as f64 / all as f64
        )
    })
}

/// Places of the particles, and the numbers of their phases.
type Particles<'a, const D: usize> = (&'a [Vect<D>], &'a [usize]);

/// A remark if the lowest particles of a bed have neither a wall nor a particle close beneath.
fn hanging<const D: usize>(
    (number, name): (usize, &str),
    (position, phase): Particles<'_, D>,
    flow: &Flow<D>,
) -> Option<String> {
    let (world, walls) = (&flow.world, flow.walls.as_ref()?);
    let up = -world.gravity.normalize();
    let reach = GAP * world.spacing;
    let places = position.iter().enumerate().map(|(k, x)| ((*x).into(), k));
    let cells = PlaceCells::new(reach, places);
    // A particle within reach, less than 60° from straight below.
    let beneath = |k: usize| {
        let x = &position[k];
        cells.around((*x).into()).any(|&j| {
            let apart = position[j] - x;
            j != k && apart.norm() <= reach && -apart.dot(&up) > 0.5 * apart.norm()
        })
    };
    let grains = (0..position.len()).filter(|k| phase[*k] == number);
    let hang = |k: &usize| walls.clearance(&position[*k], reach).is_none() && !beneath(*k);
    let hanging: Vec<usize> = grains.filter(hang).collect();
    hanging.first().map(|k| {
        let place = comma_list(position[*k].iter().map(|x| format!("{x:.4}")));
        format!(
            "{} particles of `{name}` have neither a wall nor a fluid beneath them, one of them at ({place}): the bed will fall",
            hanging.len()
        )
    })
}

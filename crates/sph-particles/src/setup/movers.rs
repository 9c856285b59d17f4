//! Preparation of movers with the scene and their walls.

use std::sync::Arc;

use sph_boundary::{Mover, MoverSetting};
use sph_core::SceneProblem;
use sph_rheology::state::Laws;
use sph_scene::Scene;
use sph_solver::SolverError;
use sph_solver::setup::Choices;

use crate::setup::shapes::Drawn;

/// Gives every mover the scene, and every wall its mover; takes the movers out of the choices.
pub fn prepare<const D: usize>(
    scene: &Scene,
    drawn: &mut Drawn<D>,
    choices: &mut Choices<D>,
    laws: &Laws,
) -> Result<(), SolverError> {
    let references = || laws.iter().map(|law| law.reference());
    let densities = || references().map(|r| r.density);
    let walls = choices.walls.as_ref();
    let flush = walls.is_some_and(|walls| walls.lattice_offset() > 0.0);
    let walls: Vec<_> = drawn.walls.iter().map(|w| &w.drawing).collect();
    let fluid: Vec<_> = drawn.regions.iter().map(|region| region.bounds()).collect();
    let mut problems = Vec::new();
    let mut settled = Vec::<(String, Arc<dyn Mover<D>>)>::new();
    for (wall, mut mover) in std::mem::take(&mut choices.movers) {
        let setting = MoverSetting {
            wall: &wall,
            walls: &walls,
            spacing: scene.numerics.spacing,
            fluid: &fluid,
            smoothing_length: scene.numerics.smoothing_ratio * scene.numerics.spacing,
            densities: [
                densities().fold(f64::INFINITY, f64::min),
                densities().fold(0.0, f64::max),
            ],
            sound_speed: references().map(|r| r.sound_speed).fold(0.0, f64::max),
            gravity: scene.gravity::<D>(),
            flush,
        };
        if let Err(refusal) = mover.prepare(&setting) {
            let path = scene
                .choice_in("mover", &wall)
                .map(|c| c.inside(&refusal.key));
            problems.push(SceneProblem::new(path.unwrap_or_default(), refusal.why));
        }
        settled.push((wall, Arc::from(mover)));
    }
    SolverError::refuse(problems)?;
    for spec in &mut drawn.walls {
        let of_it = |(name, _): &&(String, _)| name == spec.drawing.name();
        spec.mover = settled.iter().find(of_it).map(|(_, m)| m.clone());
    }
    Ok(())
}

/// True if the fluid moves with its walls: every wall has a prescribed motion, or no wall acts against gravity.
pub fn carried(scene: &Scene) -> bool {
    let mut walls = scene.wall.values();
    match scene.wall.is_empty() {
        true => scene.numerics.gravity.iter().flatten().any(|g| *g != 0.0),
        false => walls.all(|wall| wall.motion.is_some()),
    }
}

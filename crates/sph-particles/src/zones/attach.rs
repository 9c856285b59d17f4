//! The zones of a scene, each assembled as a scene of its own.

use sph_scene::{Scene, Zone};
use sph_solver::SolverError;

use super::coupling::{Coupling, Level, Stepper};
use super::frame::Frame;
use super::guard::Guard;
use super::refusals::{refuse, refuse_places};
use super::scene_of_zone::scene_of_zone;
use crate::setup::{Assembled, assemble};

/// The zones of an assembled scene.
///
/// # Errors
/// A zone that does not fit its surroundings, or a scene that cannot have zones.
pub(crate) fn attach<const D: usize>(
    scene: &Scene,
    parts: &Assembled<D>,
) -> Result<Coupling<D>, SolverError> {
    if !scene.zone.is_empty() {
        refuse_places::<D>(scene, parts)?;
    }
    coupling(scene, parts, None, 0)
}

fn coupling<const D: usize>(
    scene: &Scene,
    parts: &Assembled<D>,
    guard: Option<Guard<D>>,
    depth: usize,
) -> Result<Coupling<D>, SolverError> {
    let zones = scene.zone.iter().filter(|(_, zone)| zone.ratio == 0.5);
    let levels = zones.map(|(name, zone)| level(scene, parts, (name, zone), depth));
    Ok(Coupling::new(
        parts.diffused,
        guard,
        levels.collect::<Result<_, _>>()?,
    ))
}

/// A zone in an assembled scene, which is `depth` levels below the coarsest.
fn level<const D: usize>(
    scene: &Scene,
    around: &Assembled<D>,
    (name, zone): (&String, &Zone),
    depth: usize,
) -> Result<Level<D>, SolverError> {
    let support = 0.5 * around.flow.world.kernel.support_radius();
    let frame = Frame::new(scene, zone, support);
    let frame = frame.with_core(around.flow.walls.as_deref(), scene.numerics.spacing);
    let finer = scene_of_zone((scene, &around.flow.world), (name, zone), &frame);
    let mut parts = assemble::<D>(&finer)?;
    // Those of zones within it were assembled too, for their own scenes.
    parts
        .probes
        .retain(|(probe, _)| zone.probes.contains(probe));
    refuse(name, &parts)?;
    let guard = Guard::new(frame.clone(), scene.numerics.spacing);
    let coupling = coupling(&finer, &parts, Some(guard), depth + 1)?;
    let stepper = Stepper::from_parts(&finer, parts, coupling);
    Ok(Level::new(name, frame, stepper, depth))
}

//! The zones of a scene, each assembled as a scene of its own.

use std::collections::BTreeMap;

use sph_core::{Vect, fields};
use sph_neighbours::World;
use sph_scene::{Output, Scene, Zone};
use sph_solver::SolverError;

use super::coupling::{Coupling, Level, Stepper};
use super::frame::Frame;
use super::guard::Guard;
use super::refusals::{refuse, refuse_places, scalars};
use crate::setup::{Assembled, assemble, box_around};

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
    let levels = levels.collect::<Result<_, _>>()?;
    Ok(Coupling::new(parts, guard, levels))
}

/// A zone in an assembled scene, which is `depth` levels below the coarsest.
fn level<const D: usize>(
    scene: &Scene,
    around: &Assembled<D>,
    (name, zone): (&String, &Zone),
    depth: usize,
) -> Result<Level<D>, SolverError> {
    let support = 0.5 * around.flow.world.kernel.support_radius();
    let shapeless = || SolverError::at(format!("zone.{name}"), "it has no shape");
    let frame = Frame::new(scene, zone, support).ok_or_else(shapeless)?;
    let frame = frame.with_core(around.flow.walls.as_deref(), scene.numerics.spacing);
    let finer = scene_of_zone((scene, &around.flow.world), (name, zone), &frame);
    let mut parts = assemble::<D>(&finer)?;
    // Those of zones within it were assembled too, for their own scenes.
    let own = |probe: &String| zone.probes.contains(probe);
    parts.probes.retain(|(probe, _)| own(probe));
    // The window of the scene is the box around the shape.
    let beyond = |x: &Vect<D>| !frame.holds(x, frame.band);
    let position = parts.flow.world.free.get(fields::POSITION)?;
    let beyond: Vec<bool> = position.iter().map(beyond).collect();
    if beyond.contains(&true) {
        parts.flow.world.free.take_out(&beyond);
    }
    refuse(name, &parts)?;
    let guard = Guard::new(frame.clone(), scene.numerics.spacing, scalars(&parts.flow));
    let coupling = coupling(&finer, &parts, Some(guard), depth + 1)?;
    let stepper = Stepper::from_parts(&finer, parts, coupling);
    Ok(Level::new(name, frame, stepper, depth))
}

/// The scene of a zone in a flow around it.
pub(crate) fn scene_of_zone<const D: usize>(
    (scene, around): (&Scene, &World<D>),
    (name, zone): (&str, &Zone),
    frame: &Frame<D>,
) -> Scene {
    let mut finer = scene.clone();
    finer.numerics.spacing *= 0.5;
    let far = walls_out_of_reach(scene, around, frame);
    finer.wall.retain(|wall, _| !far.contains(wall));
    let window = frame.corners(frame.band);
    finer.window = Some(window.map(|corner| corner.iter().copied().collect()));
    finer.zone = nested(scene, name);
    // Particles relax by themselves in no box of their own.
    finer.numerics.relax = None;
    let inner = finer.zone.values().flat_map(|inner| &inner.probes);
    let probes: Vec<String> = zone.probes.iter().chain(inner).cloned().collect();
    let measured = |probe: &String| probes.contains(probe);
    finer.probe.retain(|probe, _| measured(probe));
    finer.gauge.retain(|probe, _| measured(probe));
    finer.reference.clear();
    finer.output = Output {
        fields: scene.output.fields.clone(),
        picture: scene.output.picture.clone(),
        ..Output::default()
    };
    finer
}

/// Names of the walls that no particle of a zone can ever see. Where walls bound a body, or eddies depend on their
/// distance, all stay.
fn walls_out_of_reach<const D: usize>(
    scene: &Scene,
    around: &World<D>,
    frame: &Frame<D>,
) -> Vec<String> {
    let filled = scene.body.values().any(|body| body.fill.is_some());
    let measured = ["eddy-viscosity", "wall-function"].map(|kind| scene.choice(kind).is_some());
    if frame.carrier().is_some() || filled || measured.contains(&true) {
        return Vec::new();
    }
    let [low, high] = frame.corners(frame.band + around.kernel.support_radius());
    let walls = &around.walls;
    let far = |number: usize| {
        let all = walls.points.position.iter().zip(&walls.points.wall);
        let own = all.filter(|(_, wall)| **wall as usize == number);
        let [from, to] = box_around(own.map(|(x, _)| x));
        (0..D).any(|k| to[k] < low[k] || from[k] > high[k])
    };
    let names = walls.names.iter().enumerate();
    let stays = |name: &String| {
        let wall = scene.wall.get(name);
        wall.is_some_and(|wall| wall.motion.is_none() && wall.mover.is_empty())
    };
    let names = names.filter(|(number, name)| stays(name) && far(*number));
    names.map(|(_, name)| name.clone()).collect()
}

/// The zones within a zone, with ratios to its spacing.
fn nested(scene: &Scene, name: &str) -> BTreeMap<String, Zone> {
    let inside = |other: &Zone| other.ratio < scene.zone[name].ratio && within(scene, other, name);
    let mut zones = scene.zone.clone();
    zones.retain(|_, other| inside(other));
    zones.values_mut().for_each(|other| other.ratio *= 2.0);
    zones
}

/// True if a zone lies in the zone `name`, with any number of zones between.
fn within(scene: &Scene, zone: &Zone, name: &str) -> bool {
    match scene.around_zone(zone) {
        Some(around) => around == name || within(scene, &scene.zone[around], name),
        None => false,
    }
}

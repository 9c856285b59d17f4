//! The scene of a zone: that of the flow around it, with finer particles in a box.

use std::collections::BTreeMap;

use sph_core::Vect;
use sph_neighbours::World;
use sph_scene::{Output, Scene, Zone};

use super::frame::Frame;

/// The scene of a zone whose box is `frame`, in a flow around it.
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

/// Names of the walls that no particle of a zone can see. Where walls bound a body all stay.
fn walls_out_of_reach<const D: usize>(
    scene: &Scene,
    around: &World<D>,
    frame: &Frame<D>,
) -> Vec<String> {
    if scene.body.values().any(|body| body.fill.is_some()) {
        return Vec::new();
    }
    let [low, high] = frame.corners(frame.band + around.kernel.support_radius());
    let walls = &around.walls;
    let far = |number: usize| {
        let all = walls.points.position.iter().zip(&walls.points.wall);
        let own = all.filter(|(_, wall)| **wall as usize == number);
        let nothing: [Vect<D>; 2] = [f64::INFINITY, f64::NEG_INFINITY].map(Vect::repeat);
        let [from, to] = own.fold(nothing, |[from, to], (x, _)| [from.inf(x), to.sup(x)]);
        (0..D).any(|k| to[k] < low[k] || from[k] > high[k])
    };
    let names = walls.names.iter().enumerate();
    names
        .filter(|(number, name)| scene.wall.contains_key(*name) && far(*number))
        .map(|(_, name)| name.clone())
        .collect()
}

/// The zones within a zone, with ratios to its spacing.
fn nested(scene: &Scene, name: &str) -> BTreeMap<String, Zone> {
    let inside = |other: &Zone| other.ratio < scene.zone[name].ratio && within(scene, other, name);
    let zones = scene.zone.iter().filter(|(_, other)| inside(other));
    zones
        .map(|(inner, other)| {
            let ratio = 2.0 * other.ratio;
            (
                inner.clone(),
                Zone {
                    ratio,
                    ..other.clone()
                },
            )
        })
        .collect()
}

/// True if a zone lies in the zone `name`, with any number of zones between.
fn within(scene: &Scene, zone: &Zone, name: &str) -> bool {
    match scene.around_zone(zone) {
        Some(around) => around == name || within(scene, &scene.zone[around], name),
        None => false,
    }
}

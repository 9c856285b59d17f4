//! Conditions beyond the schema of a scene: names that must exist, tables that exclude each other.

mod measurements;
mod start;
mod walls;

use scene_text::{Problems, SceneProblem, Source, named_files, suggestion};
use toml::Table;

use crate::scene::error::DemError;
use crate::scene::laws::{Laws, throats};
use crate::scene::names::BOX;
use crate::scene::tables::Scene;

/// Everything that is wrong.
pub fn scene(scene: &Scene, table: &Table, source: &Source) -> Vec<SceneProblem> {
    let mut found = Problems::default();
    for problems in [Laws::from_scene(scene).err(), throats(scene).err()]
        .into_iter()
        .flatten()
    {
        if let DemError::Scene(problems) = problems {
            found.0.extend(problems);
        }
    }
    start::start(scene, &mut found);
    start::boxed(scene, &mut found);
    for (name, wall) in &scene.wall {
        walls::wall(scene, name, wall, &mut found);
    }
    fluid(scene, &mut found);
    oedometer(scene, &mut found);
    for (name, probe) in &scene.probe {
        measurements::probe(scene, name, probe, &mut found);
    }
    for (name, reference) in &scene.reference {
        measurements::reference(scene, name, reference, &mut found);
    }
    for (key, file) in named_files(table) {
        if let Err(problem) = source.resolve(&key, &file) {
            found.add(key, problem.to_string());
        }
    }
    output(scene, &mut found);
    found.0
}

fn fluid(scene: &Scene, found: &mut Problems) {
    let Some(fluid) = &scene.fluid else { return };
    let Some(given) = &scene.r#box else {
        return found.add("fluid", "the fluid fills a box: `[box]` is missing");
    };
    if let Some(axis) = given.periodic.first() {
        let message = format!("the fluid needs six walls, and the box is periodic along {axis:?}");
        found.add("box.periodic", message.to_lowercase());
    }
    if !given.open.is_empty() {
        found.add(
            "box.open",
            "the fluid needs six walls: give a wall a `pressure` instead",
        );
    }
    for (name, wall) in &scene.wall {
        if !BOX.contains(&name.as_str()) {
            found.add(
                format!("wall.{name}"),
                "the fluid has the six walls of the box alone",
            );
        }
        if wall.removed {
            found.add(format!("wall.{name}.removed"), "the fluid needs six walls");
        }
    }
    let pressed = scene
        .wall
        .values()
        .any(|w| w.pressure.is_some() || w.wave.is_some() || w.recorded.is_some());
    if !pressed && fluid.given.bulk_modulus.is_none() {
        let message = "no wall has a `pressure`, a `wave` or what was `recorded`: pressures would be known but for a constant; give one, \
                       or a `bulk_modulus`";
        found.add("fluid", message);
    }
}

fn oedometer(scene: &Scene, found: &mut Problems) {
    let Some(test) = &scene.oedometer else { return };
    let wall = scene.wall.get(&test.wall);
    match wall.and_then(|w| w.piston.as_ref()) {
        None => {
            let pistons = scene.wall.iter().filter(|(_, w)| w.piston.is_some());
            let near = suggestion(&test.wall, pistons.map(|(n, _)| n.as_str()));
            found.add(
                "oedometer.wall",
                format!("there is no piston `{}`{near}", test.wall),
            );
        }
        Some(piston) if piston.prepared.is_none() => {
            let message = "`prepared` is missing: the load is the step from it to `stress`";
            found.add(format!("wall.{}.piston", test.wall), message);
        }
        Some(_) => {}
    }
    if scene.fluid.is_none() {
        found.add("oedometer", "needs a `[fluid]`");
    }
    if scene.start.settle.is_none_or(|tolerance| tolerance >= 1.0) {
        found.add(
            "start",
            "an oedometer test starts from rest: give `settle` below 1",
        );
    }
}

fn output(scene: &Scene, found: &mut Problems) {
    if let Some(colours) = &scene.output.picture_range {
        found.0.extend(colours.falling("output.picture_range"));
    }
    let wet = scene.fluid.is_some();
    let names = || crate::scene::fields::names(wet);
    let pictures = scene.output.picture.iter().enumerate();
    let pictures = pictures.map(|(k, field)| (format!("output.picture[{k}]"), field));
    let coloured = scene.output.picture_range.iter().flat_map(|r| r.fields());
    let coloured = coloured.map(|field| (format!("output.picture_range.{field}"), field));
    for (path, field) in pictures.chain(coloured) {
        if !names().any(|n| n == field) {
            let near = suggestion(field, names());
            let known = names().collect::<Vec<_>>().join(", ");
            let message = format!("there is no field `{field}`{near} (there are: {known})");
            found.add(path, message);
        }
    }
}

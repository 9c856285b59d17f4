//! Conditions beyond the schema of a scene: names that must exist, tables that exclude each other.

mod start;

use scene_text::{Problems, SceneProblem, Source, named_files, suggestion};
use toml::Table;

use crate::scene::error::DemError;
use crate::scene::fields;
use crate::scene::laws::{Laws, throats};
use crate::scene::tables::{Axis, Probe, Reference, Scene};
use crate::scene::{BOX, planes};

/// Everything that is wrong.
pub fn scene(scene: &Scene, table: &Table, source: &Source) -> Vec<SceneProblem> {
    let mut found = Problems::default();
    let laws = [Laws::from_scene(scene).err(), throats(scene).err()];
    for error in laws.into_iter().flatten() {
        if let DemError::Scene(problems) = error {
            found.0.extend(problems);
        }
    }
    start::start(scene, &mut found);
    start::boxed(scene, &mut found);
    for (name, wall) in &scene.wall {
        start::wall(scene, name, wall, &mut found);
    }
    fluid(scene, &mut found);
    oedometer(scene, &mut found);
    for (name, of) in &scene.probe {
        probe(scene, name, of, &mut found);
    }
    for (name, of) in &scene.reference {
        reference(scene, name, of, &mut found);
    }
    for (key, file) in named_files(table) {
        if let Err(problem) = source.resolve(&key, &file) {
            found.add(key, problem.to_string());
        }
    }
    output(scene, &mut found);
    found.0
}

/// Adds what is wrong of some rules: whether it is, the key below `path`, and the message.
fn refuse<const N: usize>(found: &mut Problems, path: &str, rules: [(bool, &str, &str); N]) {
    for (_, key, message) in rules.into_iter().filter(|(wrong, ..)| *wrong) {
        let names = [path, key].into_iter().filter(|name| !name.is_empty());
        found.add(names.collect::<Vec<_>>().join("."), message);
    }
}

/// The message where a name is not among those that there are.
fn unknown(what: &str, name: &str, names: &[&str]) -> Option<String> {
    let near = || suggestion(name, names.iter().copied());
    let known = names.contains(&name);
    (!known).then(|| format!("there is no {what} `{name}`{}", near()))
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
    let open = "the fluid needs six walls: give a wall a `pressure` instead";
    refuse(found, "box", [(!given.open.is_empty(), "open", open)]);
    for (name, wall) in &scene.wall {
        let further = !BOX.contains(&name.as_str());
        let rules = [
            (further, "", "the fluid has the six walls of the box alone"),
            (wall.removed, "removed", "the fluid needs six walls"),
        ];
        refuse(found, &format!("wall.{name}"), rules);
    }
    let mut walls = scene.wall.values();
    let pressed = walls.any(|w| w.pressure.is_some() || w.wave.is_some() || w.recorded.is_some());
    let floats = !pressed && fluid.given.bulk_modulus.is_none();
    let message = "no wall has a `pressure`, a `wave` or a `recorded` pressure: pressures would be known but for a constant; give one, \
                   or a `bulk_modulus`";
    refuse(found, "fluid", [(floats, "", message)]);
}

fn oedometer(scene: &Scene, found: &mut Problems) {
    let Some(test) = &scene.oedometer else { return };
    let pistons = scene.wall.iter().filter(|(_, w)| w.piston.is_some());
    let pistons: Vec<_> = pistons.map(|(name, _)| name.as_str()).collect();
    if let Some(message) = unknown("piston", &test.wall, &pistons) {
        found.add("oedometer.wall", message);
    }
    let wall = scene.wall.get(&test.wall);
    let piston = wall.and_then(|w| w.piston.as_ref());
    let unprepared = piston.is_some_and(|p| p.prepared.is_none());
    let message = "`prepared` is missing: the load is the step from it to `stress`";
    let path = format!("wall.{}.piston", test.wall);
    let moves = scene.start.settle.is_none_or(|tolerance| tolerance >= 1.0);
    let rest = "an oedometer test starts from rest: give `settle` below 1";
    let dry = scene.fluid.is_none();
    let rules = [
        (unprepared, path.as_str(), message),
        (dry, "oedometer", "needs a `[fluid]`"),
        (moves, "start", rest),
    ];
    refuse(found, "", rules);
}

fn output(scene: &Scene, found: &mut Problems) {
    if let Some(colours) = &scene.output.picture_range {
        found.0.extend(colours.falling("output.picture_range"));
    }
    let names: Vec<_> = fields::names(scene.fluid.is_some()).collect();
    let pictures = scene.output.picture.iter().enumerate();
    let pictures = pictures.map(|(k, field)| (format!("output.picture[{k}]"), field));
    let coloured = scene.output.picture_range.iter().flat_map(|r| r.fields());
    let coloured = coloured.map(|field| (format!("output.picture_range.{field}"), field));
    for (path, field) in pictures.chain(coloured) {
        if let Some(message) = unknown("field", field, &names) {
            found.add(path, format!("{message} (there are: {})", names.join(", ")));
        }
    }
}

/// Mistakes of a probe.
fn probe(scene: &Scene, name: &str, probe: &Probe, found: &mut Problems) {
    use Probe::*;
    let path = format!("probe.{name}");
    let dry = scene.fluid.is_none();
    let closed = scene.r#box.as_ref().is_some_and(|b| b.open.is_empty());
    let flows = matches!(probe, Flux { .. } | Carried {} | Pressure { .. })
        || matches!(probe, Gradient { .. } | Permeability { .. });
    let boxed = matches!(probe, Strain { .. } | VolumetricStrain {} | Deviator { .. })
        || matches!(
            probe,
            MeanStress {} | EffectiveStress { .. } | Porosity { .. }
        );
    if let Stress { wall } | Borne { wall } | Flux { wall } | Amplitude { wall } = probe {
        let names = planes(scene);
        let names: Vec<_> = names.iter().map(String::as_str).collect();
        let waves = scene.wall.get(wall).is_some_and(|w| w.wave.is_some());
        let still = matches!(probe, Amplitude { .. }) && !waves;
        let still = still.then(|| format!("there is no wave on `{wall}`"));
        for message in unknown("wall", wall, &names).into_iter().chain(still) {
            found.add(format!("{path}.wall"), message);
        }
    }
    let tests = matches!(probe, Consolidation {}) && scene.oedometer.is_none();
    let levels = matches!(probe, Level { .. });
    let upwards = matches!(probe, Level { axis: Axis::Z, .. });
    let no_box = scene.r#box.is_none();
    let rules = [
        (flows && dry, "kind", "needs a `[fluid]`"),
        (tests, "kind", "needs an `[oedometer]`"),
        (boxed && !closed, "kind", "needs a closed `[box]`"),
        (levels && no_box, "kind", "needs a `[box]`"),
        (upwards && !no_box, "axis", "must be x or y"),
    ];
    refuse(found, &path, rules);
    if let Some((_, [from, to])) = probe.layer()
        && from >= to
    {
        let message = format!("must be above `from`: {to} m is not above {from} m");
        found.add(format!("{path}.to"), message);
    }
}

/// Mistakes of a reference.
fn reference(scene: &Scene, name: &str, reference: &Reference, found: &mut Problems) {
    let path = format!("reference.{name}");
    let names: Vec<_> = scene.probe.keys().map(String::as_str).collect();
    let mut known = |key: &str, probe: &str| {
        if let Some(message) = unknown("probe", probe, &names) {
            found.add(format!("{path}.{key}"), message);
        }
    };
    if let Reference::Line { along, .. } = reference {
        known("along", along);
    }
    let probe = reference.probe();
    known("probe", probe);
    let tests = matches!(reference, Reference::Terzaghi { .. }) && scene.oedometer.is_none();
    let runs_out = matches!(scene.probe.get(probe), Some(Probe::RunOut { .. }) | None);
    let scales = matches!(reference, Reference::Scaling { .. }) && !runs_out;
    let rules = [
        (tests, "kind", "needs an `[oedometer]`"),
        (scales, "probe", "a probe of the kind `run-out` is needed"),
    ];
    refuse(found, &path, rules);
}

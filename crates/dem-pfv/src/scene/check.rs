//! Conditions beyond the schema of a scene: names that must exist, tables that exclude each other.

use scene_text::{Problems, SceneProblem, Source, given, named_files, suggestion, unit_factor};
use toml::Table;

use crate::scene::{
    Axis, BOX, Cloud, DemError, Grown, Laws, Piston, Probe, Reference, Scene, Wall, Weight, names,
    throats,
};

/// Everything that is wrong.
pub fn scene(scene: &Scene, table: &Table, source: &Source) -> Vec<SceneProblem> {
    let mut found = Problems::default();
    let laws = [Laws::from_scene(scene).err(), throats(scene).err()];
    for error in laws.into_iter().flatten() {
        if let DemError::Scene(problems) = error {
            found.0.extend(problems);
        }
    }
    start(scene, &mut found);
    boxed(scene, &mut found);
    for (name, wall) in &scene.wall {
        self::wall(scene, name, wall, &mut found);
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
    let names: Vec<_> = names(scene.fluid.is_some()).collect();
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
        let names = scene.planes();
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

/// Mistakes of the start: more than one way, or none.
fn start(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let given = given([
        ("cloud", s.cloud.is_some()),
        ("grown", s.grown.is_some()),
        ("rained", s.rained.is_some()),
        ("lattice", s.lattice.is_some()),
        ("file", s.file.is_some()),
    ]);
    let none = "one of `cloud`, `grown`, `rained`, `lattice`, `file` is missing";
    refuse(found, "start", [(given.is_empty(), "", none)]);
    found.at_most_one(&given, "start");
    numbers_and_sizes(scene, found);
    room(scene, found);
    weight(scene, found);
}

/// Number and sizes of the grains, unless the start has them.
fn numbers_and_sizes(scene: &Scene, found: &mut Problems) {
    let (s, grains) = (&scene.start, &scene.grains);
    let by_height = s.rained.as_ref().is_some_and(|r| r.height.is_some());
    let counted = (s.cloud.is_some() || s.grown.is_some() || s.rained.is_some()) && !by_height;
    let (count, radius, file) = (grains.count, grains.radius, s.file.is_some());
    let unit = s.unit.is_some() && !file;
    let given = "the start gives the number of grains: leave it out";
    let of_file = "this is the unit of the numbers in a `file`";
    let missing = "`radius` is missing: the smallest and the largest";
    let twice = "the file has the radii: leave it out";
    let targets = |g: &Grown| g.stress.is_some() == g.porosity.is_some();
    let targets = s.grown.as_ref().is_some_and(targets);
    let target = "either `stress` or `porosity` is needed";
    let [low, high] = radius.filter(|_| !file).unwrap_or([1.0; 2]);
    let least = format!("must be more than 0 m, found {low}");
    let order = format!("{low} m to {high} m: the smallest comes first");
    let rules = [
        (counted && count.is_none(), "grains", "`count` is missing"),
        (!counted && count.is_some(), "grains.count", given),
        (unit, "start.unit", of_file),
        (!file && radius.is_none(), "grains", missing),
        (file && radius.is_some(), "grains.radius", twice),
        (low <= 0.0, "grains.radius", &least),
        (low > 0.0 && low > high, "grains.radius", &order),
        (targets, "start.grown", target),
    ];
    refuse(found, "", rules);
}

/// The room that the grains start in.
fn room(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let needs_box = s.grown.is_some() || s.rained.is_some() || s.lattice.is_some();
    let inside = |c: &Cloud| c.low.is_none() || c.high.is_none();
    let within = s.cloud.as_ref().is_some_and(inside);
    let no_box = scene.r#box.is_none() && (needs_box || within);
    let lowered = s.headroom.is_some();
    let no_top = lowered && !scene.planes().iter().any(|p| p == "top");
    let loose = lowered && s.settle.is_none() && s.rained.is_none();
    let rest = "the grains must come to rest first: give `settle`";
    let rules = [
        (no_box, "", "these grains fill a box: `[box]` is missing"),
        (no_top, "headroom", "there is no wall `top` to be moved"),
        (loose, "headroom", rest),
    ];
    refuse(found, "start", rules);
}

/// Conditions of a bed that is flooded.
fn weight(scene: &Scene, found: &mut Problems) {
    let s = &scene.start;
    let rained = s.rained.is_some();
    let settles = s.settle.map_or(rained, |tolerance| tolerance < 1.0);
    let missing = given([
        ("a `[fluid]`", scene.fluid.is_none()),
        ("`grains.gravity`", scene.grains.gravity.is_none()),
        ("`settle` below 1", !settles),
    ]);
    if let (Weight::Dry, [what, ..]) = (s.weight, missing.as_slice()) {
        let message = format!("a dry bed is flooded once it rests: {what} is missing");
        found.add("start.weight", message);
    }
}

/// Mistakes of the box.
fn boxed(scene: &Scene, found: &mut Problems) {
    let Some(given) = &scene.r#box else { return };
    for (axis, (low, high)) in given.low.iter().zip(&given.high).enumerate() {
        if low >= high {
            let message = format!("must be above the lower corner: {high} m is not above {low} m");
            found.add(format!("box.high[{axis}]"), message);
        }
    }
    for (k, name) in given.open.iter().enumerate() {
        if !BOX.contains(&name.as_str()) {
            let (near, all) = (suggestion(name, BOX), BOX.join(", "));
            let message = format!("there is no wall `{name}` of a box{near} (there are: {all})");
            found.add(format!("box.open[{k}]"), message);
        }
    }
}

/// Mistakes of a wall.
fn wall(scene: &Scene, name: &str, wall: &Wall, found: &mut Problems) {
    let path = format!("wall.{name}");
    place(scene, name, wall, &path, found);
    of_file(wall, &path, found);
    motions(scene, wall, &path, found);
    conditions(scene, wall, &path, found);
}

fn place(scene: &Scene, name: &str, wall: &Wall, path: &str, found: &mut Problems) {
    let (file, normal) = (wall.file.is_some(), wall.normal.is_some());
    let Some(number) = BOX.iter().position(|b| *b == name) else {
        let near = suggestion(name, BOX);
        let placed =
            "a plane needs `point` and `normal`, a surface a `file`; it is no wall of the box";
        let nowhere = !file && (wall.point.is_none() || !normal);
        let flat = !file && wall.normal.is_some_and(|n| n.iter().all(|x| *x == 0.0));
        let curved = "a surface from a file has no normal";
        let rules = [
            (file && normal, "normal", curved),
            (nowhere, "", &format!("{placed}{near}")),
            (flat, "normal", "has no direction"),
        ];
        return refuse(found, path, rules);
    };
    let fixed = "a wall of the box has its place from `[box]`";
    let no_box = scene.r#box.is_none();
    let periodic = scene.periodic(number / 2);
    let mut open = scene.r#box.iter().flat_map(|b| &b.open);
    let open = !periodic && open.any(|o| o == name);
    let repeats = "there is no such wall: the box is periodic there";
    let rules = [
        (wall.point.is_some(), "point", fixed),
        (normal, "normal", fixed),
        (file, "file", fixed),
        (wall.spin.is_some(), "spin", fixed),
        (no_box, "", "there is no such wall: there is no `[box]`"),
        (periodic, "", repeats),
        (open, "", "there is no such wall: the box is open there"),
    ];
    refuse(found, path, rules);
}

/// Keys of a surface from a file.
fn of_file(wall: &Wall, path: &str, found: &mut Problems) {
    let (unit, scale) = (wall.unit.is_some(), wall.scale.is_some());
    let no_file = wall.file.is_none();
    let message = "this belongs to a surface from a `file`";
    let both = "the coordinates have a `unit` or a `scale`, not both";
    let why = wall.unit.as_deref().map(|unit| unit_factor(unit, "m"));
    let why = why.and_then(Result::err);
    let rules = [
        (no_file && unit, "unit", message),
        (no_file && scale, "scale", message),
        (no_file && wall.translate.is_some(), "translate", message),
        (unit && scale, "unit", both),
        (why.is_some(), "unit", why.as_deref().unwrap_or_default()),
    ];
    refuse(found, path, rules);
}

fn motions(scene: &Scene, wall: &Wall, path: &str, found: &mut Problems) {
    let given = given([
        ("velocity", wall.velocity.is_some()),
        ("piston", wall.piston.is_some()),
        ("servo", wall.servo.is_some()),
        ("strain_rate", wall.strain_rate.is_some()),
        ("removed", wall.removed),
        ("keeps_volume", wall.keeps_volume),
    ]);
    found.at_most_one(&given, path);
    let steered = wall.file.is_some() && given.iter().any(|g| *g != "velocity");
    let closed = scene.r#box.as_ref().is_some_and(|b| b.open.is_empty());
    let others = || scene.planes().iter().any(|p| !BOX.contains(&p.as_str()));
    let no_volume = wall.keeps_volume && (!closed || others());
    let volume = "the volume is that of a closed `[box]` without further planes";
    let swings = |p: &Piston| p.amplitude != 0.0 && p.period.is_none();
    let swings = wall.piston.as_ref().is_some_and(swings);
    let rules = [
        (steered, "", "a surface moves by `velocity` and `spin` only"),
        (no_volume, "keeps_volume", volume),
        (swings, "piston", "a stress that swings needs a `period`"),
    ];
    refuse(found, path, rules);
}

fn conditions(scene: &Scene, wall: &Wall, path: &str, found: &mut Problems) {
    let sides = given([
        ("pressure", wall.pressure.is_some()),
        ("inflow", wall.inflow.is_some()),
        ("wave", wall.wave.is_some()),
        ("recorded", wall.recorded.is_some()),
    ]);
    found.at_most_one(&sides, path);
    let dry = scene.fluid.is_none() && (!sides.is_empty() || wall.sticks);
    let message = "conditions of the fluid need a `[fluid]`";
    refuse(found, path, [(dry, "", message)]);
}

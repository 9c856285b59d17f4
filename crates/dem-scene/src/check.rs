//! What a schema cannot say of a scene: names that must exist, tables that exclude each other.

use std::collections::BTreeMap;

use scene_text::{SceneProblem, Source, suggestion};

use crate::error::DemError;
use crate::laws::{Laws, throats};
use crate::names::{BOX, periodic, planes};
use crate::tables::{Probe, Reference, Scene, Wall};

/// Everything that is wrong.
pub fn scene(
    scene: &Scene,
    probes: &BTreeMap<String, Probe>,
    references: &BTreeMap<String, Reference>,
    source: &Source,
) -> Vec<SceneProblem> {
    let mut found = Vec::new();
    for problems in [Laws::of(scene).err(), throats(scene).err()]
        .into_iter()
        .flatten()
    {
        if let DemError::Scene(problems) = problems {
            found.extend(problems);
        }
    }
    start(scene, &mut found);
    boxed(scene, &mut found);
    for (name, wall) in &scene.wall {
        one_wall(scene, name, wall, &mut found);
    }
    fluid(scene, &mut found);
    oedometer(scene, &mut found);
    for (name, probe) in probes {
        one_probe(scene, name, probe, &mut found);
    }
    for (name, reference) in references {
        one_reference(scene, probes, name, reference, &mut found);
    }
    files(scene, references, source, &mut found);
    output(scene, &mut found);
    found
}

fn add(found: &mut Vec<SceneProblem>, path: impl Into<String>, message: impl Into<String>) {
    found.push(SceneProblem::new(path, message));
}

fn start(scene: &Scene, found: &mut Vec<SceneProblem>) {
    let s = &scene.start;
    let ways = [
        ("cloud", s.cloud.is_some()),
        ("grown", s.grown.is_some()),
        ("rained", s.rained.is_some()),
        ("lattice", s.lattice.is_some()),
        ("file", s.file.is_some()),
    ];
    let given: Vec<_> = ways
        .iter()
        .filter(|(_, given)| *given)
        .map(|(n, _)| *n)
        .collect();
    match given.as_slice() {
        [] => add(
            found,
            "start",
            "one of `cloud`, `grown`, `rained`, `lattice`, `file` is missing",
        ),
        [_] => {}
        [.., last] => {
            let told = given.join("`, `");
            add(
                found,
                format!("start.{last}"),
                format!("only one of `{told}` can be given"),
            );
        }
    }
    let by_height = s.rained.as_ref().is_some_and(|r| r.height.is_some());
    let counted = (s.cloud.is_some() || s.grown.is_some() || s.rained.is_some()) && !by_height;
    match (counted, scene.grains.count) {
        (true, None) => add(found, "grains", "`count` is missing"),
        (false, Some(_)) => add(
            found,
            "grains.count",
            "the start says how many grains there are: leave it out",
        ),
        _ => {}
    }
    match (s.file.is_some(), scene.grains.radius) {
        (false, None) => add(
            found,
            "grains",
            "`radius` is missing: the smallest and the largest",
        ),
        (true, Some(_)) => add(
            found,
            "grains.radius",
            "the file has the radii: leave it out",
        ),
        (_, Some([low, _])) if low <= 0.0 => {
            add(
                found,
                "grains.radius",
                format!("must be more than 0 m, found {low}"),
            );
        }
        (_, Some([low, high])) if low > high => {
            add(
                found,
                "grains.radius",
                format!("{low} m to {high} m: the smallest comes first"),
            );
        }
        _ => {}
    }
    if let Some(grown) = &s.grown
        && grown.stress.is_some() == grown.porosity.is_some()
    {
        add(
            found,
            "start.grown",
            "either `stress` or `porosity` is needed",
        );
    }
    let needs_box = s.grown.is_some() || s.rained.is_some() || s.lattice.is_some();
    let corners = s
        .cloud
        .as_ref()
        .is_some_and(|c| c.low.is_some() && c.high.is_some());
    if scene.r#box.is_none() && (needs_box || (s.cloud.is_some() && !corners)) {
        add(
            found,
            "start",
            "these grains fill a box: `[box]` is missing",
        );
    }
    if s.headroom.is_some() && !planes(scene).iter().any(|p| p == "top") {
        add(
            found,
            "start.headroom",
            "there is no wall `top` to be moved",
        );
    }
    if s.headroom.is_some() && s.settle.is_none() && s.rained.is_none() {
        add(
            found,
            "start.headroom",
            "the grains must come to rest first: give `settle`",
        );
    }
}

fn boxed(scene: &Scene, found: &mut Vec<SceneProblem>) {
    let Some(given) = &scene.r#box else { return };
    for axis in 0..3 {
        let (low, high) = (given.low[axis], given.high[axis]);
        if low >= high {
            let message = format!("must be above the lower corner: {high} m is not above {low} m");
            add(found, format!("box.high[{axis}]"), message);
        }
    }
    for (k, name) in given.open.iter().enumerate() {
        if !BOX.contains(&name.as_str()) {
            let near = suggestion(name, BOX);
            let message = format!(
                "there is no wall `{name}` of a box{near} (there are: {})",
                BOX.join(", ")
            );
            add(found, format!("box.open[{k}]"), message);
        }
    }
}

fn one_wall(scene: &Scene, name: &str, wall: &Wall, found: &mut Vec<SceneProblem>) {
    let at = |key: &str| format!("wall.{name}.{key}");
    let boxed = BOX.iter().position(|b| *b == name);
    match boxed {
        Some(number) => {
            for (key, given) in [
                ("point", wall.point.is_some()),
                ("normal", wall.normal.is_some()),
                ("file", wall.file.is_some()),
                ("spin", wall.spin.is_some()),
            ] {
                if given {
                    add(
                        found,
                        at(key),
                        "a wall of the box has its place from `[box]`",
                    );
                }
            }
            let why = match &scene.r#box {
                None => Some("there is no `[box]`"),
                Some(_) if periodic(scene, number / 2) => Some("the box is periodic there"),
                Some(b) if b.open.iter().any(|o| o == name) => Some("the box is open there"),
                Some(_) => None,
            };
            if let Some(why) = why {
                add(
                    found,
                    format!("wall.{name}"),
                    format!("there is no such wall: {why}"),
                );
            }
        }
        None if wall.file.is_some() => {
            if wall.normal.is_some() {
                add(found, at("normal"), "a surface from a file has no normal");
            }
        }
        None => {
            if wall.point.is_none() || wall.normal.is_none() {
                let near = suggestion(name, BOX);
                let message = format!(
                    "a plane needs `point` and `normal`, a surface a `file`; it is no wall of the box{near}"
                );
                add(found, format!("wall.{name}"), message);
            }
            if wall.normal.is_some_and(|n| n.iter().all(|x| *x == 0.0)) {
                add(found, at("normal"), "has no direction");
            }
        }
    }
    motions(name, wall, found);
    let sides = [
        wall.pressure.is_some(),
        wall.inflow.is_some(),
        wall.wave.is_some(),
    ];
    let several = sides.iter().filter(|given| **given).count() > 1;
    if several {
        add(
            found,
            format!("wall.{name}"),
            "only one of `pressure`, `inflow`, `wave` can be given",
        );
    }
    if scene.fluid.is_none() && (sides.contains(&true) || wall.sticks) {
        add(
            found,
            format!("wall.{name}"),
            "conditions of the fluid need a `[fluid]`",
        );
    }
}

fn motions(name: &str, wall: &Wall, found: &mut Vec<SceneProblem>) {
    let motions = [
        ("velocity", wall.velocity.is_some()),
        ("piston", wall.piston.is_some()),
        ("servo", wall.servo.is_some()),
        ("strain_rate", wall.strain_rate.is_some()),
        ("removed", wall.removed),
    ];
    let given: Vec<_> = motions
        .iter()
        .filter(|(_, g)| *g)
        .map(|(n, _)| *n)
        .collect();
    if let [_, second, ..] = given.as_slice() {
        let told = given.join("`, `");
        add(
            found,
            format!("wall.{name}.{second}"),
            format!("only one of `{told}` can be given"),
        );
    }
    if wall.file.is_some() && given.iter().any(|g| *g != "velocity") {
        add(
            found,
            format!("wall.{name}"),
            "a surface moves by `velocity` and `spin` only",
        );
    }
    if let Some(piston) = &wall.piston
        && piston.amplitude != 0.0
        && piston.period.is_none()
    {
        add(
            found,
            format!("wall.{name}.piston"),
            "a stress that swings needs a `period`",
        );
    }
}

fn fluid(scene: &Scene, found: &mut Vec<SceneProblem>) {
    let Some(fluid) = &scene.fluid else { return };
    let Some(given) = &scene.r#box else {
        return add(found, "fluid", "the fluid fills a box: `[box]` is missing");
    };
    if let Some(axis) = given.periodic.first() {
        let message = format!("the fluid needs six walls, and the box is periodic along {axis:?}");
        add(found, "box.periodic", message.to_lowercase());
    }
    if !given.open.is_empty() {
        add(
            found,
            "box.open",
            "the fluid needs six walls: give a wall a `pressure` instead",
        );
    }
    for (name, wall) in &scene.wall {
        if !BOX.contains(&name.as_str()) {
            add(
                found,
                format!("wall.{name}"),
                "the fluid knows the six walls of the box only",
            );
        }
        if wall.removed {
            add(
                found,
                format!("wall.{name}.removed"),
                "the fluid needs six walls",
            );
        }
    }
    let pressed = scene
        .wall
        .values()
        .any(|w| w.pressure.is_some() || w.wave.is_some());
    if !pressed && fluid.bulk_modulus.is_none() {
        let message = "no wall has a `pressure` or a `wave`: pressures would be known but for a constant; give one, \
                       or a `bulk_modulus`";
        add(found, "fluid", message);
    }
}

fn oedometer(scene: &Scene, found: &mut Vec<SceneProblem>) {
    let Some(test) = &scene.oedometer else { return };
    let wall = scene.wall.get(&test.wall);
    match wall.and_then(|w| w.piston.as_ref()) {
        None => {
            let pistons = scene.wall.iter().filter(|(_, w)| w.piston.is_some());
            let near = suggestion(&test.wall, pistons.map(|(n, _)| n.as_str()));
            add(
                found,
                "oedometer.wall",
                format!("there is no piston `{}`{near}", test.wall),
            );
        }
        Some(piston) if piston.prepared.is_none() => {
            let message = "`prepared` is missing: the load is the step from it to `stress`";
            add(found, format!("wall.{}.piston", test.wall), message);
        }
        Some(_) => {}
    }
    if scene.fluid.is_none() {
        add(found, "oedometer", "needs a `[fluid]`");
    }
    if scene.start.settle.is_none() {
        add(
            found,
            "start",
            "an oedometer test starts from rest: give `settle`",
        );
    }
}

fn one_probe(scene: &Scene, name: &str, probe: &Probe, found: &mut Vec<SceneProblem>) {
    let at = |key: &str| format!("probe.{name}.{key}");
    let wet = "needs a `[fluid]`";
    match probe {
        Probe::Stress { wall } | Probe::Borne { wall } | Probe::Amplitude { wall } => {
            let names = planes(scene);
            if !names.contains(wall) {
                let near = suggestion(wall, names.iter().map(String::as_str));
                add(
                    found,
                    at("wall"),
                    format!("there is no wall `{wall}`{near}"),
                );
            }
            let waves = scene.wall.get(wall).is_some_and(|w| w.wave.is_some());
            if matches!(probe, Probe::Amplitude { .. }) && !waves {
                add(found, at("wall"), format!("there is no wave on `{wall}`"));
            }
        }
        Probe::Carried {} | Probe::Pressure { .. } | Probe::Gradient { .. }
            if scene.fluid.is_none() =>
        {
            add(found, at("kind"), wet);
        }
        Probe::Consolidation {} if scene.oedometer.is_none() => {
            add(found, at("kind"), "needs an `[oedometer]`");
        }
        Probe::Strain { .. }
        | Probe::VolumetricStrain {}
        | Probe::Deviator { .. }
        | Probe::EffectiveStress { .. }
        | Probe::Porosity { .. } => {
            let closed = scene.r#box.as_ref().is_some_and(|b| b.open.is_empty());
            if !closed {
                add(found, at("kind"), "needs a closed `[box]`");
            }
        }
        _ => {}
    }
    if let Probe::Pressure { from, to, .. }
    | Probe::Gradient { from, to, .. }
    | Probe::Porosity { from, to, .. } = probe
        && from >= to
    {
        add(
            found,
            at("to"),
            format!("must be above `from`: {to} m is not above {from} m"),
        );
    }
}

fn one_reference(
    scene: &Scene,
    probes: &BTreeMap<String, Probe>,
    name: &str,
    reference: &Reference,
    found: &mut Vec<SceneProblem>,
) {
    let at = |key: &str| format!("reference.{name}.{key}");
    let mut known = |key: &str, probe: &str| {
        if !probes.contains_key(probe) {
            let near = suggestion(probe, probes.keys().map(String::as_str));
            add(found, at(key), format!("there is no probe `{probe}`{near}"));
        }
    };
    match reference {
        Reference::Terzaghi { probe, .. } => {
            known("probe", probe);
            if scene.oedometer.is_none() {
                add(found, at("kind"), "needs an `[oedometer]`");
            }
        }
        Reference::Line { along, probe, .. } => {
            known("along", along);
            known("probe", probe);
        }
        Reference::Scaling { probe, .. } => {
            known("probe", probe);
            let fits = matches!(probes.get(probe), Some(Probe::RunOut { .. }) | None);
            if !fits {
                add(
                    found,
                    at("probe"),
                    "a probe of the kind `run-out` is needed",
                );
            }
        }
        Reference::Value { probe, .. } | Reference::Curve { probe, .. } => known("probe", probe),
    }
}

fn files(
    scene: &Scene,
    references: &BTreeMap<String, Reference>,
    source: &Source,
    found: &mut Vec<SceneProblem>,
) {
    let start = scene
        .start
        .file
        .iter()
        .map(|f| ("start.file".to_string(), f));
    let walls = scene
        .wall
        .iter()
        .filter_map(|(name, wall)| Some((format!("wall.{name}.file"), wall.file.as_ref()?)));
    let compared = references
        .iter()
        .filter_map(|(name, reference)| match reference {
            Reference::Scaling { file, .. } | Reference::Curve { file, .. } => {
                Some((format!("reference.{name}.file"), file))
            }
            _ => None,
        });
    for (key, file) in start.chain(walls).chain(compared) {
        if let Err(problem) = source.resolve(&key, file) {
            add(found, key, problem.to_string());
        }
    }
}

fn output(scene: &Scene, found: &mut Vec<SceneProblem>) {
    let wet = scene.fluid.is_some();
    let names = || crate::fields::names(wet);
    for (k, field) in scene.output.picture.iter().enumerate() {
        if !names().any(|n| n == field) {
            let near = suggestion(field, names());
            let known = names().collect::<Vec<_>>().join(", ");
            let message = format!("there is no field `{field}`{near} (there are: {known})");
            add(found, format!("output.picture[{k}]"), message);
        }
    }
}

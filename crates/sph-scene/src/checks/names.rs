//! Names: their spelling, and the existence of the named objects.

use std::collections::BTreeSet;
use std::path::PathBuf;

use scene_text::{Problems, given};
use sph_core::suggestion;
use toml::{Table, Value};

use crate::{Motion, Norm, Reference, Scene, Source};

/// Kinds of tables with names that the user chooses.
pub(crate) const NAMED: [&str; 8] = [
    "wall",
    "phase",
    "body",
    "outlet",
    "zone",
    "probe",
    "gauge",
    "reference",
];
/// Longest name.
const LONGEST: usize = 64;

/// Names go into the names of columns and files, and into dotted paths.
pub(crate) fn spelling(scene: &Table, found: &mut Problems) {
    let good = |name: &str| {
        let plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        !name.is_empty() && name.len() <= LONGEST && name.chars().all(plain)
    };
    for kind in NAMED {
        for (name, _) in inside(scene.get(kind)).filter(|(name, _)| !good(name)) {
            let message =
                format!("a name is 1 to {LONGEST} letters, digits, `-` and `_`, found `{name}`");
            found.add(format!("{kind}.{name}"), message);
        }
    }
    let probes: BTreeSet<&String> = inside(scene.get("probe")).map(|(name, _)| name).collect();
    for (name, _) in inside(scene.get("gauge")).filter(|(name, _)| probes.contains(name)) {
        let message = format!("there is a probe called `{name}` too");
        found.add(format!("gauge.{name}"), message);
    }
    for kind in ["probe", "gauge"] {
        for (name, keys) in inside(scene.get(kind)) {
            let plugin = keys.get("kind").and_then(Value::as_str);
            if plugin.is_some_and(|k| k.trim().is_empty()) {
                let path = format!("{kind}.{name}.kind");
                found.add(path, "the name of the plugin is empty");
            }
        }
    }
}

/// Everything that is named exists; files are where a scene may name them.
pub(crate) fn references(scene: &mut Scene, source: &Source, found: &mut Problems) {
    let moved = scene.wall.values().any(|wall| !wall.mover.is_empty());
    if scene.body.is_empty() && !moved {
        found.add("", "a scene needs a body: [body.NAME]");
    }
    if scene.phase.is_empty() {
        let why = match moved {
            true => "; walls that move freely meet as if it were in the gap",
            false => "",
        };
        found.add("", format!("a scene needs a phase: [phase.NAME]{why}"));
    }
    for (name, body) in &scene.body {
        if !scene.phase.contains_key(&body.phase) {
            let near = suggestion(&body.phase, scene.phase.keys().map(String::as_str));
            let message = format!("there is no phase called `{}`{near}", body.phase);
            found.add(format!("body.{name}.phase"), message);
        }
    }
    let probes: Vec<&String> = scene.probe.keys().chain(scene.gauge.keys()).collect();
    let known = |probe: &str, path: String, found: &mut Problems| {
        if probes.iter().all(|known| *known != probe) {
            let near = suggestion(probe, probes.iter().map(|known| known.as_str()));
            let message = format!("there is no probe or gauge called `{probe}`{near}");
            found.add(path, message);
        }
    };
    for (name, reference) in &mut scene.reference {
        let path = format!("reference.{name}");
        reference_keys(reference, &path, found);
        // A probe of several columns is named with the column's suffix, `extent.highest`.
        if let Some(probe) = reference.probe.as_ref().and_then(|p| p.split('.').next()) {
            known(probe, format!("{path}.probe"), found);
        }
        reference.path = located(&reference.file, &path, source, found);
    }
    for (name, zone) in &scene.zone {
        if let Some(wall) = zone
            .follows
            .as_ref()
            .filter(|w| !scene.wall.contains_key(*w))
        {
            let near = suggestion(wall, scene.wall.keys().map(String::as_str));
            let message = format!("there is no wall called `{wall}`{near}");
            found.add(format!("zone.{name}.follows"), message);
        }
        for (k, probe) in zone.probes.iter().enumerate() {
            known(probe, format!("zone.{name}.probes[{k}]"), found);
        }
    }
    for (kind, tables) in [("probe", &scene.probe), ("gauge", &scene.gauge)] {
        for (name, table) in tables {
            let file = table.get("file").and_then(|f| f.as_str()).map(String::from);
            let path = located(&file, &format!("{kind}.{name}"), source, found);
            let path = path.map(|path| (name.clone(), path));
            scene.probe_files.extend(path);
        }
    }
    for (name, wall) in &mut scene.wall {
        let path = format!("wall.{name}");
        wall.path = located(&wall.file, &path, source, found);
        if let Some(motion) = &mut wall.motion {
            files_of_motion(motion, &format!("{path}.motion"), source, found);
        }
    }
    if let Some(frame) = &mut scene.numerics.frame {
        files_of_motion(frame, "numerics.frame", source, found);
    }
    if let Some(course) = &mut scene.numerics.gravity_over_time {
        course.path = located(&course.file, "numerics.gravity_over_time", source, found);
    }
}

/// Fills in the paths of the files that a motion names.
fn files_of_motion(motion: &mut Motion, motion_path: &str, source: &Source, found: &mut Problems) {
    for k in 0..motion.translate.len() {
        let path = motion.translate_path(motion_path, k);
        let rows = &mut motion.translate[k].rows;
        rows.path = located(&rows.file, &path, source, found);
    }
    if let Some(levels) = &mut motion.levels {
        let path = format!("{motion_path}.levels");
        levels.path = located(&Some(levels.file.clone()), &path, source, found);
    }
    if let Some(rotate) = &mut motion.rotate {
        let path = format!("{motion_path}.rotate");
        let rows = &mut rotate.rows;
        rows.path = located(&rows.file, &path, source, found);
    }
}

/// The path of the file that a table names.
fn located(
    file: &Option<String>,
    table: &str,
    source: &Source,
    found: &mut Problems,
) -> Option<PathBuf> {
    let key = format!("{table}.file");
    match source.resolve(&key, file.as_ref()?) {
        Ok(path) => Some(path),
        Err(why) => {
            found.add(key, why.to_string());
            None
        }
    }
}

fn reference_keys(reference: &Reference, path: &str, found: &mut Problems) {
    let one = [reference.probe.is_some(), reference.field.is_some()];
    let neither = "the key `probe` or `field` is missing: what is compared";
    let both = "a reference compares a probe or a field, not both";
    found.either(one, path, neither, ("field", both));
    measured(reference, path, found);
    let one = [reference.file.is_some(), reference.solution.is_some()];
    let neither = "the key `file` or `solution` is missing: what it is compared with";
    let both = "a reference is a file or a solution, not both";
    if one != [false; 2] || !reference.stands_alone() {
        found.either(one, path, neither, ("solution", both));
    }
    if reference.solution.is_none() && !reference.parameters.is_empty() {
        let path = format!("{path}.parameters");
        found.add(path, "parameters belong to a `solution`");
    }
    if reference.file.is_none() {
        for key in given([
            ("columns", reference.columns.is_some()),
            ("lower", reference.lower.is_some()),
            ("upper", reference.upper.is_some()),
        ]) {
            found.add(format!("{path}.{key}"), "columns belong to a `file`");
        }
    }
    let limits = reference.lower.is_some() && reference.upper.is_some();
    if reference.norm() == Norm::Band && !limits {
        let message = "the norm `band` needs the columns `lower` and `upper`";
        found.add(format!("{path}.norm"), message);
    }
}

/// The norms that need a number, and the one that needs a field.
fn measured(reference: &Reference, path: &str, found: &mut Problems) {
    let norm = reference.norm();
    let at_norm = format!("{path}.norm");
    match (norm, reference.value) {
        (Norm::Mean, None | Some(0.0)) => {
            found.add(&at_norm, "the norm `mean` needs a `value` other than 0");
        }
        (Norm::Mean, _) | (_, None) => {}
        _ => {
            let message = "a value is compared by `norm = \"mean\"` only";
            found.add(format!("{path}.value"), message);
        }
    }
    if matches!(norm, Norm::Period | Norm::Lag) && reference.period.is_none() {
        let name = norm.name();
        let message = format!("the norm `{name}` needs the `period` of the reference");
        found.add(&at_norm, message);
    }
    if norm == Norm::DecayRate && reference.solution.is_none() {
        let message = "the norm `decay-rate` needs a `solution` with a constant rate";
        found.add(&at_norm, message);
    }
    for (key, scale) in [
        ("scale_value", reference.scale_value),
        ("scale_time", reference.scale_time),
    ] {
        if scale == 0.0 || !scale.is_finite() {
            let message = format!("a scale is a finite number other than 0, found {scale}");
            found.add(format!("{path}.{key}"), message);
        }
    }
    let about = |what: &str| format!("the norm `{}` is for {what}", norm.name());
    match (norm, &reference.field, &reference.probe) {
        (Norm::L2Mean | Norm::Rms, None, Some(_)) => found.add(&at_norm, about("fields")),
        (_, Some(_), None) if reference.stands_alone() => found.add(&at_norm, about("probes")),
        _ => {}
    }
    if reference.stands_alone() {
        for key in given([
            ("file", reference.file.is_some()),
            ("solution", reference.solution.is_some()),
        ]) {
            let name = norm.name();
            let message = format!("the norm `{name}` compares with no file or solution");
            found.add(format!("{path}.{key}"), message);
        }
    }
}

/// The named tables of a table.
pub(crate) fn inside(value: Option<&Value>) -> impl Iterator<Item = (&String, &Value)> {
    value.and_then(Value::as_table).into_iter().flatten()
}

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
        found.add(
            format!("gauge.{name}"),
            format!("there is a probe called `{name}` too"),
        );
    }
    for kind in ["probe", "gauge"] {
        for (name, keys) in inside(scene.get(kind)) {
            if keys
                .get("kind")
                .and_then(Value::as_str)
                .is_some_and(|k| k.trim().is_empty())
            {
                found.add(
                    format!("{kind}.{name}.kind"),
                    "the name of the plugin is empty",
                );
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
    let probes: Vec<String> = scene
        .probe
        .keys()
        .chain(scene.gauge.keys())
        .cloned()
        .collect();
    for (name, reference) in &mut scene.reference {
        let path = format!("reference.{name}");
        reference_keys(reference, &path, found);
        // A probe of several columns is named with the column's suffix, `extent.highest`.
        let name = |p: &String| p.split('.').next().map(String::from);
        let named = reference.probe.as_ref().and_then(name);
        if let Some(probe) = named.filter(|p| !probes.contains(p)) {
            let near = suggestion(&probe, probes.iter().map(String::as_str));
            let message = format!("there is no probe or gauge called `{probe}`{near}");
            found.add(format!("{path}.probe"), message);
        }
        reference.path = located(&reference.file, &path, source, found);
    }
    for (name, zone) in &scene.zone {
        for (k, probe) in zone.probes.iter().enumerate() {
            if !probes.contains(probe) {
                let near = suggestion(probe, probes.iter().map(String::as_str));
                let message = format!("there is no probe or gauge called `{probe}`{near}");
                found.add(format!("zone.{name}.probes[{k}]"), message);
            }
        }
    }
    let mut files = Vec::new();
    for (kind, tables) in [("probe", &scene.probe), ("gauge", &scene.gauge)] {
        for (name, table) in tables {
            let file = table.get("file").and_then(|f| f.as_str()).map(String::from);
            let path = located(&file, &format!("{kind}.{name}"), source, found);
            files.extend(path.map(|path| (name.clone(), path)));
        }
    }
    scene.probe_files.extend(files);
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
    match (&reference.probe, &reference.field) {
        (None, None) => found.add(
            path,
            "the key `probe` or `field` is missing: what is compared",
        ),
        (Some(_), Some(_)) => found.add(
            format!("{path}.field"),
            "a reference compares a probe or a field, not both",
        ),
        _ => {}
    }
    measured(reference, path, found);
    match (&reference.file, &reference.solution) {
        (None, None) if reference.stands_alone() => {}
        (None, None) => {
            found.add(
                path,
                "the key `file` or `solution` is missing: what it is compared with",
            );
        }
        (Some(_), Some(_)) => found.add(
            format!("{path}.solution"),
            "a reference is a file or a solution, not both",
        ),
        _ => {}
    }
    if reference.solution.is_none() && !reference.parameters.is_empty() {
        found.add(
            format!("{path}.parameters"),
            "parameters belong to a `solution`",
        );
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
        found.add(
            format!("{path}.norm"),
            "the norm `band` needs the columns `lower` and `upper`",
        );
    }
}

/// The norms that need a number, and the one that needs a field.
fn measured(reference: &Reference, path: &str, found: &mut Problems) {
    match (reference.norm(), reference.value, reference.period) {
        (Norm::Mean, None | Some(0.0), _) => found.add(
            format!("{path}.norm"),
            "the norm `mean` needs a `value` other than 0",
        ),
        (Norm::Mean, ..) | (_, None, _) => {}
        _ => found.add(
            format!("{path}.value"),
            "a value is compared by `norm = \"mean\"` only",
        ),
    }
    let norm = reference.norm();
    if matches!(norm, Norm::Period | Norm::Lag) && reference.period.is_none() {
        let name = norm.name();
        let message = format!("the norm `{name}` needs the `period` of the reference");
        found.add(format!("{path}.norm"), message);
    }
    if reference.norm() == Norm::DecayRate && reference.solution.is_none() {
        let message = "the norm `decay-rate` needs a `solution` with a constant rate";
        found.add(format!("{path}.norm"), message);
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
    let about = |norm: Norm, what: &str| format!("the norm `{}` is for {what}", norm.name());
    match (reference.norm(), &reference.field, &reference.probe) {
        (norm @ (Norm::L2Mean | Norm::Rms), None, Some(_)) => {
            found.add(format!("{path}.norm"), about(norm, "fields"));
        }
        (norm, Some(_), None) if reference.stands_alone() => {
            found.add(format!("{path}.norm"), about(norm, "probes"));
        }
        _ => {}
    }
    for (key, given) in [
        ("file", reference.file.is_some()),
        ("solution", reference.solution.is_some()),
    ] {
        if given && reference.stands_alone() {
            let message = format!(
                "the norm `{}` compares with no file or solution",
                reference.norm().name()
            );
            found.add(format!("{path}.{key}"), message);
        }
    }
}

/// The named tables of a table.
pub(crate) fn inside(value: Option<&Value>) -> impl Iterator<Item = (&String, &Value)> {
    value.and_then(Value::as_table).into_iter().flatten()
}

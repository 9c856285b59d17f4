//! Names: their spelling, and the existence of the named objects.

use std::collections::BTreeSet;
use std::path::PathBuf;

use scene_text::Problems;
use sph_core::suggestion;
use toml::{Table, Value};

use crate::checks::table_check::TableCheck;
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
pub(crate) fn references(scene: &mut Scene, source: &Source, whole: &mut TableCheck<'_>) {
    let moved = scene.wall.values().any(|wall| !wall.mover.is_empty());
    let bare = scene.body.is_empty() && !moved;
    whole.refuse(bare, "", "a scene needs a body: [body.NAME]");
    let why = match moved {
        true => "; walls that move freely meet as if it were in the gap",
        false => "",
    };
    let message = format!("a scene needs a phase: [phase.NAME]{why}");
    whole.refuse(scene.phase.is_empty(), "", message);
    let phases: Vec<&String> = scene.phase.keys().collect();
    for (name, body) in &scene.body {
        let key = format!("body.{name}.phase");
        known("phase", &body.phase, &phases, whole.below(&key));
    }
    let probes: Vec<&String> = scene.probe.keys().chain(scene.gauge.keys()).collect();
    for (name, reference) in &mut scene.reference {
        let mut check = whole.below(&format!("reference.{name}"));
        reference_keys(reference, &mut check);
        // A probe of several columns is named with the column's suffix, `extent.highest`.
        if let Some(probe) = reference.probe.as_ref().and_then(|p| p.split('.').next()) {
            known("probe or gauge", probe, &probes, check.below("probe"));
        }
        reference.path = located(&reference.file, source, check);
    }
    for (name, zone) in &scene.zone {
        let walls: Vec<&String> = scene.wall.keys().collect();
        let near = zone.near.as_ref().map(|near| &near.wall);
        for (key, wall) in [("follows", zone.follows.as_ref()), ("near.wall", near)] {
            let check = whole.below(&format!("zone.{name}.{key}"));
            wall.inspect(|wall| known("wall", wall, &walls, check));
        }
        for (k, probe) in zone.probes.iter().enumerate() {
            let key = format!("zone.{name}.probes[{k}]");
            known("probe or gauge", probe, &probes, whole.below(&key));
        }
    }
    for (kind, tables) in [("probe", &scene.probe), ("gauge", &scene.gauge)] {
        for (name, table) in tables {
            let file = table.get("file").and_then(|f| f.as_str()).map(String::from);
            let path = located(&file, source, whole.below(&format!("{kind}.{name}")));
            let path = path.map(|path| (name.clone(), path));
            scene.probe_files.extend(path);
        }
    }
    for (name, wall) in &mut scene.wall {
        let mut check = whole.below(&format!("wall.{name}"));
        if let Some(motion) = &mut wall.motion {
            files_of_motion(motion, source, check.below("motion"));
        }
        wall.path = located(&wall.file, source, check);
    }
    if let Some(frame) = &mut scene.numerics.frame {
        files_of_motion(frame, source, whole.below("numerics.frame"));
    }
    if let Some(course) = &mut scene.numerics.gravity_over_time {
        let check = whole.below("numerics.gravity_over_time");
        course.path = located(&course.file, source, check);
    }
}

fn known(what: &str, name: &str, names: &[&String], mut check: TableCheck<'_>) {
    if names.iter().all(|known| *known != name) {
        let near = suggestion(name, names.iter().map(|known| known.as_str()));
        check.add("", format!("there is no {what} called `{name}`{near}"));
    }
}

/// Fills in the paths of the files that a motion names.
fn files_of_motion(motion: &mut Motion, source: &Source, mut check: TableCheck<'_>) {
    for k in 0..motion.translate.len() {
        let check = check.below(&motion.translate_key(k));
        let rows = &mut motion.translate[k].rows;
        rows.path = located(&rows.file, source, check);
    }
    if let Some(levels) = &mut motion.levels {
        let file = Some(levels.file.clone());
        levels.path = located(&file, source, check.below("levels"));
    }
    if let Some(rotate) = &mut motion.rotate {
        let rows = &mut rotate.rows;
        rows.path = located(&rows.file, source, check.below("rotate"));
    }
}

/// The path of the file that a table names.
fn located(file: &Option<String>, source: &Source, mut check: TableCheck<'_>) -> Option<PathBuf> {
    let key = format!("{}.file", check.path);
    let found = source.resolve(&key, file.as_ref()?);
    found.map_err(|why| check.add("file", why)).ok()
}

fn reference_keys(reference: &Reference, check: &mut TableCheck<'_>) {
    let one = [reference.probe.is_some(), reference.field.is_some()];
    let neither = "the key `probe` or `field` is missing: what is compared";
    let both = "a reference compares a probe or a field, not both";
    (check.found).either(one, &check.path, neither, ("field", both));
    measured(reference, check);
    let one = [reference.file.is_some(), reference.solution.is_some()];
    let neither = "the key `file` or `solution` is missing: what it is compared with";
    let both = "a reference is a file or a solution, not both";
    if one != [false; 2] || !reference.stands_alone() {
        (check.found).either(one, &check.path, neither, ("solution", both));
    }
    let [file, solution] = one;
    let needless = !solution && !reference.parameters.is_empty();
    check.refuse(needless, "parameters", "parameters belong to a `solution`");
    let (lower, upper) = (reference.lower.is_some(), reference.upper.is_some());
    for (key, given) in [
        ("columns", reference.columns.is_some()),
        ("lower", lower),
        ("upper", upper),
    ] {
        check.refuse(given && !file, key, "columns belong to a `file`");
    }
    let unlimited = reference.norm() == Norm::Band && !(lower && upper);
    let message = "the norm `band` needs the columns `lower` and `upper`";
    check.refuse(unlimited, "norm", message);
}

/// The norms that need a number, and the one that needs a field.
fn measured(reference: &Reference, check: &mut TableCheck<'_>) {
    let norm = reference.norm();
    let name = norm.name();
    let mean = norm == Norm::Mean;
    let nothing = mean && matches!(reference.value, None | Some(0.0));
    let message = "the norm `mean` needs a `value` other than 0";
    check.refuse(nothing, "norm", message);
    let message = "a value is compared by `norm = \"mean\"` only";
    check.refuse(!mean && reference.value.is_some(), "value", message);
    let periodic = matches!(norm, Norm::Period | Norm::Lag) && reference.period.is_none();
    let message = format!("the norm `{name}` needs the `period` of the reference");
    check.refuse(periodic, "norm", message);
    let alone = norm == Norm::DecayRate && reference.solution.is_none();
    let message = "the norm `decay-rate` needs a `solution` with a constant rate";
    check.refuse(alone, "norm", message);
    for (key, scale) in [
        ("scale_value", reference.scale_value),
        ("scale_time", reference.scale_time),
    ] {
        let message = format!("a scale is a finite number other than 0, found {scale}");
        check.refuse(scale == 0.0 || !scale.is_finite(), key, message);
    }
    let about = |what: &str| format!("the norm `{name}` is for {what}");
    match (norm, &reference.field, &reference.probe) {
        (Norm::L2Mean | Norm::Rms, None, Some(_)) => check.add("norm", about("fields")),
        (_, Some(_), None) if reference.stands_alone() => check.add("norm", about("probes")),
        _ => {}
    }
    for (key, given) in [
        ("file", reference.file.is_some()),
        ("solution", reference.solution.is_some()),
    ] {
        let message = format!("the norm `{name}` compares with no file or solution");
        check.refuse(given && reference.stands_alone(), key, message);
    }
}

pub(crate) fn inside(value: Option<&Value>) -> impl Iterator<Item = (&String, &Value)> {
    value.and_then(Value::as_table).into_iter().flatten()
}

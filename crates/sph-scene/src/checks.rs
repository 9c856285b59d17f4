//! Conditions beyond the schema.

mod bodies;
mod geometry;
mod motion;
pub(crate) mod names;
mod shapes;
mod table_check;
mod walls;
mod zones;

use scene_text::Problems;
use sph_core::{Place, SceneProblem, comma_list, kinds};
use toml::{Table, Value};

use crate::checks::names::inside;
use crate::checks::table_check::TableCheck;
use crate::reading::plugins::holders;
use crate::{Scene, Source};

/// Checks that need no types: names, and one plugin where there is to be one.
pub(crate) fn tables(scene: &Table) -> Vec<SceneProblem> {
    let mut found = Problems::default();
    for kind in kinds().into_iter().filter(|k| k.place != Place::Any) {
        for (path, held) in holders(kind, scene) {
            single(held, &path, &mut found);
        }
    }
    for (name, keys) in inside(scene.get("phase")) {
        let rheology = keys.get("rheology").and_then(Value::as_table);
        if rheology.is_some_and(Table::is_empty) {
            let path = format!("phase.{name}.rheology");
            found.add(&path, format!("a phase needs a rheology: [{path}.PLUGIN]"));
        }
    }
    names::spelling(scene, &mut found);
    found.0
}

fn single(plugins: &Value, path: &str, found: &mut Problems) {
    let names: Vec<&String> = inside(Some(plugins)).map(|(name, _)| name).collect();
    if let [_, .., last] = names.as_slice() {
        let list = comma_list(names.iter().map(|n| format!("`{n}`")));
        let message = format!("only one plugin can stand here, found {list}");
        found.add(format!("{path}.{last}"), message);
    }
}

/// Checks of a scene whose form is right; also fills in the paths of its files.
pub(crate) fn scene(scene: &mut Scene, source: &Source) -> Vec<SceneProblem> {
    let mut found = Problems::default();
    let mut whole = TableCheck {
        path: String::new(),
        dimension: scene.dimension,
        found: &mut found,
    };
    names::references(scene, source, &mut whole);
    times(scene, whole.found);
    geometry::check(scene, &mut whole);
    found.0
}

/// Most outputs of fields in a run.
const OUTPUTS: f64 = 1e6;
/// Most rows of the series in a run.
const ROWS: f64 = 1e9;

/// Checks the times of outputs and references, and the bounds of densities.
fn times(scene: &Scene, found: &mut Problems) {
    let end = scene.run.end;
    let output = &scene.output;
    if output.every.is_some() && output.times.is_some() {
        let message = "outputs are `every` so often or at `times`, not both";
        found.add("output.times", message);
    }
    let times = output.times.as_deref().unwrap_or(&[]);
    for (k, t) in times.iter().enumerate() {
        let path = format!("output.times[{k}]");
        if !(0.0..=end).contains(t) {
            let message = format!("{t} s is outside the run, which lasts from 0 to {end} s");
            found.add(path, message);
        } else if k > 0 && times[k - 1] >= *t {
            let message = format!("times must rise, {t} s follows {} s", times[k - 1]);
            found.add(path, message);
        }
    }
    for (path, every, most) in [
        ("output.every", output.every, OUTPUTS),
        ("output.series_every", output.series_every, ROWS),
        ("run.checkpoint_every", scene.run.checkpoint_every, OUTPUTS),
    ] {
        if every.is_some_and(|e| end / e > most) {
            let message = format!("that is more than {most} times in a run of {end} s");
            found.add(path, message);
        }
    }
    if let Some(colours) = &output.picture_range {
        (found.0).extend(colours.falling("output.picture_range"));
    }
    let [low, high] = scene.numerics.density_bounds;
    if !(low < 1.0 && 1.0 < high) {
        let message = format!("the bounds must lie on either side of 1, found {low} and {high}");
        found.add("numerics.density_bounds", message);
    }
    for (name, reference) in &scene.reference {
        for (key, pair) in [("window", reference.window), ("exclude", reference.exclude)] {
            let path = format!("reference.{name}.{key}");
            (found.0).extend(pair.and_then(|pair| scene_text::falling(path, pair)));
        }
        if let Some([start, _]) = reference.window.filter(|w| w[0] > end) {
            let message = format!("it begins at {start} s, after the run's end at {end} s");
            found.add(format!("reference.{name}.window"), message);
        }
    }
}

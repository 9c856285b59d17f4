//! Conditions beyond the schema.

mod bodies;
mod geometry;
mod motion;
pub(crate) mod names;
mod shapes;
mod table_check;
mod time;
mod walls;
mod zones;

use scene_text::Problems;
use sph_core::{Place, SceneProblem, comma_list, kinds};
use toml::{Table, Value};

use crate::checks::names::inside;
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
    names::references(scene, source, &mut found);
    time::check(scene, &mut found);
    geometry::check(scene, &mut found);
    found.0
}

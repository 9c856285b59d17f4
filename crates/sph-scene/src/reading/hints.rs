//! Hints at the place where a table was probably meant to stand.

use scene_text::is_within;
use sph_core::{Place, PluginKind, SceneProblem, kind_of, kinds, nearest};
use toml::{Table, Value};

use crate::checks::names::NAMED;
use crate::reading::plugins::holders;

/// The problems of a scene; where a plugin or a name stands in the wrong place, one problem with the right place instead
/// of those that follow from it.
pub(crate) fn added(problems: Vec<SceneProblem>, scene: &Table) -> Vec<SceneProblem> {
    let mut told: Vec<SceneProblem> = Vec::new();
    let mut explained: Vec<String> = Vec::new();
    for mut problem in problems {
        let mut tables = explained.iter();
        if tables.any(|table| is_within(&problem.path, table)) {
            continue;
        }
        if let Some((table, message)) = explanation(&problem, scene) {
            told.retain(|other| !is_within(&other.path, &table));
            problem.message = message;
            explained.push(table);
        }
        told.push(problem);
    }
    told
}

/// The table that a mistake of place explains, and the message.
fn explanation(problem: &SceneProblem, scene: &Table) -> Option<(String, String)> {
    let path: Vec<&str> = problem.path.split('.').collect();
    let (last, parents) = path.split_last()?;
    let value = at(scene, &path)?;
    let (whole, message) = (problem.path.clone(), &problem.message);
    if message.contains("is not a known key") {
        let place = places(last, value, parents)?;
        return Some((whole, format!("`{last}` is not a known key here: {place}")));
    }
    if message.starts_with("expected a table, found") {
        let (table, place) =
            named_by_a_key(&problem.path, scene).or_else(|| without_a_name(&path))?;
        return Some((table, format!("{message}: {place}")));
    }
    let [root, name] = path.as_slice() else {
        return None;
    };
    if ["probe", "gauge"].contains(root) && message.starts_with("the key `kind` is missing") {
        return Some((whole, kind_of_probe(name, value.as_table()?)?));
    }
    if NAMED.contains(root) && message.contains("is missing") {
        let place = places(name, value, &[*root])?;
        let name = format!("`{name}` is a name that you choose");
        return Some((whole, format!("{message} ({name}; {place})")));
    }
    None
}

fn at<'t>(scene: &'t Table, path: &[&str]) -> Option<&'t Value> {
    let (first, rest) = path.split_first()?;
    rest.iter()
        .try_fold(scene.get(*first)?, |value, key| value.get(*key))
}

/// Places of plugins of a name, or of those of a kind of that name.
fn places(name: &str, value: &Value, parents: &[&str]) -> Option<String> {
    let table = value.as_table();
    if let Some(kind) = kind_of(name) {
        let only = table.and_then(|table| table.keys().next());
        let only = only.map(String::as_str).or_else(|| value.as_str());
        let plugin = only.filter(|plugin| is_of(kind, plugin));
        // Other values are of keys that happen to be called as a kind.
        if table.is_none() && plugin.is_none() {
            return None;
        }
        let place = place(kind, plugin.unwrap_or("PLUGIN"), parents);
        return Some(format!("plugins of the kind `{name}` stand in {place}"));
    }
    table?;
    let all = kinds().into_iter().filter(|kind| is_of(kind, name));
    let each = all.map(|kind| {
        let (place, kind) = (place(kind, name, parents), kind.name);
        format!("the plugin `{name}` of the kind `{kind}` stands in {place}")
    });
    let each: Vec<String> = each.collect();
    (!each.is_empty()).then(|| each.join(", "))
}

fn is_of(kind: &PluginKind, plugin: &str) -> bool {
    (kind.plugins)().iter().any(|known| known.name == plugin)
}

/// The table of a plugin, with the name that the user chose where there is one.
fn place(kind: &PluginKind, plugin: &str, parents: &[&str]) -> String {
    let own = |root: &str| match parents {
        [first, name, ..] if *first == root && kind_of(name).is_none() => name.to_string(),
        _ => "NAME".to_string(),
    };
    let inner = kind.name;
    match kind.place {
        Place::One | Place::Any | Place::Elsewhere => format!("`[{inner}.{plugin}]`"),
        Place::InPhase => format!("`[phase.{}.{inner}.{plugin}]`", own("phase")),
        Place::InWall => format!("`[wall.{}.{inner}.{plugin}]`", own("wall")),
        Place::Probe => format!("`[probe.{}]` with `kind = \"{plugin}\"`", own("probe")),
        Place::Solution if parents.first() == Some(&"reference") => {
            let name = own("reference");
            format!("`[reference.{name}]` with `solution = \"{plugin}\"`")
        }
        Place::Solution => format!("`[body.{}.initial.{plugin}]`", own("body")),
    }
}

/// A plugin that a key names, `kernel = "wendland-c2"` or `kernel.kind = "wendland-c2"`, where its table has to.
fn named_by_a_key(path: &str, scene: &Table) -> Option<(String, String)> {
    let single = kinds().into_iter();
    let mut held = single.flat_map(|kind| {
        let tables = holders(kind, scene).into_iter();
        tables.map(move |(table, held)| (kind, table, held))
    });
    let (kind, table, held) = held.find(|(_, table, _)| is_within(path, table))?;
    let within = held.as_table().into_iter().flat_map(Table::values);
    let mut names = [held].into_iter().chain(within).filter_map(Value::as_str);
    let plugin = names.find(|name| is_of(kind, name)).unwrap_or("PLUGIN");
    let message = format!("a table names the plugin, `[{table}.{plugin}]`");
    Some((table, message))
}

/// Keys of a wall, phase, … that stand in `[wall]`, `[phase]`, ….
fn without_a_name(path: &[&str]) -> Option<(String, String)> {
    let root = path.first().filter(|root| NAMED.contains(root));
    let root = root.filter(|_| path.len() <= 2)?;
    let message = format!("its name is one that you choose, `[{root}.NAME]`");
    Some((root.to_string(), message))
}

fn kind_of_probe(name: &str, table: &Table) -> Option<String> {
    let plugins = kind_of("probe").map_or(Vec::new(), |kind| (kind.plugins)());
    let known: Vec<_> = plugins.iter().map(|plugin| plugin.name).collect();
    let texts = table.values().filter_map(Value::as_str);
    let inner = table.keys().map(String::as_str);
    let meant = inner.chain(texts).find(|text| known.contains(text));
    let meant = meant.or_else(|| nearest(name, known.iter().copied()));
    let head = format!(
        "the key `kind` is missing: the plugin that measures (`{name}` is a name that you choose)"
    );
    match meant {
        Some(plugin) => Some(format!("{head}, did you mean `kind = \"{plugin}\"`?")),
        None if known.is_empty() => None,
        None => Some(format!("{head}, one of {}", known.join(", "))),
    }
}

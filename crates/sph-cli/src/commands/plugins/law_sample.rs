//! Laws with the parameters of their examples, and their overrides.

use sph_core::{PluginInfo, RegistryError, comma_list, number, suggestion};
use sph_scene::Override;
use sph_solver::rheometer::{self, Rheology};
use toml::{Table, Value};

use crate::scene_file::overrides;
use crate::terminal::Trouble;

pub struct LawSample {
    /// Name, and its difference from its neighbours.
    pub label: String,
    pub law: Box<dyn Rheology>,
}

/// A law for every name and every value of `vary`, a `KEY=[…]`. With several names, keys start with a name.
pub fn all(
    plugins: &[PluginInfo],
    set: &[String],
    vary: Option<&str>,
) -> Result<Vec<LawSample>, Trouble> {
    let mut tables: Vec<Table> = plugins.iter().map(example).collect();
    let several = plugins.len() > 1;
    for set in overrides(set)? {
        let (number, inside) = addressed(plugins, &set)?;
        let put = inside.apply(&mut tables[number]);
        put.map_err(|p| format!("--set {}: {}", &set.text, p.message))?;
    }
    let mut variants: Vec<(usize, Override)> = Vec::new();
    if let Some(vary) = vary {
        let told = |why: &str| format!("--vary {vary}: {why}");
        let parsed = Override::parse(vary).map_err(|p| told(&p.message))?;
        let (number, inside) = addressed(plugins, &parsed)?;
        let Value::Array(values) = &inside.value else {
            return Err(told("expected a list, KEY=[first, second, …]").into());
        };
        for value in values {
            let one = Override::new(&inside.path, value.clone());
            variants.push((number, one.map_err(|p| told(&p.message))?));
        }
    }
    let mut samples = Vec::new();
    for (k, (plugin, table)) in plugins.iter().zip(&tables).enumerate() {
        let own: Vec<&Override> = variants.iter().filter(|v| v.0 == k).map(|v| &v.1).collect();
        if own.is_empty() {
            samples.push(specimen(plugin, table, plugin.name.to_string())?);
        }
        for variant in own {
            let mut table = table.clone();
            let put = variant.apply(&mut table);
            put.map_err(|p| format!("--vary {}: {}", p.path, p.message))?;
            let value = plainly(&variant.value);
            let differs = match &variant.value {
                Value::Table(_) => value,
                _ => format!("{} = {value}", &variant.path),
            };
            let label = match several {
                true => format!("{}, {differs}", plugin.name),
                false => differs,
            };
            samples.push(specimen(plugin, &table, label)?);
        }
    }
    Ok(samples)
}

fn specimen(plugin: &PluginInfo, table: &Table, label: String) -> Result<LawSample, Trouble> {
    let law = rheometer::law(plugin.name, table).map_err(|e| match e {
        RegistryError::Parameters(problems) => {
            let each = problems.iter().map(|p| match p.path.as_str() {
                "" => p.message.clone(),
                path => format!("{path}: {}", p.message),
            });
            format!("{}: {}", plugin.name, each.collect::<Vec<_>>().join("; "))
        }
        other => other.to_string(),
    })?;
    Ok(LawSample { label, law })
}

/// Law that an override is for, and the override within its own table.
fn addressed(plugins: &[PluginInfo], set: &Override) -> Result<(usize, Override), Trouble> {
    if plugins.len() == 1 {
        return Ok((0, set.clone()));
    }
    let told = |why: String| format!("{}: {why}", &set.text);
    let names = || plugins.iter().map(|p| p.name);
    let (first, rest) = set.path.split_once('.').unwrap_or((&set.path, ""));
    let number = names().position(|name| name == first).ok_or_else(|| {
        let (near, known) = (suggestion(first, names()), comma_list(names()));
        told(format!("`{first}` is none of the laws to be drawn{near} (they are {known}; write LAW.KEY=VALUE)"))
    })?;
    let inside = Override::new(rest, set.value.clone());
    Ok((number, inside.map_err(|p| told(p.message))?))
}

/// The parameters of the example in a law's documentation; none if there is no example.
fn example(plugin: &PluginInfo) -> Table {
    let schema = (plugin.schema)();
    let found = || {
        let (_, block) = schema["description"].as_str()?.split_once("```toml")?;
        let scene: Table = block.split("```").next()?.parse().ok()?;
        let phase = scene.get("phase")?.as_table()?.values().next()?;
        phase.get("rheology")?.get(plugin.name)?.as_table().cloned()
    };
    found().unwrap_or_default()
}

/// Form of a value of `--vary` in a legend: `{a = {b = 1}}` as `a b = 1`.
fn plainly(value: &Value) -> String {
    let entry = |(key, value): (&String, &Value)| match value {
        Value::Table(_) => format!("{key} {}", plainly(value)),
        other => format!("{key} = {}", plainly(other)),
    };
    match value {
        Value::Table(keys) => comma_list(keys.iter().map(entry)),
        Value::String(text) => text.clone(),
        Value::Float(x) => number::plain(*x),
        other => other.to_string(),
    }
}

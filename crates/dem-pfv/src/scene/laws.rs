//! Contact laws and conductances by name.

use scene_text::{OnePlugin, SceneProblem, conform, suggestion};
use serde_json::Value as Json;
use toml::Value;

use crate::Entry;
use crate::flow::{Conductance, HydraulicRadius, conductance, conductances};
use crate::grains::{ContactLaw, contact_law, contact_laws};
use crate::scene::error::DemError;
use crate::scene::tables::{Plugins, Scene};

inventory::submit! {
    OnePlugin(|| {
        vec![
            vec!["grains", "contact"],
            vec!["start", "contact"],
            vec!["start", "wall_contact"],
            vec!["box", "contact"],
            vec!["wall", "*", "contact"],
            vec!["fluid", "conductance"],
        ]
    })
}

/// The laws of a system, and which of them each wall follows.
#[derive(Debug)]
pub struct Laws {
    /// The first is that of grains with each other.
    pub all: Vec<Box<dyn ContactLaw>>,
    /// Laws during the preparation, with the numbers of those that they stand for.
    pub prepared: Vec<(usize, Box<dyn ContactLaw>)>,
    /// Number of the law of walls and surfaces outside the box.
    pub of_others: usize,
    /// Number of the law of the walls of the box.
    pub of_box: usize,
    /// Numbers of the laws of `[wall.NAME]`, in their order.
    pub of_walls: Vec<Option<usize>>,
}

/// The only plugin of a table, its parameters in SI.
fn chosen<L: ?Sized>(
    plugins: &Plugins,
    path: &str,
    what: &str,
    entries: &[&Entry<L>],
) -> Result<Option<(String, Json, String)>, DemError> {
    let Some((name, table)) = plugins.first_key_value() else {
        return Ok(None);
    };
    if plugins.len() > 1 {
        let names: Vec<_> = plugins.keys().map(|n| format!("`{n}`")).collect();
        let message = format!("one {what} is needed, there are {}", names.join(", "));
        return Err(DemError::at(path, message));
    }
    let inside = format!("{path}.{name}");
    let Some(entry) = entries.iter().find(|e| e.name == *name) else {
        let names = || entries.iter().map(|e| e.name);
        let near = suggestion(name, names());
        let known = names().collect::<Vec<_>>().join(", ");
        let message = format!("there is no {what} called `{name}`{near} (registered: {known})");
        return Err(DemError::at(inside, message));
    };
    let mut value = Value::Table(table.clone());
    conform(&mut value, &(entry.schema)()).map_err(|problems| {
        let moved = |p: SceneProblem| {
            let path = match p.path.as_str() {
                "" => inside.clone(),
                key => format!("{inside}.{key}"),
            };
            SceneProblem::new(path, p.message)
        };
        DemError::Scene(problems.into_iter().map(moved).collect())
    })?;
    let json = serde_json::to_value(value).map_err(|e| DemError::at(&inside, e))?;
    Ok(Some((name.clone(), json, inside)))
}

fn contact(plugins: &Plugins, path: &str) -> Result<Option<Box<dyn ContactLaw>>, DemError> {
    let Some((name, json, inside)) = chosen(plugins, path, "contact law", &contact_laws())? else {
        return Ok(None);
    };
    let law = contact_law(&name, &json).map_err(|e| DemError::at(inside, e))?;
    Ok(Some(law))
}

impl Laws {
    /// All laws that a scene names.
    ///
    /// # Errors
    /// No law for the grains; unknown laws and parameters.
    pub fn from_scene(scene: &Scene) -> Result<Self, DemError> {
        let Some(between) = contact(&scene.grains.contact, "grains.contact")? else {
            let names: Vec<_> = contact_laws().iter().map(|e| e.name).collect();
            let names = names.join(", ");
            let message =
                format!("a contact law is missing: [grains.contact.LAW] with one of {names}");
            return Err(DemError::at("grains", message));
        };
        let mut all = vec![between];
        let prepared_wall = || contact(&scene.start.wall_contact, "start.wall_contact");
        let mut of_others = 0;
        if prepared_wall()?.is_some() {
            // A law of their own, so that another can stand for it.
            of_others = all.len();
            all.extend(contact(&scene.grains.contact, "grains.contact")?);
        }
        let mut of_box = of_others;
        if let Some(given) = &scene.r#box
            && let Some(law) = contact(&given.contact, "box.contact")?
        {
            of_box = all.len();
            all.push(law);
        }
        let mut of_walls = Vec::new();
        for (name, wall) in &scene.wall {
            let law = contact(&wall.contact, &format!("wall.{name}.contact"))?;
            of_walls.push(law.map(|law| {
                all.push(law);
                all.len() - 1
            }));
        }
        let mut prepared = Vec::new();
        prepared.extend(contact(&scene.start.contact, "start.contact")?.map(|law| (0, law)));
        for number in 1..all.len() {
            prepared.extend(prepared_wall()?.map(|law| (number, law)));
        }
        Ok(Self {
            all,
            prepared,
            of_others,
            of_box,
            of_walls,
        })
    }
}

/// The law for the conductance of throats.
///
/// # Errors
/// Unknown laws and parameters.
pub fn throats(scene: &Scene) -> Result<Box<dyn Conductance>, DemError> {
    let none = Plugins::new();
    let given = scene.fluid.as_ref().map_or(&none, |f| &f.conductance);
    match chosen(given, "fluid.conductance", "conductance", &conductances())? {
        None => Ok(Box::new(HydraulicRadius::default())),
        Some((name, json, inside)) => {
            conductance(&name, &json).map_err(|e| DemError::at(inside, e))
        }
    }
}

/// Name and parameters of a plugin that a scene names, for listings.
pub(crate) fn listing(plugins: &Plugins) -> Option<(String, Json)> {
    let (name, table) = plugins.first_key_value()?;
    let json = serde_json::to_value(table).unwrap_or(Json::Null);
    Some((name.clone(), json))
}

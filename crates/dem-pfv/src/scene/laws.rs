//! Contact laws and conductances by name.

use std::collections::BTreeMap;

use scene_text::OnePlugin;
use sph_core::reexport::inventory;
use sph_core::{Makes, PluginChoice, Registry, RegistryError, plugins_of};

use crate::flow::{Conductance, ConductanceEntry, HydraulicRadius};
use crate::grains::{ContactLaw, ContactLawEntry};
use crate::scene::{DemError, Plugins, Scene};

inventory::submit! {
    OnePlugin(|| {
        let contacts = ["grains.contact", "start.contact", "start.wall_contact", "box.contact"];
        let others = ["wall.*.contact", "fluid.conductance"];
        let paths = contacts.into_iter().chain(others);
        paths.map(|path| path.split('.').collect()).collect()
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
    /// Numbers of the laws of walls that have one of their own.
    pub of_walls: BTreeMap<String, usize>,
}

/// The only plugin of a table.
fn chosen<E: Makes<3>>(plugins: &Plugins, path: &str) -> Result<Option<Box<E::Made>>, DemError> {
    let Some((name, table)) = plugins.first_key_value() else {
        return Ok(None);
    };
    if plugins.len() > 1 {
        let names: Vec<_> = plugins.keys().map(|n| format!("`{n}`")).collect();
        let what = E::KIND.name.replace('-', " ");
        let message = format!("one {what} is needed, there are {}", names.join(", "));
        return Err(DemError::at(path, message));
    }
    let inside = format!("{path}.{name}");
    let choice = PluginChoice {
        kind: E::KIND.name,
        name: name.clone(),
        table: table.clone(),
        name_path: inside.clone(),
        path: inside,
    };
    let refused = |e: RegistryError| DemError::Scene(choice.scene_problems(&e));
    let registry = Registry::<E>::discovered().map_err(refused)?;
    let made = registry.find(name).and_then(|entry| entry.make(table));
    Ok(Some(made.map_err(refused)?))
}

fn contact(plugins: &Plugins, path: &str) -> Result<Option<Box<dyn ContactLaw>>, DemError> {
    let law = chosen::<ContactLawEntry>(plugins, path)?;
    for (law, name) in law.iter().zip(plugins.keys()) {
        let checked = law.check();
        checked.map_err(|e| DemError::at(format!("{path}.{name}"), e))?;
    }
    Ok(law)
}

impl Laws {
    /// All laws that a scene names.
    pub fn from_scene(scene: &Scene) -> Result<Self, DemError> {
        let Some(between) = contact(&scene.grains.contact, "grains.contact")? else {
            let names = plugins_of::<ContactLawEntry>();
            let names: Vec<_> = names.iter().map(|p| p.name).collect();
            let missing = "a contact law is missing: [grains.contact.LAW] with one of";
            let message = format!("{missing} {}", names.join(", "));
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
        let mut of_walls = BTreeMap::new();
        for (name, wall) in &scene.wall {
            if let Some(law) = contact(&wall.contact, &format!("wall.{name}.contact"))? {
                of_walls.insert(name.clone(), all.len());
                all.push(law);
            }
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
pub fn throats(scene: &Scene) -> Result<Box<dyn Conductance>, DemError> {
    let none = Plugins::new();
    let given = scene.fluid.as_ref().map_or(&none, |f| &f.conductance);
    let law = chosen::<ConductanceEntry>(given, "fluid.conductance")?;
    Ok(law.unwrap_or_else(|| Box::new(HydraulicRadius::default())))
}

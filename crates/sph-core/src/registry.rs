//! Plugins: contracts, entries, discovery through `inventory`, and a registry without globals.

use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use toml::{Table, Value};

use crate::{PluginInfo, PluginKind, RegistryError, SceneProblem, conform};

/// One parameter of a plugin, for listings.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Parameter {
    /// Key in the scene.
    pub name: String,
    /// Type as the schema names it, `table`, or `choice`.
    pub kind: String,
    /// SI unit, "1" or empty where there is none.
    pub unit: String,
    /// Default value, if the key may be left out.
    pub default: Option<Json>,
    /// Its meaning.
    pub meaning: String,
    /// Its source.
    pub source: String,
}

/// The node of a schema that describes a parameter: the parameter itself, or the definition that it refers to.
pub fn node_of<'s>(parameter: &'s Json, schema: &'s Json) -> &'s Json {
    let name = parameter["$ref"].as_str();
    let name = name.or_else(|| parameter["anyOf"][0]["$ref"].as_str());
    let defined = name.and_then(|name| schema.pointer(name.strip_prefix('#')?));
    defined.unwrap_or(parameter)
}

/// The parameters that a schema describes.
pub fn parameters(schema: &Json) -> Vec<Parameter> {
    let text = |p: &Json, key: &str| {
        let found = p.get(key).and_then(Json::as_str);
        found.unwrap_or_default().replace('\n', " ")
    };
    let properties = schema.get("properties").and_then(Json::as_object);
    properties
        .into_iter()
        .flatten()
        .map(|(name, p)| Parameter {
            name: name.clone(),
            kind: match &node_of(p, schema)["type"] {
                Json::String(kind) if kind == "object" => "table".to_string(),
                Json::String(kind) if p.get("type").is_some() => kind.clone(),
                Json::Array(kinds) => kinds[0].as_str().unwrap_or_default().to_string(),
                _ => "choice".to_string(),
            },
            unit: text(p, "unit"),
            default: p.get("default").cloned(),
            meaning: text(p, "description"),
            source: text(p, "source"),
        })
        .collect()
}

/// A kind of plugin: the type of its entries and where the discovered ones are.
pub trait Contract: Sized + 'static {
    /// The kind.
    const KIND: PluginKind;
    /// Entries registered in any crate that the binary mentions.
    fn discovered() -> Vec<&'static Self>;
    /// Data known without building.
    fn info(&self) -> &PluginInfo;
}

/// The plugins of one kind that may be named.
pub struct Registry<E: Contract> {
    entries: Vec<&'static E>,
}

impl<E: Contract> Registry<E> {
    /// Every plugin of the kind in this binary.
    ///
    /// # Errors
    /// If two have the same name, as below.
    pub fn discovered() -> Result<Self, RegistryError> {
        Self::from_entries(E::discovered())
    }

    /// These plugins alone; global registrations are ignored.
    pub fn from_entries(mut entries: Vec<&'static E>) -> Result<Self, RegistryError> {
        entries.sort_by_key(|e| e.info().name);
        for two in entries.windows(2).map(|two| [two[0], two[1]].map(E::info)) {
            if two[0].name == two[1].name {
                let (kind, name) = (E::KIND.name, two[0].name);
                let providers = two.map(|info| info.provider);
                return Err(RegistryError::Duplicate {
                    kind,
                    name,
                    providers,
                });
            }
        }
        Ok(Registry { entries })
    }

    /// The plugin of that name.
    ///
    /// # Errors
    /// An unknown name; the message lists the known names and the nearest one.
    pub fn find(&self, name: &str) -> Result<&'static E, RegistryError> {
        let names = self.entries.iter().map(|e| e.info().name);
        let found = self.entries.iter().find(|e| e.info().name == name);
        let unknown = || RegistryError::unknown(E::KIND.name, name, names);
        found.copied().ok_or_else(unknown)
    }

    /// All entries, sorted by name.
    pub fn entries(&self) -> &[&'static E] {
        &self.entries
    }
}

/// A plugin of the scene, with its parameters as they stand in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct PluginChoice {
    /// Kind of plugin: "kernel", "rheology", "probe", …
    pub kind: &'static str,
    /// Name of the plugin.
    pub name: String,
    /// Its parameters, unchecked.
    pub table: Table,
    /// Path of the parameter table in the scene.
    pub path: String,
    /// Path of the key or value that gives the plugin's name.
    pub name_path: String,
}

impl PluginChoice {
    /// A plugin with no parameters that the scene does not mention: a solver's default.
    pub fn default_of(kind: &'static str, name: &str) -> Self {
        PluginChoice {
            kind,
            name: name.to_string(),
            table: Table::new(),
            path: format!("{kind}.{name}"),
            name_path: format!("{kind}.{name}"),
        }
    }

    /// Turns the refusal of a registry or plugin into problems of the scene.
    pub fn scene_problems(&self, error: &RegistryError) -> Vec<SceneProblem> {
        match error {
            RegistryError::Parameters(problems) => problems
                .iter()
                .map(|p| SceneProblem::new(self.inside(&p.path), p.message.clone()))
                .collect(),
            other => vec![SceneProblem::new(self.name_path.clone(), other.to_string())],
        }
    }

    /// The scene's path of a key of this plugin's table.
    pub fn inside(&self, key: &str) -> String {
        match key {
            "" => self.path.clone(),
            key if key.starts_with('[') => format!("{}{key}", self.path),
            key => format!("{}.{key}", self.path),
        }
    }
}

/// Builds a plugin from its table of parameters.
pub type Build<T> = fn(&Table) -> Result<Box<T>, RegistryError>;

/// A kind of plugin, its plugins built by one call of any dimension: of D, or of none of their own.
pub trait Makes<const D: usize>: Contract {
    /// Description of a plugin of the kind.
    type Made: ?Sized;
    /// Builds the plugin from its table of parameters.
    ///
    /// # Errors
    /// If a parameter is wrong or the plugin has no form in D dimensions.
    fn make(&self, table: &Table) -> Result<Box<Self::Made>, RegistryError>;
}

/// Typed parameters from a table: checked against the type's own schema, units converted.
///
/// # Errors
/// Every unknown key, wrong type, wrong unit and value out of range.
pub fn typed<P: DeserializeOwned + JsonSchema>(table: &Table) -> Result<P, RegistryError> {
    let mut value = Value::Table(table.clone());
    conform(&mut value, &schema_of::<P>()).map_err(RegistryError::Parameters)?;
    value.try_into().map_err(|e: toml::de::Error| {
        RegistryError::Parameters(vec![SceneProblem::new("", e.message())])
    })
}

/// The JSON schema of a parameter type; that of a transparent wrapper has the parameters of the type within and its own
/// text.
pub fn schema_of<P: JsonSchema>() -> Json {
    let mut schema = schemars::schema_for!(P).to_value();
    while let Some(Json::String(within)) = schema.get("$ref") {
        let name = within.trim_start_matches("#/$defs/").to_string();
        let of = schema.get_mut("$defs").and_then(Json::as_object_mut);
        let Some(mut found) = of.and_then(|of| of.remove(&name)) else {
            break;
        };
        for key in ["$defs", "$schema", "title", "description"] {
            if let Some(own) = schema.get_mut(key) {
                found[key] = own.take();
            }
        }
        schema = found;
    }
    schema
}

/// Declares a kind of plugin: `contract!(/** doc */ pub WallEntry, "walls", One, "what for", Wall<D>, .by_default("usaw"))`
/// for a trait with a dimension, `Kernel` without `<D>` for one without. `One` is a [`Place`](crate::Place); methods of
/// [`PluginKind`](crate::PluginKind) may follow the trait.
#[macro_export]
macro_rules! contract {
    (
        $(#[$doc:meta])* $vis:vis $entry:ident, $kind:literal, $place:ident, $purpose:literal, $tr:ident<D>
        $(, $($more:tt)*)?
    ) => {
        $(#[$doc])*
        $vis struct $entry {
            /// Data known without building.
            pub info: $crate::PluginInfo,
            /// Builds the two-dimensional form.
            pub build_2d: Option<$crate::Build<dyn $tr<2>>>,
            /// Builds the three-dimensional form.
            pub build_3d: Option<$crate::Build<dyn $tr<3>>>,
        }
        impl $entry {
            /// Builds the plugin in D dimensions from its table of parameters.
            ///
            /// # Errors
            /// If a parameter is wrong or the plugin has no form in that dimension.
            pub fn build<const D: usize>(
                &self,
                table: &$crate::reexport::toml::Table,
            ) -> Result<Box<dyn $tr<D>>, $crate::RegistryError> {
                let absent = || $crate::RegistryError::Dimension($kind, self.info.name, D);
                let built: Box<dyn std::any::Any> = match D {
                    2 => Box::new(self.build_2d.ok_or_else(absent)?(table)?),
                    3 => Box::new(self.build_3d.ok_or_else(absent)?(table)?),
                    _ => return Err(absent()),
                };
                built.downcast::<Box<dyn $tr<D>>>().map(|b| *b).map_err(|_| absent())
            }
        }
        impl<const D: usize> $crate::Makes<D> for $entry {
            type Made = dyn $tr<D>;
            fn make(
                &self,
                table: &$crate::reexport::toml::Table,
            ) -> Result<Box<dyn $tr<D>>, $crate::RegistryError> {
                self.build::<D>(table)
            }
        }
        $crate::contract!(@common $entry, $kind, $place, $purpose, $($($more)*)?);
    };
    (
        $(#[$doc:meta])* $vis:vis $entry:ident, $kind:literal, $place:ident, $purpose:literal, $tr:ident
        $(, $($more:tt)*)?
    ) => {
        $(#[$doc])*
        $vis struct $entry {
            /// Data known without building.
            pub info: $crate::PluginInfo,
            /// Builds the plugin from its table of parameters.
            pub build: $crate::Build<dyn $tr>,
        }
        impl<const D: usize> $crate::Makes<D> for $entry {
            type Made = dyn $tr;
            fn make(
                &self,
                table: &$crate::reexport::toml::Table,
            ) -> Result<Box<dyn $tr>, $crate::RegistryError> {
                (self.build)(table)
            }
        }
        $crate::contract!(@common $entry, $kind, $place, $purpose, $($($more)*)?);
    };
    (@common $entry:ident, $kind:literal, $place:ident, $purpose:literal, $($more:tt)*) => {
        impl $crate::Contract for $entry {
            const KIND: $crate::PluginKind =
                $crate::PluginKind::new($kind, $crate::Place::$place, $purpose) $($more)*;
            fn discovered() -> Vec<&'static Self> {
                $crate::reexport::inventory::iter::<$entry>.into_iter().collect()
            }
            fn info(&self) -> &$crate::PluginInfo {
                &self.info
            }
        }
        $crate::reexport::inventory::collect!($entry);
        $crate::reexport::inventory::submit! {
            <$entry as $crate::Contract>::KIND.with_plugins($crate::plugins_of::<$entry>)
        }
    };
}

/// The discovered plugins of a kind, by name.
pub fn plugins_of<E: Contract>() -> Vec<PluginInfo> {
    let mut all: Vec<_> = E::discovered().iter().map(|e| *e.info()).collect();
    all.sort_by_key(|info| info.name);
    all
}

//! Laws as plugins: registered in any crate, found by name, built from a table of parameters.

use inventory::Collect;
use serde_json::Value as Json;
use thiserror::Error;

/// A registered law of the kind `L`, such as `dyn ContactLaw`.
pub struct Entry<L: ?Sized + 'static> {
    /// Its name in scenes.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Publication and equation.
    pub source: &'static str,
    /// Crate and version that registered it.
    pub provider: &'static str,
    /// JSON schema of its parameters, with their units.
    pub schema: fn() -> Json,
    /// Builds it from its parameters without checking their values, or names those that are not understood.
    pub build: fn(&Json) -> Result<Box<L>, String>,
}

/// Laws that cannot be found by name, or built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PluginError {
    /// No law of that name.
    #[error("there is no {kind} {name:?}; there are: {known}")]
    Unknown {
        /// Description of the law.
        kind: &'static str,
        /// The name.
        name: String,
        /// Those that are known.
        known: String,
    },
    /// Two laws of the same name.
    #[error("both {first} and {second} register a {kind} {name:?}")]
    Two {
        /// Description of the kind of laws.
        kind: &'static str,
        /// Their name.
        name: &'static str,
        /// A crate.
        first: &'static str,
        /// Another.
        second: &'static str,
    },
    /// A table of parameters that a law does not understand.
    #[error("the parameters of the {kind} {name:?}: {problem}")]
    Parameters {
        /// Description of the law.
        kind: &'static str,
        /// Its name.
        name: &'static str,
        /// The fault.
        problem: String,
    },
}

/// Every law of a kind that is registered in this binary, sorted by name.
pub(crate) fn entries<L: ?Sized>() -> Vec<&'static Entry<L>>
where
    Entry<L>: Collect,
{
    let mut all: Vec<_> = inventory::iter::<Entry<L>>.into_iter().collect();
    all.sort_by_key(|entry| (entry.name, entry.provider));
    all
}

/// The law of a name with these parameters (a JSON object, SI units), whose values are not checked.
pub(crate) fn built<L: ?Sized>(
    kind: &'static str,
    name: &str,
    parameters: &Json,
) -> Result<Box<L>, PluginError>
where
    Entry<L>: Collect,
{
    let all = entries::<L>();
    let mut named = all.iter().filter(|entry| entry.name == name);
    let Some(entry) = named.next() else {
        let known: Vec<_> = all.iter().map(|entry| entry.name).collect();
        return Err(PluginError::Unknown {
            kind,
            name: name.to_string(),
            known: known.join(", "),
        });
    };
    if let Some(other) = named.next() {
        return Err(PluginError::Two {
            kind,
            name: entry.name,
            first: entry.provider,
            second: other.provider,
        });
    }
    (entry.build)(parameters).map_err(|problem| PluginError::Parameters {
        kind,
        name: entry.name,
        problem,
    })
}

/// Registers a law: `register_law!(Type as Kind, "name", "summary", "source")`, where the kind is
/// [`ContactLaw`](crate::grains::ContactLaw) or [`Conductance`](crate::flow::Conductance), and the type of that kind,
/// `serde::Deserialize` and `schemars::JsonSchema`.
#[macro_export]
macro_rules! register_law {
    ($law:ty as $kind:path, $name:literal, $summary:literal, $source:literal) => {
        $crate::reexport::inventory::submit! {
            $crate::Entry::<dyn $kind> {
                name: $name,
                summary: $summary,
                source: $source,
                provider: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")),
                schema: || $crate::reexport::schemars::schema_for!($law).to_value(),
                build: |parameters| {
                    match <$law as $crate::reexport::serde::Deserialize>::deserialize(parameters) {
                        Ok(law) => Ok(Box::new(law)),
                        Err(problem) => Err(problem.to_string()),
                    }
                },
            }
        }
    };
}

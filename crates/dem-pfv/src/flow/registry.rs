//! Conductances as plugins: registered in any crate, built by name from a table of parameters.

use serde_json::Value as Json;

use crate::flow::{Conductance, FlowError};

/// A registered conductance.
pub struct ConductanceEntry {
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
    /// Builds it from its parameters, without checking their values.
    pub build: fn(&Json) -> Result<Box<dyn Conductance>, FlowError>,
}

inventory::collect!(ConductanceEntry);

/// Every conductance registered in this binary, sorted by name.
#[must_use]
pub fn conductances() -> Vec<&'static ConductanceEntry> {
    let mut all: Vec<_> = inventory::iter::<ConductanceEntry>.into_iter().collect();
    all.sort_by_key(|entry| (entry.name, entry.provider));
    all
}

/// The conductance of that name with these parameters (a JSON object, SI units).
///
/// # Errors
/// None or two of that name; an unknown parameter; a value out of range.
///
/// ```
/// use serde_json::json;
///
/// assert!(dem_pfv::flow::conductance("hydraulic-radius", &json!({ "shape_factor": 0.5 })).is_ok());
/// let refused = dem_pfv::flow::conductance("hydraulic-radius", &json!({ "shape_factor": -1.0 }));
/// assert!(refused.err().is_some_and(|e| e.to_string().contains("shape factor")));
/// ```
pub fn conductance(name: &str, parameters: &Json) -> Result<Box<dyn Conductance>, FlowError> {
    let all = conductances();
    let mut named = all.iter().filter(|entry| entry.name == name);
    let Some(entry) = named.next() else {
        let known: Vec<_> = all.iter().map(|entry| entry.name).collect();
        return Err(FlowError::UnknownConductance {
            name: name.to_string(),
            known: known.join(", "),
        });
    };
    if let Some(other) = named.next() {
        return Err(FlowError::TwoConductances {
            name: entry.name,
            first: entry.provider,
            second: other.provider,
        });
    }
    let law = (entry.build)(parameters)?;
    law.check()?;
    Ok(law)
}

/// Registers a conductance: `register_conductance!(Type, "name", "summary", "source")`, where the type is a
/// [`Conductance`], `serde::Deserialize` and `schemars::JsonSchema`.
#[macro_export]
macro_rules! register_conductance {
    ($law:ty, $name:literal, $summary:literal, $source:literal) => {
        $crate::reexport::inventory::submit! {
            $crate::flow::ConductanceEntry {
                name: $name,
                summary: $summary,
                source: $source,
                provider: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")),
                schema: || $crate::reexport::schemars::schema_for!($law).to_value(),
                build: |parameters| {
                    let read = <$law as $crate::reexport::serde::Deserialize>::deserialize(parameters);
                    match read {
                        Ok(law) => Ok(Box::new(law)),
                        Err(problem) => Err($crate::flow::FlowError::Parameters {
                            name: $name,
                            problem: problem.to_string(),
                        }),
                    }
                },
            }
        }
    };
}

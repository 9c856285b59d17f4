//! Contact laws as plugins: found by name wherever they are registered.

use serde_json::Value as Json;

use crate::grains::{ContactLaw, GrainError};

/// A registered contact law.
pub struct LawEntry {
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
    pub build: fn(&Json) -> Result<Box<dyn ContactLaw>, GrainError>,
}

inventory::collect!(LawEntry);

/// Every contact law registered in this binary, sorted by name.
#[must_use]
pub fn contact_laws() -> Vec<&'static LawEntry> {
    let mut all: Vec<_> = inventory::iter::<LawEntry>.into_iter().collect();
    all.sort_by_key(|entry| (entry.name, entry.provider));
    all
}

/// The contact law of that name with these parameters (a JSON object, SI units).
///
/// # Errors
/// No law or two of that name; an unknown or missing parameter; a value out of range.
///
/// ```
/// use serde_json::json;
///
/// let table = json!({ "modulus": 15e6, "stiffness_ratio": 0.5, "friction": 0.577 });
/// let law = dem_pfv::grains::contact_law("linear-elastic", &table)?;
/// assert_eq!(law.stiffness([0.1, 0.1], 0.0).normal, 1.5e6);
/// # Ok::<(), dem_pfv::grains::GrainError>(())
/// ```
pub fn contact_law(name: &str, parameters: &Json) -> Result<Box<dyn ContactLaw>, GrainError> {
    let all = contact_laws();
    let mut named = all.iter().filter(|entry| entry.name == name);
    let Some(entry) = named.next() else {
        let known: Vec<_> = all.iter().map(|entry| entry.name).collect();
        return Err(GrainError::UnknownLaw {
            name: name.to_string(),
            known: known.join(", "),
        });
    };
    if let Some(other) = named.next() {
        return Err(GrainError::TwoLaws {
            name: entry.name,
            first: entry.provider,
            second: other.provider,
        });
    }
    let law = (entry.build)(parameters)?;
    law.check()?;
    Ok(law)
}

/// Registers a contact law: `register_law!(Type, "name", "summary", "source")`, where the type
/// is a [`ContactLaw`], `serde::Deserialize` and `schemars::JsonSchema`.
#[macro_export]
macro_rules! register_law {
    ($law:ty, $name:literal, $summary:literal, $source:literal) => {
        $crate::reexport::inventory::submit! {
            $crate::grains::LawEntry {
                name: $name,
                summary: $summary,
                source: $source,
                provider: concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION")),
                schema: || $crate::reexport::schemars::schema_for!($law).to_value(),
                build: |parameters| {
                    let read = <$law as $crate::reexport::serde::Deserialize>::deserialize(parameters);
                    match read {
                        Ok(law) => Ok(Box::new(law)),
                        Err(problem) => Err($crate::grains::GrainError::Parameters {
                            name: $name,
                            problem: problem.to_string(),
                        }),
                    }
                },
            }
        }
    };
}

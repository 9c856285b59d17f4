//! Natures of the laws that scenes name.

use sph_core::{LawNature, LawNatures, Registry, reexport::inventory, reexport::toml::Table};

use crate::{Rheology, RheologyEntry};

inventory::submit! {
    LawNatures(nature)
}

/// The nature of a law by its name and parameters; none of one that cannot be built.
fn nature(name: &str, parameters: &Table) -> Option<LawNature> {
    let laws = Registry::<RheologyEntry>::discovered().ok()?;
    let law: Box<dyn Rheology> = (laws.find(name).ok()?.build)(parameters).ok()?;
    Some(match (law.needs().pressure, law.elastic()) {
        (true, _) => LawNature::Soil,
        (false, Some(_)) => LawNature::Elastic,
        (false, None) => LawNature::Fluid,
    })
}

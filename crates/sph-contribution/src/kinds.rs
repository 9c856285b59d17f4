//! Kinds of plugins that bring contributions.

use sph_core::reexport::inventory;
use sph_core::{PluginInfo, RegistryError};
use toml::Table;

use crate::Contribution;

/// A contribution with what is known of its plugin.
pub type Built<const D: usize> = (Box<dyn Contribution<D>>, PluginInfo);

/// A kind of plugin whose plugins are contributions; submitted by [`contribution_kind!`](crate::contribution_kind).
pub struct OpenKind {
    /// Name in scene files.
    pub kind: &'static str,
    /// Builds a plugin of that name from its parameters, in two dimensions.
    pub build_2d: fn(&str, &Table) -> Result<Built<2>, RegistryError>,
    /// The same in three dimensions.
    pub build_3d: fn(&str, &Table) -> Result<Built<3>, RegistryError>,
}
inventory::collect!(OpenKind);

impl OpenKind {
    /// Builds a plugin from its parameters.
    ///
    /// # Errors
    /// If there is none of that name, it has no form in D dimensions, or a parameter is wrong.
    pub fn build<const D: usize>(
        &self,
        name: &str,
        table: &Table,
    ) -> Result<Built<D>, RegistryError> {
        let built: Box<dyn std::any::Any> = match D {
            2 => Box::new((self.build_2d)(name, table)?),
            _ => Box::new((self.build_3d)(name, table)?),
        };
        built
            .downcast::<Built<D>>()
            .map(|built| *built)
            .map_err(|_| RegistryError::Dimension {
                kind: self.kind,
                name: "contribution",
                dimension: D,
            })
    }
}

/// Every kind of contribution in this binary, by name.
pub fn open_kinds() -> Vec<&'static OpenKind> {
    let mut all: Vec<_> = inventory::iter::<OpenKind>.into_iter().collect();
    all.sort_by_key(|k| k.kind);
    all
}

/// Declares a kind whose plugins are contributions:
/// `contribution_kind!(/** doc */ pub TracerEntry, "tracer", Any, "what for", "none if left out")`. `One` instead of
/// `Any` where a scene may have one plugin of it. [`Contribution`] has to be in scope.
///
/// Without place and absence for a kind that `sph_core::kinds` lists itself.
#[macro_export]
macro_rules! contribution_kind {
    ($(#[$doc:meta])* $vis:vis $entry:ident, $kind:literal, $place:ident, $purpose:literal, $absent:literal) => {
        $crate::contribution_kind!($(#[$doc])* $vis $entry, $kind, $purpose);
        $crate::reexport::sph_core::kind!($kind, $place, $absent);
    };
    ($(#[$doc:meta])* $vis:vis $entry:ident, $kind:literal, $purpose:literal) => {
        $crate::reexport::sph_core::contract!(
            $(#[$doc])*
            $vis $entry, $kind, $purpose, Contribution<D>
        );
        $crate::reexport::inventory::submit! {
            $crate::OpenKind {
                kind: $kind,
                build_2d: |name, table| {
                    let registry = $crate::reexport::sph_core::Registry::<$entry>::discovered()?;
                    let entry = registry.find(name)?;
                    Ok((entry.build::<2>(table)?, entry.info))
                },
                build_3d: |name, table| {
                    let registry = $crate::reexport::sph_core::Registry::<$entry>::discovered()?;
                    let entry = registry.find(name)?;
                    Ok((entry.build::<3>(table)?, entry.info))
                },
            }
        }
    };
}

//! Kinds of plugins that bring contributions; pair terms that a scene names itself.

use sph_core::reexport::inventory;
use sph_neighbours::{TermEntry, Terms};

use crate::{Contribution, Offer, Plugins, Refusal, Setting};

/// Contributions with the name of their kind.
pub type Part<const D: usize> = (&'static str, Box<dyn Contribution<D>>);

/// Contributions of the plugins of a kind to a flow.
pub struct Contributor {
    /// Name of the kind.
    pub kind: &'static str,
    /// Contributions to flows in two dimensions.
    pub in_2d: fn(&Plugins) -> Vec<Box<dyn Contribution<2>>>,
    /// Contributions to flows in three dimensions.
    pub in_3d: fn(&Plugins) -> Vec<Box<dyn Contribution<3>>>,
}
inventory::collect!(Contributor);

impl Contributor {
    fn parts<const D: usize>(&self, plugins: &Plugins) -> Vec<Part<D>> {
        let all: Box<dyn std::any::Any> = match D {
            2 => Box::new((self.in_2d)(plugins)),
            _ => Box::new((self.in_3d)(plugins)),
        };
        let all = all.downcast::<Vec<Box<dyn Contribution<D>>>>();
        let all = all.map_or(Vec::new(), |all| *all).into_iter();
        all.map(|part| (self.kind, part)).collect()
    }
}

/// The contributions of all plugins of a scene, in the order of their kinds.
pub fn parts<const D: usize>(plugins: &Plugins) -> Vec<Part<D>> {
    let order = |kind: &str| sph_core::kind_of(kind).map_or(u8::MAX, |kind| kind.order);
    let mut contributors: Vec<_> = inventory::iter::<Contributor>.into_iter().collect();
    contributors.sort_by_key(|c| (order(c.kind), c.kind));
    let each = contributors.into_iter();
    each.flat_map(|c| c.parts::<D>(plugins)).collect()
}

/// True if plugins of a kind contribute to flows.
pub fn contributes(kind: &str) -> bool {
    let mut all = inventory::iter::<Contributor>.into_iter();
    all.any(|contributor| contributor.kind == kind)
}

/// A contribution that a kind makes of the plugins of a scene, its own and those of other kinds.
pub trait FromPlugins<const D: usize>: Contribution<D> + Sized + 'static {
    /// The contribution; none where the scene has no use for it, or where a plugin could not be built.
    fn from_plugins(plugins: &Plugins) -> Option<Self>;

    /// As a [`Contributor`] has it.
    #[doc(hidden)]
    fn boxed(plugins: &Plugins) -> Vec<Box<dyn Contribution<D>>> {
        let made = Self::from_plugins(plugins).into_iter();
        made.map(|made| Box::new(made) as _).collect()
    }
}

/// Declares the contribution of a kind: `contributes!("formulation", Compressible)` for a type `Compressible<D>` that
/// is [`FromPlugins`].
#[macro_export]
macro_rules! contributes {
    ($kind:literal, $made:ident) => {
        $crate::reexport::inventory::submit! {
            $crate::Contributor {
                kind: $kind,
                in_2d: <$made<2> as $crate::FromPlugins<2>>::boxed,
                in_3d: <$made<3> as $crate::FromPlugins<3>>::boxed,
            }
        }
    };
}

/// Declares a kind whose plugins are contributions:
/// `contribution_kind!(/** doc */ pub TracerEntry, "tracer", Any, "what for")`. `One` instead of `Any` where a scene may
/// have one plugin of it. Methods of [`PluginKind`](sph_core::PluginKind) may follow. [`Contribution`] has to be in scope.
#[macro_export]
macro_rules! contribution_kind {
    (
        $(#[$doc:meta])* $vis:vis $entry:ident, $kind:literal, $place:ident, $purpose:literal
        $(, $($more:tt)*)?
    ) => {
        $crate::reexport::sph_core::contract!(
            $(#[$doc])*
            $vis $entry, $kind, $place, $purpose, Contribution<D>, $($($more)*)?
        );
        $crate::reexport::inventory::submit! {
            $crate::Contributor {
                kind: $kind,
                in_2d: $crate::Plugins::all::<2, $entry>,
                in_3d: $crate::Plugins::all::<3, $entry>,
            }
        }
    };
}

/// The plugins of `[term]`.
struct NamedTerms<const D: usize>(Terms<D>);

contributes!("term", NamedTerms);

impl<const D: usize> FromPlugins<D> for NamedTerms<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        Some(NamedTerms(plugins.all::<D, TermEntry>()))
    }
}

impl<const D: usize> Contribution<D> for NamedTerms<D> {
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        offer.terms.append(&mut self.0);
        offer.remedy = Some("look at its parameters".into());
        Ok(())
    }
}

//! Pair terms that a scene names itself.

use sph_neighbours::{TermEntry, Terms};

use crate::{Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, contributes};

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

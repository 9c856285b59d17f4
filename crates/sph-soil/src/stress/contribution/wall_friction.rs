//! Friction of soils on walls in a scene.

use sph_contribution::{Contribution, FromPlugins, Offer, Plugins, Refusal, Setting, contributes};
use sph_rheology::Rheology;

use super::Materials;
use crate::stress::CoulombFriction;

/// Coulomb's friction, where a wall has a coefficient.
struct WallFriction<const D: usize>(Materials<D>);

#[cfg(not(test))]
contributes!("walls", WallFriction);

impl<const D: usize> FromPlugins<D> for WallFriction<D> {
    fn from_plugins(plugins: &Plugins) -> Option<Self> {
        Some(WallFriction(Materials::from_plugins(plugins)?))
    }
}

impl<const D: usize> Contribution<D> for WallFriction<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if setting.world.walls.elements.coulomb.is_empty() {
            return Ok(());
        }
        let slips = |l: &dyn Rheology| l.elastic().is_none() && l.uniform_viscosity().is_some();
        let rubs = self.0.laws.iter().map(|l| !slips(&**l)).collect();
        let pressure = self.0.grain_pressure();
        offer.hook(CoulombFriction::new(rubs, pressure));
        Ok(())
    }
}

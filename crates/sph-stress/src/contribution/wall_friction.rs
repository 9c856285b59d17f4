//! Friction of soils on walls in a scene.

use std::rc::Rc;

use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_rheology::Rheology;

use crate::{CoulombFriction, Materials};

/// Coulomb's friction, where a wall has a coefficient.
pub struct WallFriction<const D: usize>(pub Rc<Materials<D>>);

impl<const D: usize> Contribution<D> for WallFriction<D> {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if setting.world.walls.elements.coulomb.is_empty() {
            return Ok(());
        }
        let slips = |l: &dyn Rheology| l.elastic().is_none() && l.uniform_viscosity().is_some();
        let rubs = self.0.laws.iter().map(|l| !slips(&**l)).collect();
        let pressure = self.0.felt().pressure;
        offer.hook(CoulombFriction::new(rubs, pressure));
        Ok(())
    }
}

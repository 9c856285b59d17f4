//! Friction of soils on walls in a scene.

use std::rc::Rc;

use sph_contribution::{Contribution, Refusal, Setting, StepWork};
use sph_core::AnyField;
use sph_rheology::Rheology;

use crate::{CoulombFriction, Materials};

/// Coulomb's friction, where a wall has a coefficient.
pub struct WallFriction<const D: usize>(pub Rc<Materials<D>>);

impl<const D: usize> Contribution<D> for WallFriction<D> {
    fn works(
        &mut self,
        setting: &Setting<'_, D>,
        _: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        if setting.world.walls.elements.coulomb.is_empty() {
            return Ok(Vec::new());
        }
        let slips = |l: &dyn Rheology| l.elastic().is_none() && l.uniform_viscosity().is_some();
        let rubs = self.0.laws.iter().map(|l| !slips(&**l)).collect();
        let pressure = self.0.felt().pressure;
        Ok(vec![Box::new(CoulombFriction::new(rubs, pressure))])
    }
}

//! Gradients of the velocity in a scene.

use std::rc::Rc;

use sph_contribution::{Contribution, Setting, Stages};
use sph_core::{AnyField, fields};
use sph_neighbours::Terms;

use crate::{Materials, RidingStrain, StrainRate};

/// Velocity gradients and strain rates, where a law or somebody else needs them.
pub struct Straining<const D: usize>(pub Rc<Materials<D>>);

impl<const D: usize> Contribution<D> for Straining<D> {
    fn stages_for(&self, setting: &Setting<'_, D>, read: &[AnyField]) -> Stages<D> {
        let mut stages: Stages<D> = Vec::new();
        // An elastic motion leaves the gradients of its drift.
        if let (Some(stage), None) = (self.0.gradient_stage(read), &self.0.force) {
            stages.push(Box::new(stage));
        }
        if self.0.gradient.is_some() && !self.0.strain_rides(setting, read) {
            stages.push(Box::new(StrainRate));
        }
        stages
    }
    fn riding(&self, setting: &Setting<'_, D>, read: &[AnyField], later: &[AnyField]) -> Terms<D> {
        let wanted =
            later.contains(&fields::STRAIN_RATE.any()) && self.0.strain_rides(setting, read);
        let formula = self.0.gradient.clone().filter(|_| wanted);
        let term = formula.map(|formula| Box::new(RidingStrain { formula }) as _);
        term.into_iter().collect()
    }
}

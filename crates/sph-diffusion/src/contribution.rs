//! Smoothers and shifting in a scene.

use sph_contribution::{Contribution, Limiter, OwnColumn, Refusal, Setting, Stages, StepWork};
use sph_core::{AnyField, fields};
use sph_neighbours::Terms;

use crate::diffusion_limit::fastest;
use crate::{MeanAcceleration, ShiftedFlow, Shifting, Smoother};

/// The smoother that a scene names.
pub struct Smoothed<const D: usize>(pub Box<dyn Smoother<D>>);

impl<const D: usize> Contribution<D> for Smoothed<D> {
    fn columns(&self) -> Vec<OwnColumn<D>> {
        let column = |_| OwnColumn::zero(fields::MEAN_ACCELERATION.any());
        self.0.accelerated().map(column).into_iter().collect()
    }
    fn stages(&self, setting: &Setting<'_, D>) -> Stages<D> {
        self.0.stages(setting.laws)
    }
    fn terms(&self, setting: &Setting<'_, D>) -> Terms<D> {
        vec![self.0.term(setting.laws)]
    }
    fn changes_density(&self, _: &Setting<'_, D>) -> bool {
        true
    }
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        match setting.pressure_ahead && self.0.of_pressures() {
            true => Vec::new(),
            false => self.0.limiter(setting.laws).into_iter().collect(),
        }
    }
    fn works(
        &mut self,
        setting: &Setting<'_, D>,
        _read: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        let mean = |of| Box::new(MeanAcceleration::new(of, fastest(setting.laws))) as _;
        Ok(self.0.accelerated().map(mean).into_iter().collect())
    }
    fn remedy(&self, path: &str) -> Option<String> {
        Some(format!("lower the strength in {path}"))
    }
}

/// The shifting that a scene names.
pub struct Shifted<const D: usize>(pub Box<dyn Shifting<D>>);

impl<const D: usize> Shifted<D> {
    fn flow(setting: &Setting<'_, D>) -> ShiftedFlow {
        ShiftedFlow {
            summed: setting.summed,
        }
    }
}

impl<const D: usize> Contribution<D> for Shifted<D> {
    fn goals(&self) -> Vec<AnyField> {
        vec![fields::SHIFT_VELOCITY.any()]
    }
    fn stages(&self, setting: &Setting<'_, D>) -> Stages<D> {
        self.0.stages(setting.laws)
    }
    fn terms(&self, setting: &Setting<'_, D>) -> Terms<D> {
        self.0.term(Self::flow(setting)).into_iter().collect()
    }
    fn changes_density(&self, setting: &Setting<'_, D>) -> bool {
        self.0.term(Self::flow(setting)).is_some()
    }
    fn remedy(&self, path: &str) -> Option<String> {
        Some(format!("weaken {path}"))
    }
}

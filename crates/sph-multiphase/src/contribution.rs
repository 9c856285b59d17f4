//! Formulations and interfaces in a scene.

use std::sync::Arc;

use sph_contribution::{
    Contribution, LightBodyLimit, Limiter, Refusal, Setting, SoundLimit, Stages, StepWork,
};
use sph_core::AnyField;
use sph_neighbours::Terms;
use sph_state::PressureStage;

use crate::{Acting, Dilatation, Formulation, InterfaceLimit, InterfaceModel, PressureScheme};

/// The formulation that a scene names, with its equations of state.
pub struct Compressible<const D: usize> {
    /// What density is.
    pub formulation: Arc<dyn Formulation<D>>,
    /// Which pressure acts; that of the equations of state if there is none.
    pub scheme: Option<Box<dyn PressureScheme<D>>>,
    /// Whether the scene names what free surfaces are.
    pub surfaces: bool,
}

impl<const D: usize> Compressible<D> {
    /// Bounds of sound.
    fn sound_limits(setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        let sound = SoundLimit {
            courant: setting.courant,
            laws: setting.laws.clone(),
        };
        let interfaces = InterfaceLimit::of(setting.laws).into_iter();
        let mut limits: Vec<Box<dyn Limiter<D>>> = vec![Box::new(sound)];
        limits.extend(interfaces.map(|limit| Box::new(limit) as Box<dyn Limiter<D>>));
        if !setting.world.walls.bodies.is_empty() {
            let laws = setting.laws.clone();
            limits.push(Box::new(LightBodyLimit { laws }));
        }
        limits
    }
}

impl<const D: usize> Contribution<D> for Compressible<D> {
    fn stages(&self, setting: &Setting<'_, D>) -> Stages<D> {
        let mut stages = self.formulation.stages();
        let state = PressureStage {
            laws: setting.laws.clone(),
        };
        stages.push(match &self.scheme {
            None => Box::new(state),
            Some(scheme) => scheme.stage(Acting {
                state,
                dilatation: self.formulation.dilatation(),
                surfaces: self.surfaces,
            }),
        });
        stages
    }
    fn terms(&self, _: &Setting<'_, D>) -> Terms<D> {
        vec![self.formulation.pressure_term()]
    }
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        match &self.scheme {
            None => Self::sound_limits(setting),
            Some(scheme) => scheme.limiters(setting),
        }
    }
    fn works(
        &mut self,
        _: &Setting<'_, D>,
        _: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        let compressed = self.formulation.compressed().into_iter();
        let works = compressed.map(|c| -> Box<dyn StepWork<D>> {
            Box::new(Dilatation::new(c, self.formulation.divergence()))
        });
        Ok(works.collect())
    }
}

/// An interface model that a scene names.
pub struct Meeting<const D: usize>(pub Box<dyn InterfaceModel<D>>);

impl<const D: usize> Contribution<D> for Meeting<D> {
    fn check(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        match setting.phases.len() {
            0 | 1 => Err(Refusal::of(
                "interface",
                "",
                "the scene has one phase, and interfaces are between two: take this table out, or add a phase",
            )),
            _ => self.0.check(setting),
        }
    }
    fn stages(&self, setting: &Setting<'_, D>) -> Stages<D> {
        self.0.stages_within(setting)
    }
    fn terms(&self, setting: &Setting<'_, D>) -> Terms<D> {
        vec![self.0.term(setting.laws)]
    }
    fn limiters(&self, setting: &Setting<'_, D>) -> Vec<Box<dyn Limiter<D>>> {
        self.0.limiter(setting.laws).into_iter().collect()
    }
    fn remedy(&self, path: &str) -> Option<String> {
        Some(format!("lower the coefficients of {path}"))
    }
}

//! What elastic materials do within a step.

use sph_contribution::{OutsideForce, StepWork, StoredEnergy};
use sph_core::{Access, AnyField, Declares, StepError, fields};
use sph_neighbours::World;

use crate::{CarriedStress, ElasticMotion, ElasticSubSteps};

/// Remembered stresses follow every drift; with sub-steps they also swing within every kick.
pub struct ElasticWork<const D: usize> {
    motion: ElasticMotion<D>,
    sub_steps: Option<ElasticSubSteps<D>>,
    /// By which the remembered stress is behind the velocity after sub-steps, s.
    behind: f64,
}

impl<const D: usize> ElasticWork<D> {
    /// With steps of their own for the force, or without.
    pub fn new(motion: ElasticMotion<D>, sub_steps: Option<ElasticSubSteps<D>>) -> Self {
        ElasticWork {
            motion,
            sub_steps,
            behind: 0.0,
        }
    }

    /// To the mean velocity of the sub-steps, with a share of 1, and back from it, with −1.
    fn shift(&self, world: &mut World<D>, share: f64) -> Result<(), StepError> {
        match &self.sub_steps {
            Some(sub_steps) => sub_steps.shift(world, share),
            None => Ok(()),
        }
    }
}

impl<const D: usize> StepWork<D> for ElasticWork<D> {
    fn name(&self) -> String {
        match self.sub_steps {
            Some(_) => "elastic sub-steps".into(),
            None => "elastic motion".into(),
        }
    }
    fn access(&self) -> Access {
        let access = self.motion.access();
        match &self.sub_steps {
            None => access,
            Some(sub_steps) => access
                .and(sub_steps.term.access())
                .and(CarriedStress(self.motion.felt.clone()).access())
                .both(fields::POSITION)
                .here(fields::ACCELERATION)
                .where_there(fields::PHASE)
                .writes(fields::VELOCITY),
        }
    }
    fn remembered(&self) -> Vec<AnyField> {
        self.motion.remembered()
    }
    fn force(&self) -> Option<OutsideForce<D>> {
        self.sub_steps.as_ref().map(|sub| sub.term.clone())
    }
    fn kicks(&self) -> bool {
        self.sub_steps.is_some()
    }
    fn needs_state_in_drifts(&self) -> bool {
        true
    }
    fn kick(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        if let Some(sub_steps) = &mut self.sub_steps {
            self.behind = sub_steps.kick(world, &mut self.motion, dt)?;
        }
        Ok(())
    }
    /// Places go with the mean of sub-steps, what is left of the stress with the last.
    fn before_walls(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        self.shift(world, 1.0)
    }
    fn before_drift(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        self.shift(world, -1.0)?;
        let left = self.sub_steps.as_ref().map_or(dt, |_| self.behind);
        self.motion.apply(world, left)?;
        self.shift(world, 1.0)
    }
    fn after_drift(&mut self, world: &mut World<D>, _: f64) -> Result<(), StepError> {
        self.shift(world, -1.0)
    }
    /// V τ:τ/4𝒢.
    fn energy<'a>(&'a self, world: &'a World<D>) -> Option<StoredEnergy<'a>> {
        let free = &world.free;
        let stress = free.get(fields::ELASTIC_STRESS).ok()?;
        let (mass, density) = (
            free.get(fields::MASS).ok()?,
            free.get(fields::DENSITY).ok()?,
        );
        let phase = free.get(fields::PHASE).ok();
        let laws = &self.motion.felt.laws;
        Some(Box::new(move |i| {
            let law = &laws[phase.map_or(0, |p| p[i] as usize)];
            let modulus = law.elastic().map(|e| e.shear_modulus());
            let volume = mass[i] / density[i];
            modulus.map_or(0.0, |g| volume * stress[i].contract(&stress[i]) / (4.0 * g))
        }))
    }
    fn bound(&self) -> Option<String> {
        let longest = self.sub_steps.as_ref()?.longest();
        Some(format!(
            "elastic sub-steps: {longest:.2e} s at most, as many within a step as it takes"
        ))
    }
}

//! Particles that come into the flow.

use std::sync::Arc;

use sph_contribution::{Newborn, OwnColumn};
use sph_core::{FieldError, StepError, fields};
use sph_multiphase::Formulation;
use sph_scene::Scene;

use super::Flow;

/// Initial values of newborn particles.
pub struct NewParticleDefaults<const D: usize> {
    formulation: Arc<dyn Formulation<D>>,
    /// Columns that contributions bring along.
    columns: Vec<OwnColumn<D>>,
    phases: Vec<String>,
}

impl<const D: usize> NewParticleDefaults<D> {
    /// That of a scene.
    pub fn new(
        scene: &Scene,
        formulation: Arc<dyn Formulation<D>>,
        columns: Vec<OwnColumn<D>>,
    ) -> Self {
        NewParticleDefaults {
            formulation,
            columns,
            phases: scene.phase.keys().cloned().collect(),
        }
    }
}

impl<const D: usize> Flow<D> {
    /// Lets in particles born at the end of a step of `dt` seconds.
    ///
    /// # Errors
    /// If a new particle is impossible, or a column is missing.
    pub fn let_in(&mut self, dt: f64) -> Result<(), StepError> {
        if self.nursery.is_none() {
            return Ok(());
        }
        let mut all: Vec<Newborn<D>> = Vec::new();
        for (gate, access) in self.gates.iter_mut().zip(&self.columns.gates) {
            self.world.free.watch([access]);
            let born = gate.births(&mut self.world, dt);
            self.world.free.unwatch(|| gate.name())?;
            all.extend(born?);
        }
        self.insert(&all)
    }

    /// Lets in these particles.
    ///
    /// # Errors
    /// As [`let_in`](Self::let_in); a flow that no particle may come into.
    pub fn insert(&mut self, all: &[Newborn<D>]) -> Result<(), StepError> {
        let Some(nursery) = &self.nursery else {
            let why = "no particle may come into this flow";
            return Err(StepError::stage("births", why));
        };
        let formulation = nursery.formulation.clone();
        if all.is_empty() {
            return Ok(());
        }
        for newborn in all {
            self.refuse(newborn)?;
        }
        let first = self.world.free.inserted.identities;
        self.fill(all)?;
        // Where they are follows from their places alone, whatever the order in which they were born.
        self.refresh_lists_and_derived()?;
        if let Some(walls) = &mut self.walls {
            walls.geometry(&mut self.world)?;
        }
        self.begin_density(&*formulation, first)
    }

    fn refuse(&self, newborn: &Newborn<D>) -> Result<(), StepError> {
        let sound = newborn.mass > 0.0
            && newborn.mass.is_finite()
            && newborn.density > 0.0
            && newborn.density.is_finite()
            && newborn.velocity.iter().all(|u| u.is_finite())
            && self.world.domain.contains(&newborn.position)
            && (newborn.phase as usize) < self.laws.len();
        if sound {
            return Ok(());
        }
        let why = format!(
            "a particle from `{}` is born at {:?} with {} kg, {} kg/m³ and the phase {}: one of them is impossible",
            newborn.body,
            newborn.position.as_slice(),
            newborn.mass,
            newborn.density,
            newborn.phase
        );
        Err(StepError::stage("births", why))
    }

    fn fill(&mut self, all: &[Newborn<D>]) -> Result<(), StepError> {
        let Some(nursery) = &self.nursery else {
            return Ok(());
        };
        let free = &mut self.world.free;
        let slots = free.give_birth(all.len())?;
        if let Some(parts) = &self.parts {
            // All ranks insert all; particles of other ranks go when the lists are built.
            let places: Vec<_> = all.iter().map(|n| n.position).collect();
            parts.house(free, slots.clone(), &places)?;
        }
        for (slot, newborn) in slots.clone().zip(all) {
            free.inserted.mass += newborn.mass;
            free.get_mut(fields::POSITION)?[slot] = newborn.position;
            free.get_mut(fields::VELOCITY)?[slot] = newborn.velocity;
            free.get_mut(fields::MASS)?[slot] = newborn.mass;
            free.get_mut(fields::DENSITY)?[slot] = newborn.density;
            if free.has(fields::PHASE.name) {
                free.get_mut(fields::PHASE)?[slot] = newborn.phase;
            }
        }
        let first = slots.start;
        let names = |k: usize| {
            let newborn = &all[k - first];
            let phase = &nursery.phases[newborn.phase as usize];
            (phase.as_str(), &*newborn.body)
        };
        for column in &nursery.columns {
            column.begin(free, slots.clone(), names)?;
            for (slot, newborn) in slots.clone().zip(all) {
                let mut given = newborn.values.iter();
                if let Some((_, value)) = given.find(|(name, _)| name == column.field.name) {
                    free.get_mut(column.field)?[slot] = *value;
                }
            }
        }
        Ok(())
    }

    /// Sets the quantity that the formulation integrates for those whose identities are not below `first`, so that they
    /// have their densities.
    fn begin_density(
        &mut self,
        formulation: &dyn Formulation<D>,
        first: u32,
    ) -> Result<(), StepError> {
        let free = &self.world.free;
        let before = self.integrated.iter();
        let before = before.map(|f| Ok((*f, free.get(*f)?.to_vec())));
        let before = before.collect::<Result<Vec<_>, FieldError>>()?;
        formulation.rebase(&mut self.world)?;
        let identity = self.world.free.get(fields::IDENTITY)?.to_vec();
        for (field, values) in before {
            let column = self.world.free.get_mut(field)?.iter_mut();
            let all = column.zip(values).zip(&identity);
            for ((now, before), _) in all.filter(|(_, id)| **id < first) {
                *now = before;
            }
        }
        if let Some(parts) = &mut self.parts {
            // It is a sum over neighbours.
            let integrated: Vec<_> = self.integrated.iter().map(|f| f.any()).collect();
            parts
                .link
                .update_ghosts(&mut self.world.free, |f| integrated.contains(f))?;
        }
        Ok(())
    }
}

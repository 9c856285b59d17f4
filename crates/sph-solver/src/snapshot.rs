//! The state before a step, to fall back on when the step fails.

use nalgebra::SMatrix;
use sph_core::{FieldError, Recall, Symmetric, Taken, Vect, fields};

use sph_stress::{SEEPAGE_PRESSURE, SEEPAGE_VELOCITY};

use crate::Flow;

/// The columns that a step changes, in the order the particles had.
#[derive(Default)]
pub struct Snapshot<const D: usize> {
    identity: Vec<u32>,
    position: Vec<Vect<D>>,
    /// Empty where nobody asks for it.
    displacement: Vec<Vect<D>>,
    velocity: Vec<Vect<D>>,
    evolved: Vec<Vec<f64>>,
    /// Remembered stresses, and the gradients of the last drift; empty where nothing is elastic.
    stress: Vec<Symmetric>,
    gradient: Vec<SMatrix<f64, D, D>>,
    /// What a force of displacements remembers; empty where there is none.
    turn: Vec<Symmetric>,
    elastic_displacement: Vec<Vect<D>>,
    /// Mass, flux and pressure where water seeps; empty elsewhere.
    seeping: Seeping<D>,
    /// From which the next solve starts; empty where there is none.
    effective_pressure: Vec<f64>,
    time: f64,
    /// The step before, s.
    dt: f64,
    /// What had left.
    taken: Vec<Taken>,
}

/// What seepage changes.
#[derive(Default)]
struct Seeping<const D: usize> {
    mass: Vec<f64>,
    flux: Vec<Vect<D>>,
    pressure: Vec<f64>,
}

impl<const D: usize> Snapshot<D> {
    /// Copies the state; reuses its buffers.
    pub fn take(&mut self, flow: &Flow<D>) -> Result<(), FieldError> {
        fn copy<T: Copy>(to: &mut Vec<T>, from: &[T]) {
            to.clear();
            to.extend_from_slice(from);
        }
        let free = &flow.world.free;
        copy(&mut self.identity, free.get(fields::IDENTITY)?);
        copy(&mut self.taken, free.taken());
        copy(&mut self.position, free.get(fields::POSITION)?);
        if let Ok(displacement) = free.get(fields::DISPLACEMENT) {
            copy(&mut self.displacement, displacement);
        }
        copy(&mut self.velocity, free.get(fields::VELOCITY)?);
        self.evolved.resize(flow.integrated.len(), Vec::new());
        for (copied, field) in self.evolved.iter_mut().zip(&flow.integrated) {
            copy(copied, free.get(*field)?);
        }
        if flow.elastic.is_some() {
            copy(&mut self.stress, free.get(fields::ELASTIC_STRESS)?);
            copy(&mut self.gradient, free.get(fields::VELOCITY_GRADIENT)?);
        }
        if let Ok(turn) = free.get(fields::ELASTIC_TURN) {
            copy(&mut self.turn, turn);
            let displacement = free.get(fields::ELASTIC_DISPLACEMENT)?;
            copy(&mut self.elastic_displacement, displacement);
        }
        if flow.seepage.is_some() {
            copy(&mut self.seeping.mass, free.get(fields::MASS)?);
            copy(&mut self.seeping.flux, free.get(SEEPAGE_VELOCITY)?);
            copy(&mut self.seeping.pressure, free.get(SEEPAGE_PRESSURE)?);
        }
        if let Ok(pressure) = free.get(fields::EFFECTIVE_PRESSURE) {
            copy(&mut self.effective_pressure, pressure);
        }
        self.time = flow.world.time;
        self.dt = flow.world.dt;
        Ok(())
    }

    /// Where the particle of a number was.
    pub fn position_of(&self, number: u32) -> Option<Vect<D>> {
        let place = self.identity.iter().position(|i| *i == number)?;
        self.position.get(place).copied()
    }

    /// Where every particle of now is in the copy; `None` if the order is the same.
    pub fn places(&self, flow: &Flow<D>) -> Result<Option<Vec<u32>>, FieldError> {
        let now = flow.world.free.get(fields::IDENTITY)?;
        if now == self.identity {
            return Ok(None);
        }
        // Who has left is missing among the identities.
        let ids = self.identity.iter().max().map_or(0, |id| *id as usize + 1);
        let mut place = vec![0u32; ids];
        for (k, &id) in self.identity.iter().enumerate() {
            place[id as usize] = k as u32;
        }
        Ok(Some(now.iter().map(|&id| place[id as usize]).collect()))
    }

    /// Puts part of the state back, whatever order the particles are in now.
    pub fn recall(&self, flow: &mut Flow<D>, what: Recall) -> Result<(), FieldError> {
        fn put<T: Copy>(to: &mut [T], from: &[T], places: Option<&[u32]>) {
            match places {
                None => to.copy_from_slice(from),
                Some(places) => {
                    let from = places.iter().map(|&p| from[p as usize]);
                    to.iter_mut().zip(from).for_each(|(to, from)| *to = from);
                }
            }
        }
        let places = self.places(flow)?;
        let places = places.as_deref();
        let free = &mut flow.world.free;
        for (copied, field) in self.evolved.iter().zip(&flow.integrated) {
            put(free.get_mut(*field)?, copied, places);
        }
        if what == Recall::Scalars {
            return Ok(());
        }
        put(free.get_mut(fields::VELOCITY)?, &self.velocity, places);
        if what == Recall::State {
            put(free.get_mut(fields::POSITION)?, &self.position, places);
            if let Ok(displacement) = free.get_mut(fields::DISPLACEMENT) {
                put(displacement, &self.displacement, places);
            }
            if flow.elastic.is_some() {
                put(free.get_mut(fields::ELASTIC_STRESS)?, &self.stress, places);
                put(
                    free.get_mut(fields::VELOCITY_GRADIENT)?,
                    &self.gradient,
                    places,
                );
            }
            if let Ok(turn) = free.get_mut(fields::ELASTIC_TURN) {
                put(turn, &self.turn, places);
                let displacement = free.get_mut(fields::ELASTIC_DISPLACEMENT)?;
                put(displacement, &self.elastic_displacement, places);
            }
            if flow.seepage.is_some() {
                let kept = &self.seeping;
                put(free.get_mut(fields::MASS)?, &kept.mass, places);
                put(free.get_mut(SEEPAGE_VELOCITY)?, &kept.flux, places);
                put(free.get_mut(SEEPAGE_PRESSURE)?, &kept.pressure, places);
            }
            flow.world.time = self.time;
            self.walls_back(flow);
        }
        Ok(())
    }

    fn walls_back(&self, flow: &mut Flow<D>) {
        if let Some(walls) = &flow.walls {
            // The walls accepted this time before, so they accept it again.
            let _ = crate::stages::lock(walls).move_to(&mut flow.world.walls, self.time);
        }
    }

    /// Puts the state back. If the particles were sorted meanwhile, they return to their
    /// order; those that left by an outlet since come back.
    pub fn restore(&self, flow: &mut Flow<D>) -> Result<(), FieldError> {
        flow.take_back(&self.taken);
        if let Some(places) = self.places(flow)? {
            let mut order = vec![0u32; places.len()];
            for (k, &p) in places.iter().enumerate() {
                order[p as usize] = k as u32;
            }
            flow.world.free.permute(&order);
        }
        let free = &mut flow.world.free;
        free.get_mut(fields::POSITION)?
            .copy_from_slice(&self.position);
        if let Ok(displacement) = free.get_mut(fields::DISPLACEMENT) {
            displacement.copy_from_slice(&self.displacement);
        }
        free.get_mut(fields::VELOCITY)?
            .copy_from_slice(&self.velocity);
        for (copied, field) in self.evolved.iter().zip(&flow.integrated) {
            free.get_mut(*field)?.copy_from_slice(copied);
        }
        if flow.elastic.is_some() {
            free.get_mut(fields::ELASTIC_STRESS)?
                .copy_from_slice(&self.stress);
            free.get_mut(fields::VELOCITY_GRADIENT)?
                .copy_from_slice(&self.gradient);
        }
        if let Ok(turn) = free.get_mut(fields::ELASTIC_TURN) {
            turn.copy_from_slice(&self.turn);
            free.get_mut(fields::ELASTIC_DISPLACEMENT)?
                .copy_from_slice(&self.elastic_displacement);
        }
        if flow.seepage.is_some() {
            let kept = &self.seeping;
            free.get_mut(fields::MASS)?.copy_from_slice(&kept.mass);
            free.get_mut(SEEPAGE_VELOCITY)?.copy_from_slice(&kept.flux);
            free.get_mut(SEEPAGE_PRESSURE)?
                .copy_from_slice(&kept.pressure);
        }
        if let Ok(pressure) = free.get_mut(fields::EFFECTIVE_PRESSURE) {
            pressure.copy_from_slice(&self.effective_pressure);
        }
        flow.world.time = self.time;
        flow.world.dt = self.dt;
        self.walls_back(flow);
        flow.world.rebuild_lists()
    }
}

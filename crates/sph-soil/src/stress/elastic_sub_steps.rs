//! Steps of the elastic force within that of the flow.

use rayon::prelude::*;
use sph_contribution::{Kick, OutsideForce, StepHook, StepMoment, StepPhase};
use sph_core::{Access, Stage, StepError, Vect, fields};
use sph_neighbours::{World, accelerations_of};

use crate::stress::ElasticMotion;

/// u and τ over a step of the flow, N times, at places, volumes, pressures and viscosities that stay:
///
/// ```text
/// u ← u + δ (f/m + div(s τ)/ρ),   τ ← τ + δ (2𝒢D′(u) + ωτ − τω),   δ = Δt/N
/// ```
///
/// f being all other forces. Where a soil rests both parts of its acceleration cancel in every sub-step; an
/// impulse Δt f would shake it by more than the strain rate at which a stiff soil yields. Friction that is solved for comes after; the
/// last step of τ is left to the drift, which has the velocity after friction.
///
/// Particles drift with ū + (1 − 1/N)/2 (uᴺ − u⁰), ū being the mean of u¹ … uᴺ: without elastic forces that is uᴺ, so that what the others do stays symplectic,
/// and added up over the steps it is the way that the stress has seen, but for half a step: vibrations faster than the flow's step take nothing along.
///
/// Only soils and particles with one among their neighbours take part. With sub-steps elastic waves are resolved in
/// time, those also that are faster than the flow's step.
///
/// Ours, after the multiple time steps of Tuckerman, Berne & Martyna 1992, J. Chem. Phys. 97, 1990.
pub struct ElasticSubSteps<const D: usize> {
    /// A force that reads no velocity.
    pub(crate) term: OutsideForce<D>,
    pub(crate) motion: ElasticMotion<D>,
    /// The stress that acts, from the remembered one.
    pub(crate) carried: Box<dyn Stage<World<D>>>,
    /// The longest sub-step, s.
    pub(crate) longest: f64,
    pub(crate) touched: Vec<bool>,
    pub(crate) acceleration: Vec<Vect<D>>,
    /// Velocity of the drift less the last velocity.
    pub(crate) mean: Vec<Vect<D>>,
    /// δ, by which τ is behind the velocity since the last kick, s.
    pub(crate) behind: f64,
}

impl<const D: usize> ElasticSubSteps<D> {
    /// N for a step Δt, s.
    pub fn count(&self, dt: f64) -> usize {
        (dt / self.longest - 1e-9).ceil().max(1.0) as usize
    }

    /// Adds `share` of what the velocity of the drift has more than that of the last sub-step.
    fn shift(&self, world: &mut World<D>, share: f64) -> Result<(), StepError> {
        let velocity = world.free.get_mut(fields::VELOCITY)?;
        let all = velocity.par_iter_mut().zip(&self.mean);
        all.with_min_len(2048)
            .for_each(|(u, more)| *u += more * share);
        Ok(())
    }

    /// Particles that carry stress or have a neighbour that does.
    fn find_touched(&mut self, world: &World<D>) -> Result<(), StepError> {
        let laws = self.motion.law_inputs.laws.iter();
        let carries: Vec<bool> = laws.map(|l| l.elastic().is_some()).collect();
        let touched = &mut self.touched;
        touched.clear();
        touched.resize(world.free.len(), true);
        if carries.iter().all(|c| *c) {
            return Ok(());
        }
        let (phase, position) = world.free.all((fields::PHASE, fields::POSITION))?;
        let limit = world.kernel.support_radius().powi(2);
        let lists = world.lists.nearest();
        let carries = |i: usize| carries[phase[i] as usize];
        let all = touched.par_iter_mut().enumerate().with_min_len(2048);
        all.for_each(|(i, touched)| {
            let near = |j: usize| {
                let apart = world.domain.nearest_image(position[i] - position[j]);
                apart.norm_squared() < limit
            };
            let others = lists.candidates(i).iter().map(|&j| j as usize);
            *touched = carries(i) || others.filter(|&j| carries(j)).any(near);
        });
        Ok(())
    }
}

impl<const D: usize> StepHook<D> for ElasticSubSteps<D> {
    fn name(&self) -> String {
        "elastic sub-steps".into()
    }
    fn access(&self) -> Access {
        StepHook::access(&self.motion)
            .and(self.term.access())
            .and(self.carried.access())
            .both(fields::POSITION)
            .here(fields::ACCELERATION)
            .where_there(fields::PHASE)
            .writes(fields::VELOCITY)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[
            StepPhase::BeforeWalls,
            StepPhase::BeforeDrift,
            StepPhase::AfterDrift,
        ]
    }
    /// Places go with the mean of sub-steps, what is left of the stress with the last.
    fn run(&mut self, phase: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let world = &mut *moment.world;
        match phase {
            StepPhase::BeforeWalls => self.shift(world, 1.0),
            StepPhase::BeforeDrift => {
                self.shift(world, -1.0)?;
                self.motion.apply(world, self.behind)?;
                self.shift(world, 1.0)
            }
            _ => self.shift(world, -1.0),
        }
    }
    fn as_kick(&mut self) -> Option<&mut dyn Kick<D>> {
        Some(self)
    }
}

impl<const D: usize> Kick<D> for ElasticSubSteps<D> {
    /// N sub-steps with the forces of the last evaluation.
    fn kick(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let count = self.count(dt);
        let part = dt / count as f64;
        self.find_touched(world)?;
        let space = world.space()?;
        // Whether copies of others' particles have soil around, their owners know.
        space.refresh_marked(&mut self.touched, |touched| *touched, |_, touched| touched);
        self.acceleration.resize(world.free.len(), Vect::zeros());
        let more = 0.5 * (1.0 - 1.0 / count as f64);
        let before = world.free.get(fields::VELOCITY)?;
        self.mean.clear();
        self.mean.extend(before.iter().map(|u| -u * more));
        for step in 1..=count {
            if step > 1 {
                self.carried.run(world)?;
            }
            let touched = &self.touched;
            accelerations_of(world, &*self.term, |i| touched[i], &mut self.acceleration)?;
            space.refresh(&mut self.acceleration);
            let mut velocity = world.free.take(fields::VELOCITY)?;
            let others = world.free.get(fields::ACCELERATION)?;
            let all = velocity.par_iter_mut().zip(&self.acceleration).zip(others);
            let all = all.zip(&mut self.mean).with_min_len(2048);
            all.for_each(|(((u, a), others), mean)| {
                *u += (a + others) * part;
                *mean += *u / count as f64;
            });
            world.free.put(fields::VELOCITY, velocity)?;
            if step < count {
                self.motion.apply_within(world, part)?;
            }
        }
        let velocity = world.free.get(fields::VELOCITY)?;
        let all = self.mean.par_iter_mut().zip(velocity);
        let all = all.zip(&self.touched).with_min_len(2048);
        all.for_each(|((mean, u), touched)| {
            *mean = match touched {
                true => *mean - u * (1.0 - more),
                false => Vect::zeros(),
            };
        });
        self.behind = part;
        Ok(())
    }
}

//! Roll-back of a step that failed.

use std::path::PathBuf;

use sph_core::{StepError, Vect, fields};
use sph_run::{BAD_STATE, CHECKPOINT, RunCounters, Status, Watch};

use crate::failure::bad_pictures;
use crate::failure::error::Result;
use crate::failure::findings::{
    Findings, Suspect, place_of, shares_on, sighting, suspect, trouble,
};
use crate::failure::remedies::remedies;
use crate::running::course::{DerivedState, Running};
use crate::running::pieces::{particles, points};
use crate::setup::Leak;
use crate::{Failure, RunError, Summary};

/// Distance from a leak, in kernel supports, within which it is the cause: neighbours of the particles that it
/// disturbs are two supports away.
const NEAR_LEAKS: f64 = 2.0;

impl<const D: usize> Running<'_, D> {
    /// After a step that failed: back to the state before it, with half of the step.
    ///
    /// # Errors
    /// If there is no such state, or there were too many tries.
    pub fn go_back(&mut self, cause: StepError, observer: &mut Watch<'_>) -> Result<()> {
        let cause = self.known_to_all(cause);
        self.note_trouble(&cause);
        self.departure.failed(&cause);
        let hopeless = self.leak_at(&cause).is_some();
        let left = self.counters.retries < self.scene.run.retries;
        let Some(kept) = self.good.as_ref().filter(|_| left && !hopeless) else {
            return Err(self.failed(cause));
        };
        self.counters.retries += 1;
        self.counters.rolled_back += 1;
        kept.restore(&mut self.parts.flow)?;
        let scale = 0.5 * f64::from_bits(self.counters.step_scale);
        self.counters.step_scale = scale.to_bits();
        observer.message(&format!(
            "step {} failed ({cause}); going back to t = {:.6} s with {scale:.4} of the step",
            self.counters.steps, self.parts.flow.world.time
        ));
        Ok(())
    }

    /// The leak of a wall beside the particle that a failed step names: no shorter step mends a wall.
    ///
    /// Parts of a divided flow repeat it, as each has its own walls only.
    fn leak_at(&self, cause: &StepError) -> Option<&Leak<D>> {
        let world = &self.parts.flow.world;
        let StepError::Bad { position, .. } = cause else {
            return None;
        };
        if self.parts.flow.parts.is_some() || position.len() != D {
            return None;
        }
        let at = Vect::<D>::from_column_slice(position);
        let reach = NEAR_LEAKS * world.kernel.support_radius();
        let near = |x: &Vect<D>| world.domain.nearest(at - x).norm() < reach;
        let mut leaks = self.parts.leaks.iter();
        leaks.find(|leak| leak.places.iter().any(near))
    }

    /// Keeps the first sign of trouble.
    fn note_trouble(&mut self, cause: &StepError) {
        let (time, step) = (self.parts.flow.world.time, self.counters.steps);
        let first = &mut self.counters.first_trouble;
        first.get_or_insert_with(|| trouble(cause, time, step));
    }

    /// A run that ends here, of which no more is known than why.
    pub fn failed(&mut self, cause: StepError) -> RunError {
        let cause = self.known_to_all(cause);
        self.note_trouble(&cause);
        let (time, step) = (self.parts.flow.world.time, self.counters.steps);
        RunError::Failed(Box::new(Failure {
            first: self.counters.first_trouble.clone().unwrap_or_default(),
            summary: None,
            findings: Findings {
                cause: trouble(&cause, time, step),
                retries: self.counters.retries,
                dt: self.tried.0,
                limiter: self.tried.1.to_string(),
                ..Findings::default()
            },
            cause,
            checkpoint: None,
            bad_state: None,
            pictures: Vec::new(),
        }))
    }

    /// Finds and writes the evidence of a failed run.
    pub fn find_out(
        &mut self,
        failure: &mut Failure,
        books: &RunCounters,
    ) -> Result<Option<Summary>> {
        // The bad state, as far as it can be had.
        let _ = self.gather(false);
        self.look_at_the_bad_state(failure);
        if self.writes() {
            let out = &self.options.out;
            let (bad, flow) = (out.join(BAD_STATE), &self.shown().flow);
            let written = points(flow).is_ok_and(|points| {
                let all = particles(&flow.world.free, &points, |_| true);
                sph_io::write_vtu(&bad, &all, flow.world.time).is_ok()
            });
            failure.bad_state = written.then_some(bad);
            let particle = failure.findings.particle.as_ref();
            let place = particle.and_then(|p| self.place(p.number));
            let title = format!("failed: {}", self.scene.title);
            let quantity = &failure.findings.cause.quantity;
            failure.pictures = bad_pictures::draw(flow, quantity, place, &title, out);
        }
        self.go_to_the_last_good_state(failure, books);
        if !self.writes() {
            return Ok(None);
        }
        self.sum_up(failure);
        // Of a bad state as much as can be had.
        let _ = self.look_around();
        let summary = self.summary(Status::Failed, Some(failure), books)?;
        failure.summary = Some(Box::new(summary.clone()));
        Ok(Some(summary))
    }

    /// The particle, its place, and the terms that acted on it if the bad state was evaluated.
    fn look_at_the_bad_state(&mut self, failure: &mut Failure) {
        let flow = &self.shown().flow;
        let free = &flow.world.free;
        let found = suspect(flow, &failure.cause);
        let (Some((k, named)), Ok(identity)) = (found, free.get(fields::IDENTITY)) else {
            return;
        };
        let number = identity[k];
        let phase = free.get(fields::PHASE).map_or(0, |p| p[k] as usize);
        let phase = self.scene.phase.keys().nth(phase).cloned();
        let body = self.parts.body_of.get(number as usize).copied();
        let body = body.and_then(|b| self.scene.body.keys().nth(b as usize));
        failure.findings.particle = Some(Suspect {
            number,
            named,
            phase: phase.unwrap_or_default(),
            body: body.cloned().unwrap_or_default(),
            before: None,
            after: sighting(flow, k),
        });
        // Densities and accelerations are judged after the sweep; an earlier failure has none of this state.
        let judged = ["density", "acceleration"];
        // A whole that was gathered is not evaluated.
        let evaluated = self.whole.is_none();
        if evaluated && judged.contains(&failure.findings.cause.quantity.as_str()) {
            failure.findings.after = shares_on(flow, k);
        }
    }

    /// The place of a particle, or its last one before it left the domain.
    fn place(&self, number: u32) -> Option<Vect<D>> {
        let flow = &self.shown().flow;
        let now = flow.world.free.get(fields::POSITION).ok()?[place_of(flow, number)?];
        let before = self.good.as_ref().and_then(|s| s.position_of(number));
        // Places that are not finite are left out.
        let shown = [Some(now), before].into_iter().flatten();
        let mut shown = shown.filter(|x| x.iter().all(|x| x.is_finite()));
        let within = |x: &Vect<D>| flow.world.domain.contains(x);
        shown.clone().find(within).or_else(|| shown.next())
    }

    /// Back to the last good state, which becomes the checkpoint; with the terms that acted on the particle there.
    fn go_to_the_last_good_state(&mut self, failure: &mut Failure, books: &RunCounters) {
        let own = self.options.out.join(CHECKPOINT);
        // Without a state to go back to, the last save.
        failure.checkpoint = own.exists().then(|| own.clone());
        let Some(snapshot) = &self.good else {
            return;
        };
        self.known = DerivedState::default();
        let back = snapshot.restore(&mut self.parts.flow);
        let good = back.and_then(|()| self.evaluate());
        if self.agreed(good.err()).is_some() {
            return;
        }
        // A run that goes on from here has all retries again.
        self.counters.retries = 0;
        let saved = self.gather(true).is_ok() && self.save_gathered(books, &own).is_ok();
        failure.checkpoint = saved.then_some(own);
        let flow = &self.shown().flow;
        let particle = &mut failure.findings.particle;
        let place = particle.as_ref().and_then(|p| place_of(flow, p.number));
        if let Some((particle, k)) = particle.as_mut().zip(place) {
            particle.before = sighting(flow, k);
            failure.findings.before = shares_on(flow, k);
        }
    }

    fn sum_up(&self, failure: &mut Failure) {
        let name = |p: &PathBuf| Some(p.file_name()?.to_str()?.to_string());
        let files = failure.pictures.iter().chain(&failure.bad_state);
        let files = files.chain(&failure.checkpoint);
        failure.findings.files = files.filter_map(name).collect();
        let all = remedies(self.scene, failure, &self.parts.flow.remedies);
        let leak = self.leak_at(&failure.cause);
        let leak = leak.map(|leak| format!("mend the wall beside the particle, {}", leak.text));
        failure.findings.advice = leak.into_iter().chain(all).collect();
    }
}

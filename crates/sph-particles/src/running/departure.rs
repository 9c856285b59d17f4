//! Check that walls stay in the domain and go no farther in a step than they may: a warning while the run goes on, and no
//! result where a body has left.

use std::collections::BTreeSet;

use sph_core::{StepError, Vect};
use sph_scene::Scene;
use sph_solver::Flow;
use sph_solver::step::WALL_MOTION;

/// The walls that were seen outside of the domain, or on too long a way.
#[derive(Clone, Debug, Default)]
pub(crate) struct DepartureWatch {
    /// Walls that reached over the border.
    over: BTreeSet<String>,
    /// The first body of which nothing is left in the domain, and when, s.
    gone: Option<(String, f64)>,
    /// The first step that failed because a wall went too far.
    leap: Option<String>,
}

impl DepartureWatch {
    /// Looks at the walls that move; returns a warning, once for each.
    pub fn look<const D: usize>(&mut self, scene: &Scene, flow: &Flow<D>) -> Vec<String> {
        let (world, mut told) = (&flow.world, Vec::new());
        for (name, wall) in &scene.wall {
            if wall.motion.is_none() && wall.mover.is_empty() {
                continue;
            }
            let points = world
                .walls
                .points
                .position
                .iter()
                .zip(&world.walls.points.wall);
            let own = points.filter(|(_, w)| world.walls.names[**w as usize] == *name);
            let outside = |x: &Vect<D>| !world.domain.contains(x);
            let mut own = own.map(|(x, _)| outside(x)).peekable();
            if own.peek().is_none() {
                continue;
            }
            let (some, all) = own.fold((false, true), |(some, all), x| (some || x, all && x));
            if all && !wall.mover.is_empty() && self.gone.is_none() {
                self.gone = Some((name.clone(), world.time));
            }
            if some && self.over.insert(name.clone()) {
                let what = out_of(name);
                told.push(format!("warning: at t = {:.4} s {what}", world.time));
            }
        }
        told
    }

    /// Takes the reason of a failed step, which the run reports itself.
    pub fn failed(&mut self, cause: &StepError) {
        if let StepError::Stage { stage, reason } = cause
            && stage == WALL_MOTION
        {
            let told = || format!("a step was taken back: {reason}");
            self.leap.get_or_insert_with(told);
        }
    }

    /// Lines of the summary: warnings, and advice.
    pub fn remarks(&self) -> (Vec<String>, Vec<String>) {
        let room = "a wall leaves the domain: give `numerics.domain` the room that it needs, or find the force that throws it \
                    (the probe `wall-force` measures the force of the fluid)";
        let shorter = "walls or bodies are thrown about within a step: smooth their courses and forces, or shorten the \
                       step with `run.safety`";
        let of = |some: bool, what: &str| some.then(|| what.to_string());
        let warnings = self.over.iter().map(|n| out_of(n));
        let advice = of(!self.over.is_empty(), room).into_iter();
        (
            warnings.chain(self.leap.clone()).collect(),
            advice.chain(of(self.leap.is_some(), shorter)).collect(),
        )
    }

    /// The reason for the run's end, if a body has left the domain.
    pub fn verdict(&self) -> Option<StepError> {
        let (name, time) = self.gone.as_ref()?;
        Some(StepError::stage(
            WALL_MOTION,
            format!(
                "the body `{name}` has left the domain by t = {time:.4} s: its force is too large, or `numerics.domain` too small"
            ),
        ))
    }
}

fn out_of(name: &str) -> String {
    format!("wall `{name}` reaches out of the domain, beyond which there is no fluid")
}

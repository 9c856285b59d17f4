//! Watches over a run, each with a warning while it goes on, and an end where results are wrong.
//!
//! * [`EnergyWatch`]: energy that a flow without a drive gains; no result beyond 10 %.
//! * [`MachWatch`]: speed of the flow over that of sound. It is judged by mass, not by the fastest particle: a droplet of
//!   spray or the air beside a wave may pass the speed of sound for a moment and carries next to nothing, while a tenth of
//!   all mass is the flow itself.
//! * [`DepartureWatch`]: walls stay in the domain and go no farther in a step than they may; no result where a body has left.

use std::collections::BTreeSet;

use sph_core::{Contract, StepError};
use sph_multiphase::damping::DampingEntry;
use sph_scene::{Scene, given};
use sph_solver::Flow;
use sph_solver::step::WALL_MOTION;

use crate::results::balance::{Balance, COMPRESSIBLE, SUPERSONIC};
use crate::setup::moves;

/// Shares of the scale from which the run warns, and from which it fails.
const TOLD: f64 = 0.01;
const GROSS: f64 = 0.1;
/// Least scale over Σ m c²: the energy of a flow with a sixteenth of its speed of sound, so that a fluid at rest is not
/// measured by its own noise.
const STILL: f64 = 2e-3;
/// Kinds of plugins that give a flow no energy besides that of its sums.
const OWN: [&str; 9] = [
    "formulation",
    "viscous-operator",
    "velocity-gradient",
    "eddy-viscosity",
    "smoother",
    "shifting",
    "damping",
    "surface",
    "walls",
];

/// The energies of a flow so far, J.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EnergyWatch {
    /// True if anything else than its own weight may give the flow energy, or hold some that its sums leave out.
    driven: bool,
    /// Sum and potential energy in the first row, largest kinetic, least potential energy, largest rise of the sum.
    pub so_far: Option<[f64; 5]>,
    /// Largest rise over the scale of the flow.
    share: f64,
    warned: bool,
}

impl EnergyWatch {
    pub fn from_scene<const D: usize>(scene: &Scene, flow: &Flow<D>) -> Self {
        let world = &flow.world;
        let around = |k: usize| world.domain.periodic[k] && world.gravity[k] != 0.0;
        let kinds = flow.kinds.iter().map(|(_, kind)| kind);
        let mut kinds = kinds
            .copied()
            .chain(flow.hooks.all.iter().map(|hook| hook.kind));
        let driven = scene.wall.values().any(moves)
            || scene.swings()
            || world.driving.norm() > 0.0
            || (0..D).any(around)
            || !flow.gates.is_empty()
            || kinds.any(|kind| !OWN.contains(&kind));
        EnergyWatch {
            driven,
            ..EnergyWatch::default()
        }
    }

    /// Looks at the sums of a state at a time, s; gives a warning, once in a run. The sums over the remaining particles
    /// give nothing once some of the fluid has left.
    pub fn look<const D: usize>(
        &mut self,
        now: &Balance<D>,
        left: f64,
        time: f64,
    ) -> Option<String> {
        if self.driven || left > 0.0 {
            return None;
        }
        let begin = || [now.energy(), now.potential, 0.0, now.potential, 0.0];
        let [energy, potential, kinetic, lowest, rise] = self.so_far.get_or_insert_with(begin);
        *kinetic = kinetic.max(now.kinetic);
        *lowest = lowest.min(now.potential);
        *rise = rise.max(now.energy() - *energy);
        let scale = (*kinetic + (*potential - *lowest)).max(STILL * now.acoustic);
        self.share = self.share.max(*rise / scale);
        if self.warned || self.share <= TOLD {
            return None;
        }
        self.warned = true;
        Some(format!("warning: at t = {time:.4} s {}", self.message()))
    }

    /// Entries of the summary, if there are any: a warning, and advice.
    pub fn remarks(&self) -> Option<[String; 2]> {
        let damping = DampingEntry::KIND.advice();
        let advice = format!(
            "`[probe.NAME] kind = \"energy-budget\"` lists the source of the energy; {damping} damps the sound that walls make, also beside a smoother"
        );
        (self.share > TOLD).then(|| [self.message(), advice])
    }

    /// The error of a run that made too much energy.
    pub fn verdict(&self) -> Option<StepError> {
        let reason = || format!("{}: results of such a run are wrong", self.message());
        (self.share > GROSS).then(|| StepError::stage("energy", reason()))
    }

    fn message(&self) -> String {
        let [.., rise] = self.so_far.unwrap_or_default();
        format!(
            "the energy of a flow without a drive has risen by {rise:.3e} J, {:.1} % of what moves in it",
            100.0 * self.share
        )
    }
}

/// Share of the mass that has to be as fast.
pub(crate) const SHARE: f64 = 0.1;

/// Warnings that a run has had of its speed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MachWatch {
    warned: bool,
    supersonic: Option<f64>,
}

impl MachWatch {
    /// Looks at the sums of a state; returns a warning, once in a run.
    pub fn look<const D: usize>(&mut self, now: &Balance<D>) -> Option<String> {
        let share = |mass: f64| mass / now.mass.max(f64::MIN_POSITIVE);
        let [_, fast, supersonic] = now.faster.map(share);
        self.supersonic = (supersonic > SHARE).then_some(supersonic);
        if self.warned || fast <= SHARE {
            return None;
        }
        self.warned = true;
        Some(format!(
            "warning: {:.0} % of the mass is faster than {COMPRESSIBLE} of the speed of sound, so that densities \
             move by 10 % and more: raise `speed_of_sound` or `velocity_scale` of the phase; above {SUPERSONIC} \
             the run ends",
            100.0 * fast
        ))
    }

    /// The reason for the run's end, if too much of it is faster than sound and the scene does not allow that.
    pub fn verdict(&self, scene: &Scene) -> Option<StepError> {
        let share = self.supersonic.filter(|_| !scene.numerics.supersonic)?;
        let reason = format!(
            "{:.0} % of the mass is faster than its sound, and results of such a run are wrong: raise \
             `speed_of_sound` or `velocity_scale` of the phase to ten times the largest speed, or allow it with \
             `numerics.supersonic = true`",
            100.0 * share
        );
        Some(StepError::stage("Mach number", reason))
    }
}

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
            let points = &world.walls.points;
            let points = points.position.iter().zip(&points.wall);
            let own = points.filter(|(_, w)| world.walls.names[**w as usize] == *name);
            let outside: Vec<bool> = own.map(|(x, _)| !world.domain.contains(x)).collect();
            if outside.is_empty() {
                continue;
            }
            let [some, all] = [outside.contains(&true), !outside.contains(&false)];
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
    pub fn remarks(&self) -> (Vec<String>, Vec<&'static str>) {
        let room = "a wall leaves the domain: give `numerics.domain` the room that it needs, or find the force that throws it \
                    (the probe `wall-force` measures the force of the fluid)";
        let shorter = "walls or bodies are thrown about within a step: smooth their courses and forces, or shorten the \
                       step with `run.safety`";
        let warnings = self.over.iter().map(|n| out_of(n));
        let warnings = warnings.chain(self.leap.clone()).collect();
        let advice = [
            (room, !self.over.is_empty()),
            (shorter, self.leap.is_some()),
        ];
        (warnings, given(advice))
    }

    /// The reason for the run's end, if a body has left the domain.
    pub fn verdict(&self) -> Option<StepError> {
        let (name, time) = self.gone.as_ref()?;
        let reason = format!(
            "the body `{name}` has left the domain by t = {time:.4} s: its force is too large, or `numerics.domain` too small"
        );
        Some(StepError::stage(WALL_MOTION, reason))
    }
}

fn out_of(name: &str) -> String {
    format!("wall `{name}` reaches out of the domain, beyond which there is no fluid")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundredth_is_told_once_and_a_tenth_leaves_no_result() {
        // Looks at kinetic and potential energy at a time; mass has left at the end where it is given.
        let look = |watch: &mut EnergyWatch, [kinetic, potential]: [f64; 2], left, time| {
            let acoustic = 100.0;
            let now = Balance::<2> {
                kinetic,
                potential,
                acoustic,
                ..Balance::zero()
            };
            watch.look(&now, left, time)
        };
        let watch = |driven| EnergyWatch {
            driven,
            ..EnergyWatch::default()
        };
        let mut flow = watch(false);
        assert_eq!(look(&mut flow, [0.0, 10.0], 0.0, 0.0), None);
        assert_eq!(look(&mut flow, [4.0, 6.0], 0.0, 1.0), None, "it falls");
        assert_eq!(look(&mut flow, [4.07, 6.0], 0.0, 2.0), None, "0.9 %");
        let told = look(&mut flow, [4.2, 6.0], 0.0, 3.0).expect("2.4 %");
        assert!(told.contains("2.000e-1 J, 2.4 %"), "{told}");
        assert_eq!(look(&mut flow, [4.3, 6.0], 0.0, 4.0), None, "once");
        assert!(flow.verdict().is_none() && flow.remarks().is_some());
        // Energy that was lost again was made all the same.
        look(&mut flow, [6.0, 6.0], 0.0, 5.0);
        look(&mut flow, [1.0, 6.0], 0.0, 6.0);
        assert!(flow.verdict().is_some());
        // At rest the scale is that of sound: 2e-3 of 100 J.
        let mut still = watch(false);
        look(&mut still, [0.0, 10.0], 0.0, 0.0);
        assert_eq!(look(&mut still, [1.9e-3, 10.0], 0.0, 1.0), None);
        assert!(look(&mut still, [2.1e-3, 10.0], 0.0, 2.0).is_some());
        let mut driven = watch(true);
        look(&mut driven, [0.0, 10.0], 0.0, 0.0);
        assert_eq!(look(&mut driven, [9.0, 10.0], 0.0, 1.0), None);
        assert!(driven.verdict().is_none());
        let mut leaving = watch(false);
        look(&mut leaving, [0.0, 10.0], 0.0, 0.0);
        assert_eq!(look(&mut leaving, [9.0, 10.0], 1.0, 1.0), None);
    }

    fn scene(more: &str) -> Scene {
        let text = format!(
            "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics = {{ spacing = 0.1{more} }}\n\
             phase.a = {{ density = 1, velocity_scale = 1, rheology.newtonian = {{ viscosity = 1 }} }}\n\
             body.a = {{ phase = \"a\", box = [[0, 0], [1, 1]] }}\n"
        );
        let loaded = sph_scene::parse(&text, "t.toml", &[]);
        loaded.unwrap_or_else(|e| panic!("{e}")).scene
    }

    #[test]
    fn a_tenth_of_the_mass_decides_and_the_warning_comes_once() {
        let balance = |faster| Balance::<2> {
            mass: 10.0,
            faster,
            ..Balance::zero()
        };
        let mut watch = MachWatch::default();
        // Spray: 5 % of the mass beyond the speed of sound.
        assert_eq!(watch.look(&balance([0.9, 0.9, 0.5])), None);
        assert!(watch.verdict(&scene("")).is_none());
        let told = watch.look(&balance([1.5, 1.5, 0.5])).expect("a warning");
        assert!(told.contains("15 % of the mass"), "{told}");
        assert_eq!(watch.look(&balance([1.5, 1.5, 0.5])), None, "once");
        watch.look(&balance([9.0, 9.0, 4.0]));
        let told = watch.verdict(&scene("")).expect("an end").to_string();
        assert!(told.contains("40 % of the mass") && told.contains("numerics.supersonic"));
        assert!(watch.verdict(&scene(", supersonic = true")).is_none());
    }
}

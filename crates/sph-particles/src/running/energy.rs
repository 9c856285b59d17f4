//! Energy that a flow without a drive gains: a warning while it runs, and no result beyond 10 %.

use sph_core::StepError;
use sph_scene::Scene;
use sph_solver::{Flow, defaults};

use crate::results::balance::Balance;
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
#[derive(Clone, Copy, Debug)]
pub(crate) struct EnergyWatch {
    /// True if anything else than its own weight may give the flow energy, or hold some that its sums leave out.
    driven: bool,
    /// Sum and potential energy in the first row, largest kinetic, least potential energy, largest rise of the sum.
    so_far: Option<[f64; 5]>,
    /// Largest rise over the scale of the flow.
    share: f64,
    warned: bool,
}

impl EnergyWatch {
    /// Of a scene; `so_far` is from the earlier part of a resumed run.
    pub fn from_scene<const D: usize>(
        scene: &Scene,
        flow: &Flow<D>,
        so_far: Option<[u64; 5]>,
    ) -> Self {
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
            so_far: so_far.map(|all| all.map(f64::from_bits)),
            share: 0.0,
            warned: false,
        }
    }

    /// State for a run that is resumed.
    pub fn bits(&self) -> Option<[u64; 5]> {
        self.so_far.map(|all| all.map(f64::to_bits))
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
        let damping = defaults::SOUND_DAMPING;
        let advice = format!(
            "`[probe.NAME] kind = \"energy-budget\"` lists the source of the energy; {damping} damps the sound that walls make, also beside a smoother"
        );
        (self.share > TOLD).then(|| [self.message(), advice])
    }

    /// The error of a run that made too much energy.
    pub fn verdict(&self) -> Option<StepError> {
        (self.share > GROSS).then(|| {
            StepError::stage(
                "energy",
                format!("{}: results of such a run are wrong", self.message()),
            )
        })
    }

    fn message(&self) -> String {
        let [.., rise] = self.so_far.unwrap_or_default();
        format!(
            "the energy of a flow without a drive has risen by {rise:.3e} J, {:.1} % of what moves in it",
            100.0 * self.share
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hundredth_is_told_once_and_a_tenth_leaves_no_result() {
        let balance = |kinetic, potential, acoustic| Balance::<2> {
            kinetic,
            potential,
            acoustic,
            ..Balance::zero()
        };
        let watch = EnergyWatch {
            driven: false,
            so_far: None,
            share: 0.0,
            warned: false,
        };
        let mut flow = watch;
        assert_eq!(flow.look(&balance(0.0, 10.0, 100.0), 0.0, 0.0), None);
        assert_eq!(
            flow.look(&balance(4.0, 6.0, 100.0), 0.0, 1.0),
            None,
            "it falls"
        );
        assert_eq!(
            flow.look(&balance(4.07, 6.0, 100.0), 0.0, 2.0),
            None,
            "0.9 %"
        );
        let told = flow
            .look(&balance(4.2, 6.0, 100.0), 0.0, 3.0)
            .expect("2.4 %");
        assert!(told.contains("2.000e-1 J, 2.4 %"), "{told}");
        assert_eq!(flow.look(&balance(4.3, 6.0, 100.0), 0.0, 4.0), None, "once");
        assert!(flow.verdict().is_none() && flow.remarks().is_some());
        // Energy that was lost again was made all the same.
        flow.look(&balance(6.0, 6.0, 100.0), 0.0, 5.0);
        flow.look(&balance(1.0, 6.0, 100.0), 0.0, 6.0);
        assert!(flow.verdict().is_some());
        // At rest the scale is that of sound: 2e-3 of 100 J.
        let mut still = watch;
        still.look(&balance(0.0, 10.0, 100.0), 0.0, 0.0);
        assert_eq!(still.look(&balance(1.9e-3, 10.0, 100.0), 0.0, 1.0), None);
        assert!(
            still
                .look(&balance(2.1e-3, 10.0, 100.0), 0.0, 2.0)
                .is_some()
        );
        let mut driven = EnergyWatch {
            driven: true,
            ..watch
        };
        driven.look(&balance(0.0, 10.0, 100.0), 0.0, 0.0);
        assert_eq!(driven.look(&balance(9.0, 10.0, 100.0), 0.0, 1.0), None);
        assert!(driven.verdict().is_none());
        let mut leaving = watch;
        leaving.look(&balance(0.0, 10.0, 100.0), 0.0, 0.0);
        assert_eq!(leaving.look(&balance(9.0, 10.0, 100.0), 1.0, 1.0), None);
    }
}

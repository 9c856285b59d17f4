//! Speed of the flow over that of sound: a warning while it runs, and an end where results are wrong.
//!
//! It is judged by mass, not by the fastest particle: a droplet of spray or the air beside a wave may pass
//! the speed of sound for a moment and carries next to nothing, while a tenth of all mass is the flow itself.

use sph_core::StepError;
use sph_scene::Scene;

use crate::results::balance::{Balance, COMPRESSIBLE, SUPERSONIC};

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
        Some(StepError::stage(
            "Mach number",
            format!(
                "{:.0} % of the mass is faster than its sound, and results of such a run are wrong: raise \
                 `speed_of_sound` or `velocity_scale` of the phase to ten times the largest speed, or allow it with \
                 `numerics.supersonic = true`",
                100.0 * share
            ),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

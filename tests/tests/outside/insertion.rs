//! Particles that come in while a flow runs: a kind of plugin from outside, `[tap.drip]`.

use sph_contribution::{
    Contribution, Gate, Newborn, Offer, OwnColumn, Refusal, Setting, StepHook, StepMoment,
    StepPhase, contribution_kind,
};
use sph_core::{Access, Field, Scalar, StepError, Vect, plugin};
use sph_neighbours::World;
use sph_tests::{finished, same_bits};

contribution_kind!(
    /// What lets particles in.
    pub TapEntry, "tap", Any, "what lets particles in"
);

const WARMTH: Field<Scalar> = Field::new("warmth", "K", "what particles begin with");

/// A drop at a place, once in a while.
#[plugin(TapEntry [2], "drip", "a drop once in a while", source: "a kitchen")]
struct Drip {
    /// Place of the drops.
    #[parameter(unit: "m")]
    at: [f64; 2],
    /// Time between two drops.
    #[parameter(unit: "s")]
    every: f64,
    /// Mass of a drop.
    #[parameter(unit: "kg")]
    mass: f64,
    /// Time at which a step fails, once.
    #[parameter(unit: "s")]
    fails_at: Option<f64>,
}

impl Contribution<2> for Drip {
    fn columns(&self) -> Vec<OwnColumn<2>> {
        vec![OwnColumn::scalar(WARMTH, |birth| match birth.body {
            "tap" => 60.0 + birth.position[0],
            _ => 20.0,
        })]
    }
    fn offer(&mut self, _: &Setting<'_, 2>, offer: &mut Offer<2>) -> Result<(), Refusal> {
        offer.hook(Failing(self.fails_at));
        offer.gate(*self);
        Ok(())
    }
}

/// Fails once, after a time, s.
struct Failing(Option<f64>);

impl StepHook<2> for Failing {
    fn name(&self) -> String {
        "dripping".into()
    }
    fn access(&self) -> Access {
        Access::none()
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterDrift]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, 2>) -> Result<(), StepError> {
        let fails = self.0.is_some_and(|t| moment.world.time > t);
        if fails {
            self.0 = None;
            return Err(StepError::Stage {
                stage: "dripping".into(),
                reason: "it fails once".into(),
            });
        }
        Ok(())
    }
}

/// Which drop is due follows from the time alone.
impl Gate<2> for Drip {
    fn name(&self) -> String {
        "drip".into()
    }
    fn access(&self) -> Access {
        Access::none()
    }
    fn births(&mut self, world: &mut World<2>, dt: f64) -> Result<Vec<Newborn<2>>, StepError> {
        let drops = |t: f64| (t / self.every).floor();
        let due = drops(world.time) > drops(world.time - dt);
        let drop = Newborn {
            position: self.at.into(),
            velocity: Vect::<2>::new(0.0, -1.0),
            density: 1000.0,
            mass: self.mass,
            phase: 0,
            body: "tap".into(),
            values: [].into(),
        };
        Ok(due.then_some(drop).into_iter().collect())
    }
}

/// Particles of the tank: nine columns of five.
const FIRST: u64 = 45;

/// A tank at rest and, beside it, drops that fall into an outlet.
const SCENE: &str = include_str!("tap.toml");

#[test]
fn drops_come_and_go_with_their_mass_their_columns_and_names_of_their_own() {
    let run = finished(SCENE, 1);
    let (summary, state) = (&run.summary, run.state());
    let born = (1.2_f64 / 0.151).floor() as u64;
    let left = &summary.left["outlet.floor.water"];
    // A drop falls 1.2 m in 0.41 s.
    let fallen = ((1.2_f64 - 0.41) / 0.151) as u64;
    let off = left.particles.abs_diff(fallen);
    assert!(off <= 1, "{left:?} of {born}, {fallen} fallen");
    assert_eq!(left.mass, 2.5 * left.particles as f64);
    let there = summary.particles as u64;
    assert_eq!(there, FIRST + born - left.particles);
    assert!(summary.drift.mass.abs() < 1e-14, "{:e}", summary.drift.mass);
    let mut all = state.columns["identity"].clone();
    all.sort_unstable();
    let drops = FIRST + left.particles..FIRST + born;
    let expected: Vec<u64> = (0..FIRST).chain(drops).collect();
    assert_eq!(all, expected, "first in, first out, and no name twice");
    let warmth = state.reals("warmth").into_iter();
    let warm = warmth.filter(|w| *w == 61.0).count() as u64;
    assert_eq!(warm, born - left.particles);
}

#[test]
fn births_and_deaths_are_the_same_bits_on_two_threads_resumed_and_after_a_step_was_taken_back() {
    // In the middle of drops that fall and drops that have left.
    same_bits(SCENE, 500, &[2], |halfway| {
        let identities = &halfway.columns["identity"];
        assert!(identities.iter().any(|id| *id >= FIRST), "{identities:?}");
    });
    // A step that fails is done again in shorter ones, and nobody is born twice.
    let failing = SCENE.replace("mass = 2.5", "mass = 2.5\nfails_at = 0.3");
    let run = finished(&failing, 1);
    let summary = &run.summary;
    assert_eq!(summary.steps_rolled_back, 1);
    assert!(summary.drift.mass.abs() < 1e-14, "{:e}", summary.drift.mass);
    let born = (1.2_f64 / 0.151).floor() as u64;
    let most = run.state().columns["identity"].iter().copied().max();
    assert_eq!(most, Some(FIRST - 1 + born));
}

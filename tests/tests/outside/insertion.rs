//! Particles that come in while a flow runs: a kind of plugin from outside, `[tap.drip]`.

use sph_contribution::{
    Contribution, Gate, Newborn, Offer, OwnColumn, Refusal, Setting, StepHook, StepMoment,
    StepPhase, contribution_kind,
};
use sph_core::{Access, Field, Scalar, StepError, Vect, plugin};
use sph_neighbours::World;
use sph_particles::{Summary, run};
use sph_run::{RunOptions, Start};
use sph_scene::parse;
use sph_tests::FinalState;

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
const SCENE: &str = r#"
title = "A tap that drips"
dimension = 2
[run]
end = 1.2
checkpoint_every = 0.05
[numerics]
spacing = 0.05
gravity = [0.0, -9.81]
domain = [[-1, -1], [3, 2]]
[smoother.brezzi-pitkaranta]
strength = 0.04
[walls.usaw]
vertices = true
[wall.tank]
polyline = [[0, 0.6], [0, 0], [0.5, 0], [0.5, 0.6]]
[phase.water]
density = 1000.0
speed_of_sound = 20.0
rheology.newtonian = { viscosity = "1 mPa s" }
[body.water]
phase = "water"
box = [[0, 0], [0.5, 0.3]]
pressure = "hydrostatic"
[outlet.floor]
box = [[0.8, -0.5], [1.2, -0.2]]
[tap.drip]
at = [1.0, 1.0]
every = 0.151
mass = 2.5
[output]
every = 1.2
vtk = false
fields = ["warmth"]
"#;

fn into(folder: &std::path::Path, text: &str, threads: usize, start: Start) -> Summary {
    let loaded = parse(text, "scene.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
    let options = RunOptions::new(folder, sph_run::Identity::of_text(SCENE))
        .start(start)
        .threads(threads);
    run(&loaded.scene, &options, &mut ()).unwrap_or_else(|e| panic!("{e}"))
}

fn identities(folder: &std::path::Path) -> Vec<u32> {
    let checkpoint = sph_io::Checkpoint::load(folder.join("checkpoint.sph")).expect("a checkpoint");
    match &checkpoint.column("identity").expect("identities").data {
        sph_io::ColumnData::U32(v) => v.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn drops_come_and_go_with_their_mass_their_columns_and_names_of_their_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = into(folder.path(), SCENE, 1, Start::Afresh);
    let born = (1.2_f64 / 0.151).floor() as u64;
    let left = &summary.left["outlet.floor.water"];
    // A drop falls 1.2 m in 0.41 s.
    let fallen = ((1.2_f64 - 0.41) / 0.151) as u64;
    assert!(
        left.particles.abs_diff(fallen) <= 1,
        "{left:?} of {born}, {fallen} fallen"
    );
    assert_eq!(left.mass, 2.5 * left.particles as f64);
    let there = summary.particles as u64;
    assert_eq!(there, FIRST + born - left.particles);
    assert!(summary.drift.mass.abs() < 1e-14, "{:e}", summary.drift.mass);
    let mut all = identities(folder.path());
    all.sort_unstable();
    let expected: Vec<u32> = (0..FIRST as u32)
        .chain((FIRST + left.particles) as u32..(FIRST + born) as u32)
        .collect();
    assert_eq!(all, expected, "first in, first out, and no name twice");
    let state = FinalState::read(folder.path());
    let warmth = state.columns["warmth"].iter().map(|b| f64::from_bits(*b));
    let warm = warmth.filter(|w| *w == 61.0).count() as u64;
    assert_eq!(warm, born - left.particles);
}

#[test]
fn births_and_deaths_are_the_same_bits_on_two_threads_resumed_and_after_a_step_was_taken_back() {
    let folders: Vec<_> = (0..4)
        .map(|_| tempfile::tempdir().expect("a folder"))
        .collect();
    let path = |k: usize| folders[k].path();
    into(path(0), SCENE, 1, Start::Afresh);
    let whole = FinalState::read(path(0));
    into(path(1), SCENE, 2, Start::Afresh);
    FinalState::read(path(1)).assert_same(&whole, "two threads");
    // In the middle of drops that fall and drops that have left.
    let part = SCENE.replace("end = 1.2", "end = 1.2\nmax_steps = 500");
    into(path(2), &part, 1, Start::Afresh);
    let halfway = identities(path(2));
    assert!(
        halfway.iter().any(|id| u64::from(*id) >= FIRST),
        "{halfway:?}"
    );
    into(path(2), SCENE, 2, Start::Resumed);
    FinalState::read(path(2)).assert_same(&whole, "resumed");
    // A step that fails is done again in shorter ones, and nobody is born twice.
    let failing = SCENE.replace("mass = 2.5", "mass = 2.5\nfails_at = 0.3");
    let summary = into(path(3), &failing, 1, Start::Afresh);
    assert_eq!(summary.steps_rolled_back, 1);
    assert!(summary.drift.mass.abs() < 1e-14, "{:e}", summary.drift.mass);
    let born = (1.2_f64 / 0.151).floor() as u32;
    let most = identities(path(3)).into_iter().max();
    assert_eq!(most, Some(FIRST as u32 - 1 + born));
}

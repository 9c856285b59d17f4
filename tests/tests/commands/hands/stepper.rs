//! A scene stepped by hand: the bits of a run, and columns that are changed between steps.

use sph_core::{Plain, Role, StepError, fields};
use sph_particles::{Stepper, run};
use sph_run::{Identity, RunOptions};
use sph_scene::Scene;
use sph_tests::Says;

const SCENE: &str = include_str!("../../../../scenes/dam-break-koshizuka.toml");

fn scene() -> Scene {
    let set = [
        "numerics.spacing=0.0146",
        "run.end=0.05",
        "output.every=0.02",
    ];
    let set = set.map(|s| sph_scene::Override::parse(s).expect("an override"));
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/dam.toml");
    let loaded = sph_scene::parse(SCENE, file, &set);
    loaded.unwrap_or_else(|e| panic!("{e}")).scene
}

#[test]
fn stepped_by_hand_a_dam_break_has_the_bits_of_a_run() {
    let scene = scene();
    let folder = sph_io::Scratch::new(".sph-stepper-").expect("a folder");
    let options = RunOptions::new(folder.path().join("run"), Identity::of_text("dam")).threads(1);
    let summary = run(&scene, &options, &mut ()).unwrap_or_else(|e| panic!("{e}"));
    let mut stepper = Stepper::<2>::new(&scene).unwrap_or_else(|e| panic!("{e}"));
    for target in [0.02, 0.04, 0.05] {
        stepper.run_until(target).unwrap_or_else(|e| panic!("{e}"));
    }
    assert_eq!(stepper.steps().0, summary.steps);
    let saved = sph_io::Checkpoint::load(folder.path().join("run/checkpoint.sph")).expect("saved");
    let mut compared = 0;
    for (name, _, role, _, values) in stepper.parts().flow.world.free.columns() {
        let (Role::State, Plain::Real(values)) = (role, values) else {
            continue;
        };
        let column = saved.column(name).expect("a column");
        assert_eq!(column.data, sph_io::ColumnData::F64(values.into_owned()));
        compared += 1;
    }
    assert!(compared >= 4, "only {compared} columns");
}

#[test]
fn a_changed_velocity_is_felt_and_what_is_derived_cannot_be_changed() {
    let mut stepper = Stepper::<2>::new(&scene()).unwrap_or_else(|e| panic!("{e}"));
    stepper.run_until(0.005).unwrap_or_else(|e| panic!("{e}"));
    let count = stepper.parts().flow.world.free.len();
    let told = |r: Result<(), StepError>| r.unwrap_err().to_string();
    let pressure = told(stepper.set("pressure", &vec![0.0; count]));
    pressure.says("is not state");
    let short = told(stepper.set("velocity", &[0.0]));
    short.says("velocity");
    stepper.set("velocity", &vec![0.0; 2 * count]).expect("set");
    let energy = |s: &Stepper<2>| {
        let velocity = s.parts().flow.world.free.get(fields::VELOCITY).expect("u");
        velocity.iter().map(|u| u.norm_squared()).sum::<f64>()
    };
    assert_eq!(energy(&stepper), 0.0);
    stepper.step(1.0).unwrap_or_else(|e| panic!("{e}"));
    assert!(energy(&stepper) > 0.0);
}

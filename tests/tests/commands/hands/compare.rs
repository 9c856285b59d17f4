//! `sph compare`.

use serde_json::Value as Json;
use sph_tests::{DAM_BREAK, Says, bench};

const RUN: &str = "run scene.toml -q --threads 1 --set run.end=0.05 --set output.every=0.025";

#[test]
fn runs_on_one_and_two_threads_have_the_same_bits() {
    let bench = bench!(DAM_BREAK);
    bench.done(&format!("{RUN} --out a"));
    bench.done(&RUN.replace("--threads 1", "--threads 2 --out b"));
    let told = bench.done("compare a b").out;
    assert!(told.starts_with("the same bits in "), "{told}");
    let json = bench.done("compare a b --json").json();
    assert_eq!(json["same"], true);
    let columns = json["columns"].as_array().expect("columns");
    assert!(columns.len() > 20, "{} columns", columns.len());
}

#[test]
fn a_number_that_was_changed_is_found_with_its_particle_and_place() {
    let bench = bench!(DAM_BREAK);
    bench.done(&format!("{RUN} --out a"));
    bench.done(&format!("{RUN} --out b"));
    let path = bench.path("b/checkpoint.sph");
    let mut checkpoint = sph_io::Checkpoint::load(&path).expect("a checkpoint");
    let place = |c: &sph_io::Checkpoint, name: &str| c.columns.iter().position(|c| c.name == name);
    let (velocity, identity) = (
        place(&checkpoint, "velocity"),
        place(&checkpoint, "identity"),
    );
    let sph_io::ColumnData::U32(numbers) = &checkpoint.columns[identity.expect("there")].data
    else {
        panic!("identities are whole numbers");
    };
    let number = numbers[17];
    let sph_io::ColumnData::F64(u) = &mut checkpoint.columns[velocity.expect("there")].data else {
        panic!("velocities are reals");
    };
    u[2 * 17 + 1] += 0.25;
    checkpoint.save(&path).expect("saved");
    let outcome = bench.failed("compare a b --json");
    let json = outcome.json();
    let columns = json["columns"].as_array().expect("columns");
    let differ: Vec<&Json> = columns.iter().filter(|c| c["same"] == false).collect();
    let [only] = differ.as_slice() else {
        panic!("{differ:#?}");
    };
    assert_eq!(only["column"], "velocity");
    assert_eq!(only["file"], "checkpoint.sph");
    assert_eq!(only["particle"], number);
    assert_eq!(only["component"], 1);
    assert!((only["largest"].as_f64().expect("a number") - 0.25).abs() < 1e-12);
    let text = bench.call("compare a b").out;
    text.says(&format!("particle {number}, y, at ("));
}

#[test]
fn runs_of_other_steps_differ_in_their_fields_and_nothing_is_nothing() {
    let bench = bench!(DAM_BREAK);
    bench.done(&format!("{RUN} --out a"));
    bench.done(&format!("{RUN} --out b --set run.safety=0.5"));
    let outcome = bench.failed("compare a b");
    outcome.out.says("fields of fluid | t = 0.05 s");
    assert_eq!(bench.call("compare a gone").code, Some(2));
    std::fs::create_dir(bench.path("empty")).expect("a folder");
    assert_eq!(bench.call("compare a empty").code, Some(2));
    std::fs::create_dir(bench.path("bare")).expect("a folder");
    let refused = bench.refused("compare bare empty");
    refused.says("no file of results in common");
}

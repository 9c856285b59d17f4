//! Costs against the number of particles.

use sph_tests::Says;

use crate::study::{bench, files};

const SCALING: &str = include_str!("scaling.toml");

#[test]
fn a_study_tells_the_cost_of_a_solve_against_size() {
    let bench = bench(SCALING);
    let outcome = bench.done("study s.toml --threads 1");
    outcome
        .out
        .says("time per solve | memory | exponent | fastest from 49 ");
    let folder = bench.path("results/studies/s");
    let left = files(&folder);
    let has = |name: &str| left.contains(&name.to_string());
    assert!(has("cost-against-size.png") && has("cost-against-size.svg"));
    assert!(!has("error-against-time.png"), "there is no error to show");
    let page = bench.read("results/studies/s/report.html");
    assert!(page.contains("Cost against size") && !page.contains("Error against run time"));

    let told = bench.json("results/studies/s/study.json");
    for variant in told["variants"].as_array().expect("variants") {
        let solves = &variant["solves"];
        let direct = variant["values"]["solver"] == "direct";
        let iterations = solves["iterations"].as_f64();
        assert_eq!(iterations == Some(0.0), direct, "{solves}");
        // Outputs do not cut the steps, which would make them less stiff than the study says.
        let solved = solves["count"].as_u64();
        assert!((Some(1)..=Some(6)).contains(&solved), "{solves}");
        assert!(solves["seconds"].as_f64() > Some(0.0));
        // At least the matrix: 12 bytes for each of some 25 neighbours.
        let bytes = solves["bytes"].as_f64().expect("bytes");
        assert!(bytes > 200.0 * variant["particles"].as_f64().expect("particles"));
    }
    let series = told["scale"]["series"].as_array().expect("series");
    assert_eq!(series.len(), 2);
    for one in series {
        assert_eq!(one["points"].as_array().map(Vec::len), Some(3));
        assert!(one["exponent"].is_f64(), "{one}");
    }
    let ends = |k: usize| told["scale"]["fastest"][k]["particles"][1].as_f64();
    let stretches = told["scale"]["fastest"]
        .as_array()
        .expect("stretches")
        .len();
    assert_eq!(ends(stretches - 1), Some(576.0), "up to the largest size");
}

#[test]
fn competitors_that_are_not_there_are_refused() {
    let bench = bench(&SCALING.replace("between = \"solver\"", "between = \"sovler\""));
    let outcome = bench.refused("study s.toml");
    outcome.says("s.toml:3: | no axis `sovler` | did you mean `solver`");
}

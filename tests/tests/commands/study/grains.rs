//! Studies over scenes of grains.

use crate::study::bench;

/// A few grains that fall into a box.
const SCENE: &str = include_str!("grains.toml");

const STUDY: &str = r#"title = "How many fall"
scene = "grains.toml"
error = "fall"
[[vary]]
key = "grains.count"
values = [10, 20]
[[vary]]
key = "run.safety"
values = [0.2, 0.4]
"#;

#[test]
fn grains_are_studied_as_particles_are_and_settled_once() {
    let bench = bench(STUDY);
    bench.write("grains.toml", SCENE);
    let first = bench.done("study s.toml --quiet --json --out r");
    let results = first.json();
    let variants = results["variants"].as_array().expect("variants");
    assert_eq!(variants.len(), 4);
    for variant in variants {
        assert_eq!(variant["status"], "done", "{variant}");
        let error = variant["errors"]["fall"]["value"].as_f64();
        let error = error.unwrap_or_else(|| panic!("no error: {variant}"));
        // A kick, then a drift: n − 1 steps Δt and one δ that is shorter fall by g [t² + (n − 1) Δt² + δ²]/2.
        let steps = variant["steps"].as_f64().expect("steps");
        assert!(error <= 1.0 / (steps - 1.0), "{error} after {steps}");
        assert!(steps > 10.0, "{variant}");
    }
    // Nothing is run again, so that not even the times change.
    let again = bench.done("study s.toml --quiet --json --out r");
    assert_eq!(again.json()["variants"], results["variants"]);
}

#[test]
fn mistakes_of_grains_are_shown_where_the_study_makes_them() {
    let bench = bench(&STUDY.replace("\"run.safety\"", "\"run.safty\""));
    bench.write("grains.toml", SCENE);
    let refused = bench.refused("study s.toml --quiet --out r");
    refused.says("did you mean `safety`? | s.toml");
    assert!(!bench.path("r").exists());
}

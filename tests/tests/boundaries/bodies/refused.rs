//! What no body can be, and where it is said.

use sph_tests::{bench, line_of, refusals};

use crate::bodies::FLOAT;

/// `sph run` refuses the scene with the changes of a file, at the line that each names.
fn refuses(file: &'static str) {
    for case in refusals(file) {
        let scene = case.of(FLOAT);
        let bench = bench!(&scene);
        let refused = bench.refused("run scene.toml --quiet --out r");
        assert!(!bench.path("r").exists(), "something was written");
        let line = line_of(&scene, case.at);
        refused.says(&format!("scene.toml:{line}: | {}", case.said.join(" | ")));
    }
}

#[test]
fn bodies_that_none_can_be_are_refused_at_their_line() {
    refuses(include_str!("bodies.refused"));
}

#[test]
fn lines_and_chains_that_cannot_hang_are_refused_at_their_line() {
    refuses(include_str!("lines.refused"));
    // The way between its ends is free, but what hangs there is not.
    let sill = "[wall.sill]\nbox = [[0.3, 0.0], [0.34, 0.1]]\nfluid = \"outside\"\n[wall.float]";
    let chain = "density = 500.0\n[[wall.float.mover.rigid-body.line]]\nfrom = [0.2, 0.0]\nto = [0.4, 0.2]\n\
                 stiffness = 1e4\nweight = 5.0\nlength = 0.3\nbed = false";
    let scene = FLOAT.replacen("[wall.float]", sill, 1);
    let bench = bench!(&scene.replacen("density = 500.0", chain, 1));
    let refused = bench.refused("run scene.toml --quiet --out r");
    refused.says("goes through the wall `sill`");
}

#[test]
fn bodies_that_overlap_at_the_start_are_refused() {
    for other in ["[[0.45, 0.25], [0.6, 0.4]]", "[[0.35, 0.22], [0.45, 0.28]]"] {
        let two = format!(
            "[wall.other]\nbox = {other}\nfluid = \"outside\"\n[wall.other.mover.rigid-body]\n\
             density = 700.0\n[phase.water]"
        );
        let scene = FLOAT.replacen("[phase.water]", &two, 1);
        let bench = bench!(&scene);
        let outcome = bench.refused("run scene.toml --quiet --out r");
        outcome.says("[wall.");
        let named = outcome.err.contains("other") && outcome.err.contains("float");
        assert!(named, "{}", outcome.err);
    }
}

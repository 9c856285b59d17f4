//! Beds and gates that nobody wants: refused at their line, or remarked upon before the run starts.

use sph_tests::{bench, one_line};

const BED: &str = include_str!("../../../../scenes/saturated-bed-at-rest.toml");

/// Replaces parts of the bed; they must be there.
fn with(changes: &[[&str; 2]]) -> String {
    changes.iter().fold(BED.to_string(), |text, [from, to]| {
        assert!(text.contains(from), "the scene lost `{from}`");
        text.replacen(from, to, 1)
    })
}

/// What `sph check` says of a scene that is good.
fn checked(scene: &str) -> String {
    let outcome = bench!(scene).call("check scene.toml").ended(0);
    // Lines are broken where the text ends.
    one_line(&outcome.out)
}

fn says(text: &str, words: &str) {
    assert!(text.contains(words), "no `{words}` in\n{text}");
}

#[test]
fn nothing_is_odd_about_the_shipped_bed() {
    let text = checked(BED);
    for words in [
        "stands above",
        "beneath them",
        "spacings wide",
        "bounds the first step",
    ] {
        assert!(!text.contains(words), "`{words}` in\n{text}");
    }
}

#[test]
fn a_saturated_soil_that_stands_dry() {
    let scene = with(&[
        [
            "box = [[0.0, 0.1], [0.1, 0.2]]",
            "box = [[0.0, 0.1], [0.05, 0.12]]",
        ],
        [
            "[body.water]",
            "[body.heap]\nphase = \"sand\"\nbox = [[0.05, 0.1], [0.1, 0.2]]\n[body.water]",
        ],
    ]);
    let text = checked(&scene);
    says(&text, "of `sand` stands above the highest water");
    says(
        &text,
        "`effective-pressure` takes its pores as full of water",
    );
}

#[test]
fn a_bed_with_a_gap_over_the_floor() {
    let scene = with(&[[
        "box = [[0.0, 0.0], [0.1, 0.1]]",
        "box = [[0.0, 0.02], [0.1, 0.1]]",
    ]]);
    let text = checked(&scene);
    says(
        &text,
        "particles of `sand` have neither a wall nor a fluid beneath them",
    );
}

#[test]
fn grains_far_wider_than_the_spacing() {
    let scene = with(&[["grain_diameter = \"4 mm\"", "grain_diameter = \"60 mm\""]]);
    says(&checked(&scene), "a grain of `sand` is 12 spacings wide");
}

/// G = 2E/(2·1.3) and √(4/3 G/ρ) of 10²¹ Pa: 5·10⁸ m/s, and so some picoseconds.
#[test]
fn a_skeleton_so_stiff_that_steps_are_tiny() {
    let scene = with(&[["young_modulus = \"0.8 MPa\"", "young_modulus = 1e21"]]);
    let text = checked(&scene);
    says(&text, "`elastic wave` bounds the first step to");
    says(&text, "steps to t = 0.2 s");
}

#[test]
fn a_gate_faster_than_sound() {
    let gate = "[wall.gate]\nbox = [[0.04, 0.3], [0.06, 0.4]]\nfluid = \"outside\"\n\
                [wall.gate.motion]\nvelocity = [0.0, 25.0]\n\n[phase.sand]";
    let scene = with(&[["[phase.sand]", gate]]);
    let bench = bench!(&scene);
    let line = 1 + scene
        .lines()
        .position(|l| l == "[wall.gate.motion]")
        .expect("the line");
    for command in ["check", "run"] {
        let outcome = bench.refused(&format!("{command} scene.toml"));
        let text = one_line(&outcome.err);
        says(
            &text,
            "the wall moves with 25.000 m/s, faster than sound in the slowest phase, 20.000 m/s",
        );
        says(&text, &format!("scene.toml:{line}:"));
    }
    assert_eq!(bench.names().len(), 1, "something was written");
}

//! Whole steps of the open channel over a smooth bed: without closure and wall function, with the wall function, and with
//! closures besides. Items are particles.

mod running;

use divan::Bencher;
// For its plugins.
use sph_turbulence as _;

use running::measured;

const SCENE: &str = include_str!("../../scenes/turb-channel-k-epsilon.toml");
/// The tables of the scene that a case leaves out.
const K_EPSILON: [&str; 1] = ["[eddy-viscosity.k-epsilon.channel]"];
const WALL: [&str; 3] = [
    "[wall-function.log-law]",
    "[flow-control.bulk-velocity]",
    "[probe.bed]",
];
/// Nor what is measured.
const MEASURED: [&str; 5] = [
    "[reference.profile]",
    "[reference.profile.parameters]",
    "[reference.friction-velocity]",
    "[reference.shear]",
    "[output]",
];

/// What is in the channel, and the tables that make it.
const CASES: [(&str, &str); 5] = [
    ("nothing", ""),
    ("wall function", ""),
    ("smagorinsky", "[eddy-viscosity.smagorinsky]"),
    (
        "smagorinsky, strain of the last step",
        "[eddy-viscosity.smagorinsky]\nstrain_of = \"last-step\"",
    ),
    ("k-epsilon", ""),
];

fn main() {
    divan::main();
}

#[divan::bench(args = CASES.map(|(name, _)| name), sample_count = 300)]
fn step(bencher: Bencher, case: &str) {
    let (_, table) = CASES
        .into_iter()
        .find(|(name, _)| *name == case)
        .expect("a case");
    let mut left_out = MEASURED.to_vec();
    if case != "k-epsilon" {
        left_out.extend(K_EPSILON);
    }
    if case == "nothing" {
        left_out.extend(WALL);
    }
    let text = format!("{}\n{table}\n", without(SCENE, &left_out));
    measured(bencher, &text, 50);
}

/// The text without the tables of these headings.
fn without(text: &str, headings: &[&str]) -> String {
    let mut kept = true;
    let mut lines = Vec::new();
    for line in text.lines() {
        if line.starts_with('[') {
            kept = !headings.contains(&line.trim());
        }
        if kept {
            lines.push(line);
        }
    }
    lines.join("\n")
}

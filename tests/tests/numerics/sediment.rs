//! Beds that a flow moves: laws, the balance of the grains, the same bits, refusals.

use sph_soil::sediment::Grains;
use sph_tests::{Bench, Series, assembly_refuses, bench, close};

/// Water over a bed along x with a bump in the middle.
pub(super) const CHANNEL: &str = include_str!("channel.toml");

/// A heap of sand in a channel of three dimensions.
pub(super) fn in_space() -> String {
    CHANNEL
        .replace("dimension = 2", "dimension = 3")
        .replace("end = 0.05", "end = 0.01")
        .replace("gravity = [0.0, -9.81]", "gravity = [0.0, 0.0, -9.81]")
        .replace(
            "periodic = { x = [0.0, 0.4] }",
            "periodic = { x = [0.0, 0.24] }",
        )
        .replace("spacing = 0.01", "spacing = 0.02")
        .replace(
            "polyline = [[0.0, 0.0], [0.15, 0.0], [0.2, 0.02], [0.25, 0.0], [0.4, 0.0]]",
            "box = [[0.0, 0.0, 0.0], [0.24, 0.16, 0.3]]\nopen = [\"x-\", \"x+\", \"z+\"]",
        )
        .replace(
            "rock = -0.1",
            "rock = -0.1\n[wall.heap]\ncone = { base = [0.12, 0.08, 0.0], apex = [0.12, 0.08, 0.03], radius = 0.06, sides = 8 }\n\
             fluid = \"outside\"\ncondition = \"free-slip\"\nstands_in = \"bed\"",
        )
        .replace(
            "box = [[0.0, 0.0], [0.4, 0.1]]",
            "box = [[0.0, 0.0, 0.0], [0.24, 0.16, 0.1]]",
        )
        .replace("velocity = [1.0, 0.0]", "velocity = [1.0, 0.2, 0.0]")
}

pub(super) fn column(bench: &Bench, folder: &str, name: &str) -> Vec<f64> {
    bench.series(folder).column(name).to_vec()
}

fn curve(bench: &Bench, file: &str) -> Series {
    Series::of(&bench.path(file))
}

/// The flux at every place is 8 (θ − θ_c)^1.5 √((s − 1) g d³) of the Shields number there, the threshold Soulsby's on the slope.
#[test]
fn the_flux_is_that_of_the_law() {
    let bench = bench!(CHANNEL);
    bench.done("run scene.toml --quiet --out out");
    let grains = Grains {
        diameter: 1e-3,
        relative_density: 2.65,
        viscosity: 1e-6,
        gravity: 9.81,
    };
    let table = curve(&bench, "out/curves/bed_0001.csv");
    let [x, shields, flux] = table.columns(["x", "shields", "transport"]);
    let flat = |x: f64| !(0.12..0.28).contains(&x);
    let mut counted = 0;
    for k in (0..x.len()).filter(|k| flat(x[*k])) {
        let excess = (shields[k] - grains.critical_shields()).max(0.0);
        let law = 8.0 * excess.powf(1.5) * grains.unit_transport();
        // Levels have changed a little: slopes of some 10⁻³ change the threshold by 10⁻³ of itself.
        close(flux[k], law, 5e-3 * law + 1e-12, "flux");
        counted += usize::from(law > 0.0);
    }
    assert!(counted > 10, "{counted} places moved");
}

/// Σ z ΔA stays to rounding while the bump moves, over which the flow goes; a bed that ends within its wall counts the rest.
#[test]
fn grains_are_neither_made_nor_lost() {
    for (name, scene) in [("plane", CHANNEL), ("space", &in_space())] {
        let bench = bench!(scene);
        bench.done("run scene.toml --quiet --out out");
        let volume = column(&bench, "out", "bed.volume");
        let moved = curve(&bench, "out/curves/bed_0001.csv");
        let most = moved.largest_size("rise");
        assert!(most > 1e-7, "{name}: nothing moved");
        let worst = volume.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        assert!(worst < 1e-15, "{name}: {worst:e}");
    }
    let part = CHANNEL.replace("rock = -0.1", "from = [0.1]\nto = [0.3]");
    let bench = bench!(&part);
    bench.done("run scene.toml --quiet --out out");
    let [volume, fed] = ["bed.volume", "bed.fed"].map(|name| column(&bench, "out", name));
    let (grown, fed) = (volume.last().expect("rows"), fed.last().expect("rows"));
    // Grains have pores among them, 0.4 of the volume.
    assert!(fed.abs() > 1e-9, "nothing passed");
    assert!((0.6 * grown - fed).abs() < 1e-16, "{grown:e} {fed:e}");
}

#[test]
fn beds_have_the_same_bits_on_threads_and_after_an_interruption() {
    for scene in [CHANNEL, &in_space()] {
        bench!(scene).same_bits("", 7);
    }
}

#[test]
fn beds_that_are_none_are_refused() {
    assembly_refuses(CHANNEL, include_str!("sediment.refused"));
}

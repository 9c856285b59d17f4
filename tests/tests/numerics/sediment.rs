//! Beds that a flow moves: laws, the balance of the grains, the same bits, refusals.

use sph_particles::setup::assemble;
use sph_scene::parse;
use sph_soil::sediment::Grains;
use sph_tests::{Bench, FinalState};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

/// Water over a bed along x with a bump in the middle.
pub(super) const CHANNEL: &str = r#"
title = "Water over sand"
dimension = 2
[run]
end = 0.05
[numerics]
spacing = 0.01
smoothing_ratio = 2.0
gravity = [0.0, -9.81]
periodic = { x = [0.0, 0.4] }
[viscous-operator.morris]
within = "arithmetic"
[eddy-viscosity.mixing-length]
depth = 0.1
walls = ["bed"]
[wall-function.log-law]
walls = ["bed"]
roughness = "2.5 mm"
[bed-load.meyer-peter-muller]
grain_diameter = "1 mm"
[walls.usaw]
vertices = false
[wall.bed]
polyline = [[0.0, 0.0], [0.15, 0.0], [0.2, 0.02], [0.25, 0.0], [0.4, 0.0]]
condition = "free-slip"
[wall.bed.erodible]
rock = -0.1
[phase.water]
density = 1000.0
speed_of_sound = 15.0
rheology.newtonian = { viscosity = "1 mPa s" }
[body.water]
phase = "water"
box = [[0.0, 0.0], [0.4, 0.1]]
clip = true
pressure = "hydrostatic"
velocity = [1.0, 0.0]
[probe.bed]
kind = "bed-levels"
wall = "bed"
[output]
every = 0.05
series_every = 1e-9
vtk = false
"#;

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
    let series = sph_io::read_table(bench.path(&format!("{folder}/series.csv"))).expect("a series");
    series.column(name).expect("a column").to_vec()
}

fn curve(bench: &Bench, file: &str) -> sph_io::Table {
    sph_io::read_table(bench.path(file)).expect("a curve")
}

/// The flux at every place is 8 (θ − θ_c)^1.5 √((s − 1) g d³) of the Shields number there, the threshold Soulsby's on the slope.
#[test]
fn the_flux_is_that_of_the_law() {
    let bench = Bench::with(PROGRAM, CHANNEL);
    bench.done("run scene.toml --quiet --out out");
    let grains = Grains {
        diameter: 1e-3,
        relative_density: 2.65,
        viscosity: 1e-6,
        gravity: 9.81,
    };
    let table = curve(&bench, "out/curves/bed_0001.csv");
    let column = |name: &str| table.column(name).expect("a column");
    let [x, shields, flux] = ["x", "shields", "transport"].map(column);
    let flat = |x: f64| !(0.12..0.28).contains(&x);
    let mut counted = 0;
    for k in (0..x.len()).filter(|k| flat(x[*k])) {
        let excess = (shields[k] - grains.critical_shields()).max(0.0);
        let law = 8.0 * excess.powf(1.5) * grains.unit_transport();
        // Levels have changed a little: slopes of some 10⁻³ change the threshold by 10⁻³ of itself.
        assert!(
            (flux[k] - law).abs() < 5e-3 * law + 1e-12,
            "{} {law}",
            flux[k]
        );
        counted += usize::from(law > 0.0);
    }
    assert!(counted > 10, "{counted} places moved");
}

/// Σ z ΔA stays to rounding while the bump moves, over which the flow goes; a bed that ends within its wall counts the rest.
#[test]
fn grains_are_neither_made_nor_lost() {
    for (name, scene) in [("plane", CHANNEL.to_string()), ("space", in_space())] {
        let bench = Bench::with(PROGRAM, &scene);
        bench.done("run scene.toml --quiet --out out");
        let volume = column(&bench, "out", "bed.volume");
        let moved = curve(&bench, "out/curves/bed_0001.csv");
        let rise = moved.column("rise").expect("a column");
        let most = rise.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        assert!(most > 1e-7, "{name}: nothing moved");
        let worst = volume.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        assert!(worst < 1e-15, "{name}: {worst:e}");
    }
    let part = CHANNEL.replace("rock = -0.1", "from = [0.1]\nto = [0.3]");
    let bench = Bench::with(PROGRAM, &part);
    bench.done("run scene.toml --quiet --out out");
    let [volume, fed] = ["bed.volume", "bed.fed"].map(|name| column(&bench, "out", name));
    let (grown, fed) = (volume.last().expect("rows"), fed.last().expect("rows"));
    // Grains have pores among them, 0.4 of the volume.
    assert!(fed.abs() > 1e-9, "nothing passed");
    assert!((0.6 * grown - fed).abs() < 1e-16, "{grown:e} {fed:e}");
}

#[test]
fn beds_have_the_same_bits_on_threads_and_after_an_interruption() {
    for (name, scene) in [("plane", CHANNEL.to_string()), ("space", in_space())] {
        let bench = Bench::with(PROGRAM, &scene);
        bench.done("run scene.toml --quiet --out one --threads 1");
        bench.done("run scene.toml --quiet --out two --threads 2");
        let one = FinalState::read(&bench.path("one"));
        one.assert_same(&FinalState::read(&bench.path("two")), name);
        let parts = "run scene.toml --quiet --out parts";
        bench.call(&format!("{parts} --set run.max_steps=7"));
        bench.done(&format!("{parts} --resume --changed"));
        let parts = FinalState::read(&bench.path("parts"));
        assert_eq!(
            one.columns["wall_states"], parts.columns["wall_states"],
            "{name}"
        );
        one.assert_same(&parts, name);
    }
}

/// Assembly refuses the scene with these words.
fn refused(from: &str, to: &str, words: &str) {
    refused_of(CHANNEL, from, to, words);
}

/// The same of another scene.
pub(crate) fn refused_of(scene: &str, from: &str, to: &str, words: &str) {
    assert!(scene.contains(from), "the scene lost `{from}`");
    let text = scene.replacen(from, to, 1);
    let text = match text.contains("gravity = [") {
        true => text,
        false => text.replace("pressure = \"hydrostatic\"", ""),
    };
    let told = match parse(&text, "scene.toml", &[]) {
        Err(error) => error.to_string(),
        Ok(loaded) => match assemble::<2>(&loaded.scene) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("accepted: {to}"),
        },
    };
    assert!(told.contains(words), "no `{words}` in\n{told}");
}

#[test]
fn beds_that_are_none_are_refused() {
    let law = "[bed-load.meyer-peter-muller]\ngrain_diameter = \"1 mm\"\n";
    refused(
        "[wall.bed.erodible]\nrock = -0.1\n",
        "",
        "no wall of this scene is a bed",
    );
    refused(
        "rock = -0.1",
        "rock = 0.0199",
        "nowhere thicker than 1.000e-4 m, less than a grain",
    );
    refused(
        "grain_diameter = \"1 mm\"",
        "grain_diameter = \"1 mm\"\ngrain_density = 900.0",
        "float in a fluid of 1000 kg/m³",
    );
    refused(
        "grain_diameter = \"1 mm\"",
        "grain_diameter = \"0 mm\"",
        "must be more than 0 m, found 0",
    );
    refused("gravity = [0.0, -9.81]", "", "grains without weight");
    refused(
        "rock = -0.1",
        "from = [0.1, 0.2]",
        "expected 1 number(s) in 2D, found 2",
    );
    refused(
        "rock = -0.1",
        "from = [0.3]\nto = [0.1]",
        "must end behind its beginning",
    );
    refused(
        "[wall.bed.erodible]",
        "[wall.bed.motion]\nvelocity = [0.1, 0.0]\n[wall.bed.erodible]",
        "a bed of grains, and walls that stand in it, have no `motion`",
    );
    refused(
        "[phase.water]",
        "[wall.pile]\nbox = [[0.3, 0.0], [0.35, 0.1]]\n\
         fluid = \"outside\"\nstands_in = \"bett\"\n[phase.water]",
        "no wall `bett` is `erodible`, did you mean `bed`",
    );
    refused(
        "[walls.usaw]\nvertices = false",
        "[walls.symmetric]",
        "bends, and a scale is for a constant shape",
    );
    refused(
        "[wall-function.log-law]\nwalls = [\"bed\"]\nroughness = \"2.5 mm\"\n",
        "",
        "bed-load.meyer-peter-muller: the shear on a bed is that of a wall function",
    );
    refused(
        law,
        &format!("{law}repose_angle = \"95 deg\"\n"),
        "must be less than 1.57 rad",
    );
}

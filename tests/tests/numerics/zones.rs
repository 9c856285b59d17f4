//! Zones of finer particles: a flow passes them unchanged, mass follows mass, the same bits, refusals.

use sph_io::Checkpoint;
use sph_tests::{Bench, FinalState};

const PROGRAM: &str = env!("CARGO_BIN_EXE_sph-under-test");

/// A dam break that meets a zone and one within it, both dry at first.
const DAM: &str = r#"
title = "A dam break into zones"
dimension = 2
[run]
end = 0.4
[numerics]
spacing = 0.04
gravity = [0.0, -9.81]
relax = { steps = 0 }
[smoother.brezzi-pitkaranta]
[walls.usaw]
[wall.tank]
polyline = [[0.0, 2.0], [0.0, 0.0], [1.6, 0.0], [1.6, 2.0]]
[phase.water]
density = 1000.0
[phase.water.equation-of-state.tait]
[phase.water.rheology.newtonian]
viscosity = "1 Pa s"
[body.water]
phase = "water"
box = [[0.0, 0.0], [0.6, 1.0]]
pressure = "hydrostatic"
[probe.p]
kind = "pressure"
at = [1.6, 0.1]
[zone.wall]
box = [[0.8, -0.1], [1.7, 0.7]]
probes = ["p"]
[zone.corner]
box = [[1.2, -0.1], [1.7, 0.4]]
ratio = 0.25
[output]
every = 0.4
vtk = false
"#;

/// A fluid that moves as a whole, from disorder, through a zone across its path.
const UNIFORM: &str = r#"
title = "A uniform flow through a zone"
dimension = 2
[run]
end = 1.0
[numerics]
spacing = 0.02
periodic = { x = [0.0, 1.0], y = [0.0, 0.3] }
jitter = 0.2
[smoother.brezzi-pitkaranta]
strength = 0.1
[phase.fluid]
density = 1000.0
speed_of_sound = 10.0
[phase.fluid.equation-of-state.tait]
[phase.fluid.rheology.newtonian]
viscosity = 0.01
[body.box]
phase = "fluid"
box = [[0.0, 0.0], [1.0, 0.3]]
velocity = [1.0, 0.0]
[zone.middle]
box = [[0.3, -1.0], [0.7, 1.0]]
[output]
every = 1.0
vtk = false
"#;

/// A column of a checkpoint.
fn column(bench: &Bench, file: &str, name: &str) -> Vec<f64> {
    let saved = Checkpoint::load(bench.path(file)).expect("a checkpoint");
    let found = saved.column(name).expect("a column");
    match &found.data {
        sph_io::ColumnData::F64(values) => values.clone(),
        other => panic!("{name} is {other:?}"),
    }
}

/// Every particle of the zone has come in and gone out two and a half times.
#[test]
fn a_uniform_flow_passes_a_zone_unchanged() {
    let bench = Bench::with(PROGRAM, UNIFORM);
    bench.done("run scene.toml --quiet --out out");
    for file in ["out/checkpoint.sph", "out/checkpoint-middle.sph"] {
        let velocity = column(&bench, file, "velocity");
        let off = velocity.chunks_exact(2).map(|u| (u[0] - 1.0).hypot(u[1]));
        let worst = off.fold(0.0, f64::max);
        // Fits of constants are exact: what is left comes from the order that forms in the band (measured 0.0019).
        assert!(worst < 5e-3, "{file}: {worst:e}");
    }
}

/// The mass of a zone with its band is that of the particles around that are there.
#[test]
fn mass_comes_into_a_zone_as_it_comes_into_its_box() {
    let bench = Bench::with(PROGRAM, DAM);
    bench.done("run scene.toml --quiet --out out");
    let coarse: f64 = column(&bench, "out/checkpoint.sph", "mass").iter().sum();
    let start = 0.6 * 1.0 * 1000.0;
    assert!((coarse / start - 1.0).abs() < 0.02, "{coarse} kg");
    let place = column(&bench, "out/checkpoint.sph", "position");
    let mass = column(&bench, "out/checkpoint.sph", "mass");
    // One and a half supports of the finer particles around the box.
    let band = 1.5 * 4.0 * 0.02;
    let inside = |x: &[f64]| x[0] >= 0.8 - band && x[1] < 0.7 + band;
    let pairs = place.chunks_exact(2).zip(&mass);
    let around: f64 = pairs.filter(|(x, _)| inside(x)).map(|(_, m)| m).sum();
    let zone: f64 = column(&bench, "out/checkpoint-wall.sph", "mass")
        .iter()
        .sum();
    assert!(around > 0.1 * start, "{around} kg came in");
    assert!(
        (zone / around - 1.0).abs() < 1e-12,
        "{zone} for {around} kg"
    );
}

#[test]
fn zones_have_the_same_bits_on_threads_and_after_an_interruption() {
    let bench = Bench::with(PROGRAM, DAM);
    bench.done("run scene.toml --quiet --out one --threads 1");
    bench.done("run scene.toml --quiet --out two --threads 2");
    let one = FinalState::read(&bench.path("one"));
    one.assert_same(&FinalState::read(&bench.path("two")), "threads");
    let parts = "run scene.toml --quiet --out parts";
    bench.call(&format!("{parts} --set run.max_steps=300"));
    bench.done(&format!("{parts} --resume --changed"));
    one.assert_same(&FinalState::read(&bench.path("parts")), "parts");
    for zone in ["checkpoint-wall.sph", "checkpoint-wall-corner.sph"] {
        let [a, b] = ["one", "parts"]
            .map(|folder| column(&bench, &format!("{folder}/{zone}"), "density_constant"));
        assert!(!a.is_empty() && a == b, "{zone}");
    }
}

/// A run refuses the scene, changed at one place, with these words.
fn refused(from: &str, to: &str, call: &str, words: &str) {
    assert!(DAM.contains(from), "{from}");
    let bench = Bench::with(PROGRAM, &DAM.replacen(from, to, 1));
    let told = bench.call(&format!("run scene.toml --quiet --out out {call}"));
    assert_eq!(told.code, Some(2), "{}", told.err);
    let said = told.err.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains(words), "{words}\n{said}");
    assert!(!bench.path("out/series.csv").exists(), "nothing is written");
}

#[test]
fn zones_that_do_not_fit_are_refused() {
    let ratio = "ratio = 0.25";
    refused(ratio, "ratio = 0.3", "", "the ratio is 0.5, 0.25 or 0.125");
    refused(
        ratio,
        "ratio = 0.125",
        "",
        "lies in a zone with the ratio 0.25",
    );
    refused(
        ratio,
        "",
        "",
        "overlaps the zone `corner` of the same ratio",
    );
    refused(
        "[1.7, 0.7]",
        "[0.7, 0.7]",
        "",
        "the lower corner must be below the upper",
    );
    refused(
        "[1.7, 0.4]",
        "[1.7, 0.69]",
        "",
        "reaches out of the zone `wall`",
    );
    refused(
        "probes = [\"p\"]",
        "probes = [\"q\"]",
        "",
        "no probe or gauge called `q`",
    );
    refused(ratio, ratio, "--ranks 2", "zones run in one process");
    let two = "[phase.air]\ndensity = 1.0\nspeed_of_sound = 20.0\nrheology.newtonian = { viscosity = 1e-3 }\n\
               [body.air]\nphase = \"air\"\nbox = [[0.7, 1.5], [1.0, 1.7]]\n[body.water]";
    refused("[body.water]", two, "", "zones are for one phase");
    let solved = "[implicit-viscosity.backward-euler]\n[body.water]";
    refused("[body.water]", solved, "", "solves for the end of a step");
    // Its scheme evaluates twice a step.
    let other = "[integrator.leap-frog]\n[body.water]";
    refused("[body.water]", other, "", "evaluates once a step");
}

//! Numbers that are made of a run afterwards.

use sph_tests::{below, bench};

/// Two fluids without gravity, 220 and 80 particles of 0.0025 m² (the row on the border is of the lower one), of which the
/// lower one moves along x.
const LAYERS: &str = include_str!("layers.toml");

#[test]
fn frames_are_reduced_over_phases_and_bounds() {
    let bench = bench!(LAYERS);
    bench.done("run scene.toml -q --threads 1 --out a");
    let rows = |keys: &str| -> Vec<f64> {
        let table = bench.done(&format!("measure a {keys}")).out;
        let last = table.lines().last().expect("a row");
        let numbers = last.split(',').map(|n| n.parse::<f64>().expect("a number"));
        numbers.skip(1).collect()
    };
    // Within 1 µs the lower fluid moves by 5·10⁻⁷ m.
    let near = |found: Vec<f64>, expected: &[f64]| {
        let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
        assert_eq!(found.len(), expected.len());
        below(off.fold(0.0, f64::max), 1e-5, "largest difference");
    };
    near(rows("y --reduce min,max"), &[0.0, 0.7]);
    near(rows("velocity.x --reduce mean"), &[0.5 * 220.0 / 300.0]);
    near(
        rows("velocity.x --reduce mean --weight mass"),
        &[0.5 * 220.0 / 260.0],
    );
    near(rows("y --reduce total --phase light"), &[80.0]);
    near(
        rows("y --reduce total --phase light --above x=500mm"),
        &[36.0],
    );
    near(
        rows("y --reduce share --phase heavy --below y=0.1"),
        &[2.0 / 11.0],
    );
    near(
        rows("y --quantile 0.5,1 --reduce max --phase heavy"),
        &[0.5, 0.25, 0.5],
    );
    // ½ m u² of particles of 2.5 kg, and −m g·r at a mean height of 0.25 m.
    near(rows("kinetic_energy --phase heavy"), &[0.3125]);
    near(
        rows("potential_energy --gravity 0,-10 --phase heavy"),
        &[6.25],
    );
    // Along x nothing changes; y itself is a line.
    near(
        rows("velocity.x --fit x --phase heavy"),
        &[0.5, 0.0, 0.0, 0.5],
    );
    near(rows("y --fit y --phase light"), &[0.625, 1.0, 0.0, 0.0]);
    bench.done("measure a y --out heights.csv");
    let written = bench.read("heights.csv");
    assert!(written.starts_with("time [s],mean [m]\n"), "{written}");
    let profile = bench
        .done("measure a velocity.x --reduce mean,total --along y --slice 210mm")
        .out;
    let head = "time [s],y [m],mean [m/s],total [1]\n";
    assert!(profile.starts_with(head), "{profile}");
    assert_eq!(profile.lines().count(), 1 + 4, "{profile}");
    // The last slice, of two rows of 20 particles at rest.
    near(
        rows("velocity.x --reduce mean,total --along y --slice 210mm"),
        &[0.735, 0.0, 40.0],
    );
}

#[test]
fn mistakes_are_named() {
    let bench = bench!(LAYERS);
    bench.done("run scene.toml -q --threads 1 --out a");
    for (keys, said) in [
        ("a presure", "no field `presure` was written"),
        ("a y --phase hevy", "did you mean `heavy`"),
        ("a y --above x", "expected FIELD=VALUE"),
        ("a y --above x=2kg", "--above x"),
        ("a y --reduce most", "possible values"),
        ("a y --quantile 2", "a share from 0 to 1"),
        ("a y --fit x --along x", "cannot be used with"),
        ("a y --slice 1mm", "--along"),
        ("a y --along x --slice 0", "a width above zero"),
        ("a potential_energy", "give --gravity X,Y[,Z]"),
        ("b y", "there is no fields.pvd in b"),
    ] {
        bench.refused(&format!("measure {keys}")).says(said);
    }
}

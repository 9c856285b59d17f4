//! A rigid slide under water and a wave over sand, in space, at sizes that take seconds.

use crate::shipped::{Finished, finished};

/// Rows of the series with their times: those within a window.
fn within(run: &Finished, names: &[&str], from: f64, to: f64) -> Vec<Vec<f64>> {
    let series = run.series();
    let column = |name: &str| {
        let column = series.column(name);
        column.unwrap_or_else(|| panic!("no {name}")).to_vec()
    };
    let time = column("time");
    let inside: Vec<usize> = (0..time.len())
        .filter(|k| (from..=to).contains(&time[*k]))
        .collect();
    let of = |name: &&str| {
        let all = column(name);
        inside.iter().map(|k| all[*k]).collect()
    };
    names.iter().map(of).collect()
}

/// Half of a hump that starts down a plane of 15° with 1.12 m/s². Along the plane, where its flat bottom bears nothing, the water pushes
/// with the weight that it displaces and with the inertia of what it takes along, F = −ρV (g sin θ + C a). C is 0.32 for an
/// ellipsoid of its length, width and thickness (Lamb 1932, §114), and 0.42 for a cylinder of such a section across its way.
#[test]
fn the_water_holds_a_rigid_slide_with_its_buoyancy_and_0_34_of_its_inertia() {
    let run = finished("rigid-slide-3d", &["numerics.spacing=0.08", "run.end=0.6"]);
    // Volume of the half hump in the file, and ρ.
    let (volume, density) = (0.003_777_f64, 1000.0);
    let (sine, cosine) = 15.0_f64.to_radians().sin_cos();
    // Until then the sound of the start goes up and down, 4 × 1.02 m at 20 m/s.
    let rows = within(&run, &["time", "slide.x", "slide.z"], 0.25, 0.6);
    let mut sum = 0.0;
    for (k, t) in rows[0].iter().enumerate() {
        let force = rows[1][k] * cosine - rows[2][k] * sine;
        // The slide's law of motion, s = 2.58 m ln cosh(t/1.518 s).
        let acceleration = 2.58 / 1.518_f64.powi(2) / (t / 1.518).cosh().powi(2);
        sum += (-force / (density * volume) - 9.81 * sine) / acceleration;
    }
    let added = sum / rows[0].len() as f64;
    println!("added mass {added} of the water displaced");
    // The slide is 0.395 m long, which is known to half a spacing at either end.
    let spacing = 0.08 / 0.395;
    assert!(
        (added - 0.32).abs() < spacing,
        "an added mass of {added}, 0.34 was measured, an ellipsoid has 0.32"
    );
}

/// A solitary wave of 0.1231 m over 0.315 m of water passes x = −2.5 m with √(g(h + A)), 0.352 s after its start, 0.438 m high, while
/// the sand, 2 m farther, lies still.
#[test]
fn the_wave_before_a_scour_has_its_celerity_and_height_and_the_sand_waits() {
    let spacing = 0.035;
    let run = finished(
        "tsunami-scour-nakamura-3d",
        &[
            "numerics.spacing=0.035",
            "body.water.wave.bottom=0.0175",
            "phase.sand.rheology.drucker-prager.young_modulus=\"2.6 MPa\"",
            "run.end=0.45",
            "output.times=[0.45]",
            "output.picture=[]",
        ],
    );
    let rows = within(&run, &["time", "offshore"], 0.0, 0.45);
    let (time, level) = (&rows[0], &rows[1]);
    let highest = level.iter().copied().fold(0.0, f64::max);
    // The middle of the times at which the level is within a tenth of the wave's height of its highest.
    let near: Vec<f64> = time
        .iter()
        .zip(level)
        .filter(|(_, y)| **y > highest - 0.1 * 0.1231)
        .map(|(t, _)| *t)
        .collect();
    let passes = 0.5 * (near[0] + near[near.len() - 1]);
    let bed = &within(&run, &["scour.deepest", "scour.highest"], 0.0, 0.45);
    let change = |values: &[f64]| {
        let most = values.iter().copied().fold(f64::MIN, f64::max);
        most - values[0]
    };
    let (deepest, risen) = (change(&bed[0]), change(&bed[1]));
    println!("{highest} m high after {passes} s; sand {deepest} m deep, {risen} m risen");
    // A surface is known to half a spacing, and so is a crest to what a wave of 2.07 m/s takes for a spacing.
    assert!(
        (highest - 0.438).abs() < 0.5 * spacing,
        "{highest} m for 0.438 m, 0.4457 was measured"
    );
    assert!(
        (passes - 0.352).abs() < spacing / 2.07,
        "{passes} s for 0.352 s, 0.3606 was measured"
    );
    assert!(
        deepest < 0.5 * spacing && risen < 0.5 * spacing,
        "sand {deepest} m deep and {risen} m risen before the wave has come, 0.0051 and 0.0009 were measured"
    );
}

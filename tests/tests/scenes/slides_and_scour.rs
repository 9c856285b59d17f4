//! A wave over sand, in space, at a size that takes seconds.

use crate::shipped::{Finished, finished};
use sph_tests::close;

/// Rows of the series with their times: those within a window.
fn within(run: &Finished, names: &[&str], from: f64, to: f64) -> Vec<Vec<f64>> {
    let series = run.series();
    let time = series.column("time");
    let inside: Vec<usize> = (0..time.len())
        .filter(|k| (from..=to).contains(&time[*k]))
        .collect();
    let of = |name: &&str| {
        let all = series.column(name);
        inside.iter().map(|k| all[*k]).collect()
    };
    names.iter().map(of).collect()
}

/// A solitary wave of 0.1231 m over 0.315 m of water passes x = −2.5 m with √(g(h + A)), 0.352 s after its start, 0.438 m high, while
/// the sand, 2 m farther, lies still.
#[test]
fn the_wave_before_a_scour_has_its_celerity_and_height_and_the_sand_waits() {
    let spacing = 0.035;
    let run = finished(
        "tsunami-scour-nakamura-3d",
        &["numerics.spacing=0.035 body.water.wave.bottom=0.0175 \
             phase.sand.rheology.drucker-prager.young_modulus=2.6e6 run.end=0.45 \
             output.times=[0.45] output.picture=[]"],
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
    close(highest, 0.438, 0.5 * spacing, "m, measured 0.4457");
    close(passes, 0.352, spacing / 2.07, "s, measured 0.3606");
    let moved = deepest.max(risen);
    assert!(moved < 0.5 * spacing, "{moved} m, measured 0.0051");
}

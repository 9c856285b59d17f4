//! Floors that follow levels from a table.

use sph_tests::{CHECK_AND_RUN, bench, close};

/// Syrup at rest, 0.2 m long and 0.1 m deep, whose floor tilts by 16 mm in a second.
const SCENE: &str = include_str!("levels.toml");

/// Levels at the start of the run are 1 m: only what they change counts.
const LEVELS: &str =
    "time,left,right\n1,0.9,1.3\n2,1,1\n2.5,0.996,1.004\n3,0.992,1.008\n9,0.992,1.008\n";

#[test]
fn a_floor_follows_its_table_and_the_water_the_floor() {
    let bench = bench!(SCENE);
    bench.write("levels.csv", LEVELS);
    bench.done("run scene.toml --quiet --threads 1 --out r");
    bench.done("run scene.toml --quiet --threads 2 --out again");
    let series = bench.read("r/series.csv");
    assert_eq!(series, bench.read("again/series.csv"));
    let series = bench.series("r");
    let difference = series.last("left") - series.last("right");
    // ρ g 16 mm, and a tenth of a spacing of water for the particles, whose surface is known no better.
    let (wanted, bound) = (1000.0 * 9.81 * 0.016, 1000.0 * 9.81 * 0.001);
    close(difference, wanted, bound, "Pa between the corners");
}

#[test]
fn tables_that_do_not_fit_are_told_with_the_nearest_name() {
    let bench = bench!();
    bench.write("levels.csv", LEVELS);
    let changes = include_str!("levels.refused");
    bench.refuses("scene.toml", &CHECK_AND_RUN, SCENE, changes);
}

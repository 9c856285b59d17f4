//! Still water between two faces that hold its level.

use super::*;

/// Sixteen rows of water.
const TANK: &str = include_str!("still-water.toml");

/// The faces stir the water a little. What they do is less than what water gains that falls by one row, √(2gδr).
#[test]
fn still_water_between_two_levels_stays_below_the_speed_of_a_fall_by_a_row() {
    let run = finished(TANK, 1);
    let largest = |name, zero: f64| {
        let all = run.column(name).into_iter();
        all.map(|x| (x - zero).abs()).fold(0.0, f64::max)
    };
    let (fastest, off) = (largest("largest_speed", 0.0), largest("middle", 0.5));
    println!("{fastest} m/s at most, the level {off} m off");
    let (row, fall) = (0.03125, (2.0 * 9.81 * 0.03125_f64).sqrt());
    assert!(fastest < fall, "{fastest} m/s, {fall} m/s at most");
    assert!(off < row, "the level is {off} m off, a row is {row} m");
}

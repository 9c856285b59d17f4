//! Still water between two faces that hold its level.

use super::*;

/// Sixteen rows of water.
const TANK: &str = r#"
title = "still water"
dimension = 2
[run]
end = 8.0
[numerics]
spacing = 0.03125
gravity = [0.0, -9.81]
relax = { steps = 400, tolerance = 0.001 }
[kernel.wendland-c2]
[formulation.hu-adams]
[integrator.symplectic-euler]
[viscous-operator.monaghan-gingold]
[smoother.brezzi-pitkaranta]
[walls.usaw]
vertices = false
[wall.left]
polyline = [[0.0, 0.75], [0.0, 0.0]]
open-boundary.level = { level = 0.5 }
[wall.floor]
polyline = [[0.0, 0.0], [2.0, 0.0]]
condition = "free-slip"
[wall.right]
polyline = [[2.0, 0.0], [2.0, 0.75]]
open-boundary.level = { level = 0.5 }
[phase.water]
density = 1000.0
speed_of_sound = 16.0
rheology.newtonian = { viscosity = "1e-3 Pa s" }
[body.water]
phase = "water"
box = [[0.0, 0.0], [2.0, 0.5]]
pressure = "hydrostatic"
[gauge.middle]
kind = "level"
at = [1.0]
[output]
every = 8.0
series_every = 0.1
vtk = false
"#;

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

//! Walls that move faster than sound.

use sph_boundary::{Drawing, WallSpec};
use sph_core::SceneProblem;

/// Times at which the motion of walls is looked at.
const SAMPLES: usize = 1000;

/// Walls of which a corner is faster than `sound`, m/s, against the slowest wall at some time before `end`, s.
///
/// A vessel whose walls all move together carries its fluid along and may be of any speed.
pub fn too_fast<const D: usize>(walls: &[WallSpec<D>], sound: f64, end: f64) -> Vec<SceneProblem> {
    if !walls.iter().any(|w| w.motion.moves()) {
        return Vec::new();
    }
    let times = (0..SAMPLES).map(|n| end * (n as f64 + 0.5) / SAMPLES as f64);
    let mut fastest = vec![0.0_f64; walls.len()];
    for time in times {
        let speeds: Vec<f64> = walls.iter().map(|wall| speed(wall, time)).collect();
        let slowest = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let against = fastest.iter_mut().zip(&speeds);
        against.for_each(|(most, speed)| *most = most.max(known(speed - slowest)));
    }
    let loud = walls.iter().zip(&fastest).filter(|(_, v)| **v >= sound);
    loud.map(|(wall, v)| {
        SceneProblem::new(
            format!("wall.{}.motion", wall.drawing.name()),
            format!(
                "the wall moves with {v:.3} m/s, faster than sound in the slowest phase, {sound:.3} m/s: what is \
                 before it would be pressed together; slow it down, or raise `speed_of_sound`"
            ),
        )
    })
    .collect()
}

/// A speed that cannot be told is too fast for any sound.
fn known(speed: f64) -> f64 {
    if speed.is_nan() { f64::INFINITY } else { speed }
}

/// Largest speed of the corners of a wall, m/s.
fn speed<const D: usize>(wall: &WallSpec<D>, time: f64) -> f64 {
    if !wall.motion.moves() {
        return 0.0;
    }
    let pose = wall.motion.pose(time);
    let at = |corner: [f64; D]| {
        wall.motion
            .movement(pose.map()(corner), time)
            .velocity
            .norm()
    };
    let point = |p: &[f64]| at(std::array::from_fn(|k| p[k]));
    let largest = |speeds: &mut dyn Iterator<Item = f64>| speeds.map(known).fold(0.0, f64::max);
    match &wall.drawing {
        Drawing::Line(line) => largest(&mut line.points.iter().map(|p| point(p))),
        Drawing::Surface(surface) => largest(&mut surface.points.iter().map(|p| point(p))),
    }
}

//! Walls that move faster than sound.

use sph_boundary::{Drawing, WallSpec};
use sph_core::SceneProblem;

/// Times at which the motion of a wall is looked at.
const SAMPLES: usize = 500;

/// Walls of which a corner is faster than `sound`, m/s, at some time before `end`, s.
pub fn too_fast<const D: usize>(walls: &[WallSpec<D>], sound: f64, end: f64) -> Vec<SceneProblem> {
    let mut problems: Vec<SceneProblem> = Vec::new();
    for wall in walls.iter().filter(|w| w.motion.moves()) {
        let corners: Vec<[f64; D]> = match &wall.drawing {
            Drawing::Line(line) => line
                .points
                .iter()
                .map(|p| std::array::from_fn(|k| p[k]))
                .collect(),
            Drawing::Surface(surface) => {
                let points = surface.points.iter();
                points.map(|p| std::array::from_fn(|k| p[k])).collect()
            }
        };
        let motion = &wall.motion;
        let last = motion.stop.min(end);
        let times = (0..SAMPLES)
            .map(|n| motion.start + (last - motion.start) * (n as f64 + 0.5) / SAMPLES as f64);
        let at = |time: f64| {
            let pose = motion.pose(time);
            let speed = |corner: &[f64; D]| {
                let place = pose.map()(*corner);
                motion.movement(place, time).velocity.norm()
            };
            corners.iter().map(speed).fold(0.0, f64::max)
        };
        let fastest = times.map(at).fold(0.0, f64::max);
        if fastest >= sound {
            let name = wall.drawing.name();
            problems.push(SceneProblem::new(
                format!("wall.{name}.motion"),
                format!(
                    "the wall moves with {fastest:.3} m/s, faster than sound in the slowest phase, {sound:.3} m/s: what is \
                     before it would be pressed together; slow it down, or raise `speed_of_sound`"
                ),
            ));
        }
    }
    problems
}

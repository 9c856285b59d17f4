//! Walls that move faster than sound, or vessels that press their fluid together.

use sph_boundary::WallSpec;
use sph_core::{SceneProblem, number};
use sph_rheology::state::Laws;
use sph_scene::Scene;
use sph_solver::SolverError;

use crate::setup::shapes::Drawn;
use crate::setup::sound::slowest_sound;

/// Times at which the motion of walls is sampled.
const SAMPLES: usize = 1000;
/// The change Δv of a vessel's speed within the time L/c that sound takes through its fluid counts by Δv/c, the share
/// of its density by which the fluid is pressed together: aL/c² of a lasting acceleration a. From the first on it is
/// remarked upon, from the second on refused.
const PRESSED: [f64; 2] = [0.1, 0.5];
/// From this share of the speed of sound on the speed of a wall against others is remarked upon.
const FAST: f64 = 0.3;
/// Changes of the speed of a vessel count by the speed of sound: as before.
const SPEEDS: [f64; 2] = [1.0, 10.0];

/// Remarks on the speeds of the walls before the end of the run.
///
/// # Errors
/// A wall of which a corner is faster than sound against the slowest wall at some time. A vessel whose walls all move
/// together carries its fluid along and may be of any speed; the effect of its acceleration on the fluid may not.
pub fn remarks<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    laws: &Laws,
) -> Result<Vec<String>, SolverError> {
    let walls = &drawn.walls[..];
    let (mut refused, mut remarks) = (Vec::new(), Vec::new());
    if !walls.iter().any(|w| w.motion.moves()) {
        return Ok(remarks);
    }
    let sound = slowest_sound(laws);
    let bodies = drawn.regions.iter().map(|region| region.base.bounds());
    let extents = bodies.flat_map(|(low, high)| (0..D).map(move |k| high[k] - low[k]));
    let length = extents.fold(0.0, f64::max);
    let (end, crossing) = (scene.run.end, length / sound);
    let times = (0..SAMPLES).map(|n| end * (n as f64 + 0.5) / SAMPLES as f64);
    let jumps = walls.iter().flat_map(|w| w.motion.steepest());
    let times = times.chain(jumps.filter(|t| *t < end));
    let mut fastest = vec![(0.0_f64, 0.0); walls.len()];
    let [mut pressed, mut changed] = [(0.0_f64, 0.0); 2];
    let begin: Vec<f64> = walls.iter().map(|w| moving(w, 0.0, 0.0).speed).collect();
    for time in times {
        let all: Vec<WallSpeed> = walls.iter().map(|w| moving(w, time, crossing)).collect();
        let least =
            |of: &dyn Fn(usize) -> f64| (0..all.len()).map(of).fold(f64::INFINITY, f64::min);
        let larger = |most: &mut (f64, f64), x: f64| {
            if x > most.0 {
                *most = (x, time);
            }
        };
        let slowest = least(&|k| all[k].speed);
        let against = fastest.iter_mut().zip(&all);
        against.for_each(|(most, m)| larger(most, known(m.speed - slowest)));
        larger(&mut pressed, least(&|k| all[k].change) / sound);
        let since = least(&|k| (all[k].speed - begin[k]).abs());
        larger(&mut changed, since / sound);
    }
    let fast = walls.iter().zip(fastest);
    for (wall, (v, time)) in fast.filter(|(_, (v, _))| *v >= FAST * sound) {
        let (path, place) = told_at(scene, std::slice::from_ref(wall), time);
        let at = format!("{} s{place}", number::plain(time));
        if v >= sound {
            let message = format!(
                "the wall moves with {v:.3} m/s, faster than sound in the slowest phase, {sound:.3} m/s, at {at}: what \
                 is before it would be pressed together; slow it down, or raise `speed_of_sound`"
            );
            refused.push(SceneProblem::new(path, message));
        } else {
            let (name, share) = (wall.drawing.name(), number::percent(v / sound));
            let v = number::plain(v);
            remarks.push(format!(
                "wall `{name}` moves with {v} m/s at {at}, {share} of the speed of sound: what is before it is pressed \
                 together"
            ));
        }
    }
    SolverError::refuse(refused)?;
    remarks.extend(vessel(scene, walls, (sound, length), [pressed, changed])?);
    Ok(remarks)
}

/// Judges the largest pressing and change of speed of a vessel, each with its time.
fn vessel<const D: usize>(
    scene: &Scene,
    walls: &[WallSpec<D>],
    (sound, length): (f64, f64),
    [pressed, changed]: [(f64, f64); 2],
) -> Result<Option<String>, SolverError> {
    let acceleration = number::plain(pressed.0 * sound * sound / length);
    let share = number::percent(pressed.0);
    let acceleration = format!(
        "is accelerated with {acceleration} m/s², which presses its fluid together by {share}"
    );
    let change = number::plain(changed.0 * sound);
    let change = format!("changes its speed by {change} m/s");
    let told = [(pressed, PRESSED, acceleration), (changed, SPEEDS, change)].into_iter();
    let said = told.filter(|((x, _), [least, _], _)| x >= least);
    let worst = said.max_by(|a, b| (a.0.0 / a.1[1]).total_cmp(&(b.0.0 / b.1[1])));
    let Some(((x, time), [_, most], what)) = worst else {
        return Ok(None);
    };
    let (path, place) = told_at(scene, walls, time);
    let sound = number::plain(sound);
    let message = format!(
        "the vessel {what}, at {} s{place}, where the speed of sound is {sound} m/s: is the unit of its course right \
         (`unit = \"mm\"`)? else raise `speed_of_sound`",
        number::plain(time)
    );
    match x >= most {
        true => Err(SolverError::at(path, message)),
        false => Ok(Some(message)),
    }
}

/// The key of the course of the first wall that moves, and the line of its file, if it has one, at a time.
fn told_at<const D: usize>(scene: &Scene, walls: &[WallSpec<D>], time: f64) -> (String, String) {
    let moving = walls.iter().find(|w| w.motion.moves());
    let name = moving.map_or("", |w| w.drawing.name());
    let place = format!("wall.{name}.motion");
    let motion = scene.wall.get(name).and_then(|w| w.motion.as_ref());
    match motion.and_then(|m| m.told_at(&place, time)) {
        Some((key, Some(file))) => (key, format!(" ({file})")),
        Some((key, None)) => (key, String::new()),
        None => (place, String::new()),
    }
}

/// A number that overflows is refused.
fn known(x: f64) -> f64 {
    if x.is_nan() { f64::INFINITY } else { x }
}

/// Largest speed of the corners of a wall, and how much their velocities have changed since a time before, m/s.
#[derive(Default)]
struct WallSpeed {
    speed: f64,
    change: f64,
}

fn moving<const D: usize>(wall: &WallSpec<D>, time: f64, since: f64) -> WallSpeed {
    let mut most = WallSpeed::default();
    if !wall.motion.moves() {
        return most;
    }
    let before = (time - since).max(0.0);
    let [now, then] = [time, before].map(|t| (wall.motion.pose(t).map(), t));
    for corner in wall.drawing.points() {
        let [now, then] =
            [&now, &then].map(|(map, t)| wall.motion.movement(map(corner), *t).velocity);
        most.speed = most.speed.max(known(now.norm()));
        most.change = most.change.max(known((now - then).norm()));
    }
    most
}

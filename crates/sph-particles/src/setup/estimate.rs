//! Estimate of the cost of a scene.

use std::collections::BTreeMap;

use serde::Serialize;
use sph_core::StepLimit;
use sph_scene::{Scene, estimate};
use sph_solver::{SolverError, defaults};

use crate::setup::shapes::Drawn;

/// Bytes per particle of columns, lists and buffers together, before a scene is assembled: that of water in the usual
/// support. The memory of an assembled one is in [`Memory`](crate::setup::Memory).
const BYTES_PER_PARTICLE: [f64; 2] = [1000.0, 3500.0];
/// Bytes per neighbour, where lists outweigh the columns: four with the skin, four without, and a sixteenth to spare.
const BYTES_PER_NEIGHBOUR: f64 = 8.5;
/// Bytes per particle in one compressed output.
const BYTES_PER_OUTPUT: f64 = 60.0;

/// Size of a run and number of its steps.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Estimate {
    /// Free particles.
    pub particles: f64,
    /// Steps at the initial time step.
    pub steps: f64,
    /// Memory, bytes.
    pub memory_bytes: f64,
    /// Disk, bytes.
    pub disk_bytes: f64,
}

impl Estimate {
    /// From the particle count, the first step, s, and the memory of the run, bytes.
    pub fn new(scene: &Scene, particles: f64, dt: f64, memory: f64) -> Self {
        let steps = (scene.run.end / dt).ceil();
        let outputs = match (&scene.output.times, scene.output.every) {
            (Some(times), _) => times.len() as f64,
            (None, Some(every)) => (scene.run.end / every).floor() + 1.0,
            (None, None) => 2.0,
        };
        let vtk = if scene.output.vtk {
            BYTES_PER_OUTPUT * particles
        } else {
            0.0
        };
        let pictures = 3e5 * scene.output.picture.len() as f64;
        let checkpoint = 80.0 * particles;
        Estimate {
            particles,
            steps,
            memory_bytes: memory,
            disk_bytes: outputs * (vtk + pictures) + 2.0 * checkpoint,
        }
    }
}

/// A step below which a run is not worth starting without a thought, s.
const TINY: f64 = 1e-8;
/// Steps from which on a remedy is worth a word before the run.
const MANY: f64 = 1e6;

/// Names the bound that makes steps short, and its remedy where its plugin has one.
///
/// # Errors
/// If steps are so short that time would stand still.
pub fn short_steps(
    scene: &Scene,
    limits: &[StepLimit],
    remedies: &BTreeMap<String, String>,
) -> Result<Option<String>, SolverError> {
    let Some(least) = StepLimit::least(limits) else {
        return Ok(None);
    };
    let dt = least.dt * scene.run.safety;
    let end = scene.run.end;
    let known = remedies.get(least.name);
    let remedy = known.map_or("lower the stiffness or the speed behind it", String::as_str);
    let bounds = format!("`{}` bounds the first step to {dt:.1e} s", least.name);
    if end + dt == end {
        return Err(SolverError::at(
            "run.end",
            format!(
                "{bounds}, which is lost in t = {end} s to rounding: the time would not advance; {remedy}, or check \
                 `run.safety`"
            ),
        ));
    }
    let steps = end / dt;
    let told = dt < TINY || (steps > MANY && known.is_some());
    Ok(told.then(|| format!("{bounds}: {steps:.1e} steps to t = {end} s; {remedy}")))
}

/// Memory this machine has left, bytes, where the system gives it.
fn memory_available() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|l| l.starts_with("MemAvailable:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// Size of a scene, known before memory is touched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// About how many free particles, counted in the boxes around the bodies.
    pub particles: f64,
    /// About how many wall points.
    pub wall_points: f64,
    /// Memory for both, bytes.
    pub bytes: f64,
}

/// Neighbours of a particle in the list, for a kernel that reaches two smoothing lengths.
fn neighbours<const D: usize>(scene: &Scene) -> f64 {
    let numerics = &scene.numerics;
    let skin = numerics.skin.unwrap_or(defaults::SKIN);
    let reach = 2.0 * numerics.smoothing_ratio * (1.0 + skin);
    match D {
        3 => 4.0 / 3.0 * std::f64::consts::PI * reach.powi(3),
        _ => std::f64::consts::PI * reach.powi(2),
    }
}

impl Size {
    fn from_scene<const D: usize>(scene: &Scene, drawn: &Drawn<D>) -> Self {
        let spacing = scene.numerics.spacing;
        let particles = estimate(&drawn.regions, spacing);
        let wall_points = drawn.measure / spacing.powi(D as i32 - 1);
        let all = particles + wall_points;
        let listed = neighbours::<D>(scene).min(all) * BYTES_PER_NEIGHBOUR;
        let bytes = all * BYTES_PER_PARTICLE[usize::from(D == 3)].max(listed);
        Size {
            particles,
            wall_points,
            bytes,
        }
    }
}

/// Size of a scene; its walls are drawn for it, and files of walls are read.
///
/// # Errors
/// If a wall or a body cannot be drawn.
pub fn size(scene: &Scene) -> Result<Size, SolverError> {
    Ok(match scene.dimension {
        3 => Size::from_scene(scene, &Drawn::<3>::from_scene(scene)?),
        _ => Size::from_scene(scene, &Drawn::<2>::from_scene(scene)?),
    })
}

/// Refuses a scene that cannot fit into memory, before any memory is touched.
pub fn refuse_the_absurd<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
) -> Result<(), SolverError> {
    let Size {
        particles,
        wall_points: points,
        bytes: needed,
    } = Size::from_scene(scene, drawn);
    let limit = memory_available().unwrap_or(64e9);
    // Indices are 32 bits wide.
    if needed < limit && particles + points < 4e9 {
        return Ok(());
    }
    let usual = BYTES_PER_PARTICLE[usize::from(D == 3)];
    let advice = match points > particles {
        _ if needed > 1.5 * usual * (particles + points) => {
            "take a smaller `smoothing_ratio`, or a smaller `skin`"
        }
        true => "take a larger spacing, or are the walls drawn in another unit, such as \"mm\"?",
        false => "take a larger spacing or smaller bodies",
    };
    Err(SolverError::at(
        "numerics.spacing",
        format!(
            "about {particles:.1e} particles and {points:.1e} wall points would need {:.1e} GB of \
             memory, and {:.1} GB are free: {advice}",
            needed / 1e9,
            limit / 1e9
        ),
    ))
}

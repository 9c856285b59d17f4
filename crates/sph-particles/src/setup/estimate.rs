//! Estimate of the cost of a scene, and of the largest memory of a run, counted from that of the assembled flow.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use sph_core::{FieldError, Plain, Role, StepLimit};
use sph_neighbours::{Clusters, World};
use sph_scene::{Scene, estimate};
use sph_solver::{Flow, SolverError};

use crate::setup::initial_world::SKIN;
use crate::setup::shapes::Drawn;

/// Bytes per particle of columns, lists and buffers together, before a scene is assembled: that of water in the usual
/// support. The memory of an assembled one is in [`Memory`].
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
        let output = &scene.output;
        let outputs = match (&output.times, output.every) {
            (Some(times), _) => times.len() as f64,
            (None, Some(every)) => (scene.run.end / every).floor() + 1.0,
            (None, None) => 2.0,
        };
        let frame = BYTES_PER_OUTPUT * particles;
        let vtk = if output.vtk { frame } else { 0.0 };
        let pictures = 3e5 * output.picture.len() as f64;
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
        let why = format!(
            "{bounds}, which is lost in t = {end} s to rounding: the time would not advance; {remedy}, or check \
             `run.safety`"
        );
        return Err(SolverError::at("run.end", why));
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

impl Size {
    fn from_scene<const D: usize>(scene: &Scene, drawn: &Drawn<D>) -> Self {
        let spacing = scene.numerics.spacing;
        let particles = estimate(&drawn.regions, spacing);
        let wall_points = drawn.measure / spacing.powi(D as i32 - 1);
        let all = particles + wall_points;
        let skin = scene.numerics.skin.unwrap_or(SKIN);
        // Neighbours in the list, for a kernel that reaches two smoothing lengths.
        let reach = 2.0 * scene.numerics.smoothing_ratio * (1.0 + skin);
        let neighbours = match D {
            3 => 4.0 / 3.0 * std::f64::consts::PI * reach.powi(3),
            _ => std::f64::consts::PI * reach.powi(2),
        };
        let listed = neighbours.min(all) * BYTES_PER_NEIGHBOUR;
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
    let size = Size::from_scene(scene, drawn);
    let (particles, points, needed) = (size.particles, size.wall_points, size.bytes);
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
    let why = format!(
        "about {particles:.1e} particles and {points:.1e} wall points would need {:.1e} GB of \
         memory, and {:.1} GB are free: {advice}",
        needed / 1e9,
        limit / 1e9
    );
    Err(SolverError::at("numerics.spacing", why))
}

/// Room that lists keep free for longer rows: they are cut to a sixteenth more than they need.
const SPARE: f64 = 17.0 / 16.0;
/// Excess of vectors that grow by doubling over their contents, in the mean.
const GROWN: f64 = 1.5;
/// Bytes of an element's corners, planes and edges, and of the grids in which elements are looked for, in the plane and in
/// space: calibrated with the counts of an allocator.
const TABLES_PER_ELEMENT: [f64; 2] = [550.0, 350.0];
/// Bytes of the list of elements near a particle per contact: with the skin they are some three times as many.
const NEAR_A_CONTACT: f64 = 32.0;
/// Pixels of a picture, a little more than those of a plot, 1200 · 800.
const PIXELS: f64 = 1200.0 * 850.0;
/// Bytes of a pixel for a surface in space: depth and value, twice while they are made smooth, within the frame, which has
/// some three quarters of the pixels.
const BYTES_OF_RELIEF: f64 = 0.75 * 32.0;
/// Bytes of a pixel while a picture is drawn and encoded: once each.
const BYTES_PER_PIXEL: f64 = 8.0;
/// Memory that solves keep over the matrix.
const SHARES: f64 = 2.0 + 2.0 * 2.0 / 3.0;
/// Bytes of a place of a particle for pictures and files: three coordinates and a value.
const BYTES_PER_PLACE: f64 = 32.0;

/// Memory of a run by its owners, bytes. The program itself and the fill-in of a Cholesky factorisation are not in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Columns of the particles.
    pub columns: f64,
    /// Neighbour lists, with skin and without.
    pub lists: f64,
    /// The state to fall back on, and the source of neighbours.
    pub copies: f64,
    /// Points, elements and contacts.
    pub walls: f64,
    /// Matrices of implicit steps, the rows they are put together from, and vectors of their solvers.
    pub solves: f64,
    /// Pictures, plots and files while they are written.
    pub output: f64,
}

impl Memory {
    /// All of it, bytes.
    pub fn total(&self) -> f64 {
        self.columns + self.lists + self.copies + self.walls + self.solves + self.output
    }

    /// Name and bytes of every part.
    pub fn parts(&self) -> [(&'static str, f64); 6] {
        [
            ("columns", self.columns),
            ("lists", self.lists),
            ("copies", self.copies),
            ("walls", self.walls),
            ("solves", self.solves),
            ("output", self.output),
        ]
    }

    /// Of a flow whose implicit solves take `system` bytes for their matrices with their vectors.
    ///
    /// # Errors
    /// If there is no position column.
    pub fn estimate<const D: usize>(
        scene: &Scene,
        flow: &Flow<D>,
        system: f64,
    ) -> Result<Self, FieldError> {
        let world = &flow.world;
        let particles = world.free.len() as f64;
        Ok(Memory {
            columns: particles * world.free.bytes_per_particle() as f64,
            lists: lists(world),
            copies: particles * copies(scene, world),
            walls: walls(world),
            // Rows as they are put together, the matrix that they are joined to, its halves and incomplete factors, which
            // are kept in both precisions: these take two thirds of it each.
            solves: SHARES * system,
            output: output(scene, particles),
        })
    }
}

fn list(each: &Clusters) -> f64 {
    size_of::<u32>() as f64 * (SPARE * each.entries() as f64 + each.len() as f64)
}

fn clusters(all: &Clusters) -> f64 {
    // Two bytes of a particle say which cluster is its own, and where that begins.
    size_of::<u32>() as f64 * SPARE * all.entries() as f64 + 2.0 * all.len() as f64
}

fn lists<const D: usize>(world: &World<D>) -> f64 {
    let lists = &world.lists;
    let free = clusters(&lists.free);
    let pruned = match &lists.pruned {
        Some(pruned) => clusters(pruned),
        // The best estimate before the first step: they are not longer than those with the skin.
        None => free,
    };
    let others = clusters(&lists.of_points) + clusters(&lists.of_elements) + list(&lists.wall);
    let places = lists.reference.len() + lists.reference_points.len();
    free + pruned + others + (8 * D * places) as f64
}

/// Bytes of one particle in copies.
fn copies<const D: usize>(scene: &Scene, world: &World<D>) -> f64 {
    if scene.run.retries == 0 {
        return 0.0;
    }
    let columns = world.free.columns();
    let state = columns.filter(|(_, _, role, ..)| *role == Role::State);
    let kept: usize = state.map(|(.., n, values)| bytes(n, &values)).sum();
    kept as f64
}

/// Bytes of a particle in a column of `components` numbers each.
pub fn bytes(components: usize, values: &Plain<'_>) -> usize {
    match values {
        Plain::Real(_) => 8 * components,
        Plain::Index(_) => 4,
    }
}

fn walls<const D: usize>(world: &World<D>) -> f64 {
    let walls = &world.walls;
    let contacts = walls.contacts.all().count() as f64;
    // Points: position, two velocities, four numbers and the wall; elements: centre, normal, velocity, four numbers, the
    // wall and its corners.
    let point = (3 * 8 * D + 4 * 8 + 4) as f64;
    let element = (3 * 8 * D + 4 * 8 + 4 + 4 * D) as f64 + TABLES_PER_ELEMENT[D - 2];
    // Where the elements of a particle are listed: place, motion and range, twice so that they can follow a sorted particle,
    // and whose they are.
    let listed = (2.0 * (8 * D + 16) as f64 + 4.0) * world.free.len() as f64;
    let places = if contacts > 0.0 { listed } else { 0.0 };
    walls.points.position.len() as f64 * point
        + walls.elements.centre.len() as f64 * element
        + contacts * NEAR_A_CONTACT
        + GROWN * walls.contacts.bytes() as f64
        + places
}

fn output(scene: &Scene, particles: f64) -> f64 {
    let draws = !scene.output.picture.is_empty() || !scene.reference.is_empty();
    let relief = scene.dimension == 3 && !scene.output.picture.is_empty();
    let per_pixel = BYTES_PER_PIXEL + if relief { BYTES_OF_RELIEF } else { 0.0 };
    let pictures = if draws { per_pixel * PIXELS } else { 0.0 };
    let fields = scene.output.vtk || !scene.output.picture.is_empty();
    let places = BYTES_PER_PLACE * particles;
    pictures + if fields { places } else { 0.0 }
}

//! Largest memory of a run, counted from that of the assembled flow.

use serde::{Deserialize, Serialize};
use sph_core::{FieldError, Role};
use sph_neighbours::{Clusters, NeighbourList, World};
use sph_scene::Scene;
use sph_solver::Flow;

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

fn list(list: &NeighbourList) -> f64 {
    let rows = 0..list.len();
    let entries: usize = rows.map(|i| list.row(i).len()).sum();
    size_of::<u32>() as f64 * (SPARE * entries as f64 + list.len() as f64)
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
    let state = world
        .free
        .columns()
        .filter(|(_, _, role, ..)| *role == Role::State);
    let state: usize = state
        .map(|(_, _, _, components, values)| match values {
            sph_core::Plain::Real(_) => 8 * components,
            sph_core::Plain::Index(_) => 4,
        })
        .sum();
    let kept = if scene.run.retries > 0 { state } else { 0 };
    kept as f64
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
    let listed = 2.0 * (8 * D + 16) as f64 + 4.0;
    let places = match contacts > 0.0 {
        true => listed * world.free.len() as f64,
        false => 0.0,
    };
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
    pictures
        + if fields {
            BYTES_PER_PLACE * particles
        } else {
            0.0
        }
}

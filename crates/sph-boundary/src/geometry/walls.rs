//! The walls of a scene for their treatments: meshed, with the search for their elements.

pub(crate) mod beds;
pub(crate) mod cover;
mod face_sums;
mod faces;
mod planar;
mod spatial;
pub(crate) mod wall_mesh;

use std::sync::OnceLock;

use sph_core::bed::Bed;

use crate::geometry::walls::faces::Planes;
use crate::{Grid, Mesh, Shells, WallSpec};

/// Walls cut at the particle spacing, with the grid that finds their elements.
#[derive(Debug)]
pub struct Walls<const D: usize> {
    pub(crate) mesh: Mesh<D>,
    /// Of the present position, made at the first request.
    grid: OnceLock<Grid<D>>,
    pub(crate) planes: Planes,
    pub(crate) shells: Shells,
    pub(crate) reach: f64,
}

/// Walls of the plane.
pub type PlanarWalls = Walls<2>;

/// Walls in space.
pub type SpatialWalls = Walls<3>;

impl<const D: usize> Walls<D> {
    /// Of a mesh; queries look up to `reach` metres far.
    pub(crate) fn new(mesh: Mesh<D>, walls: &[WallSpec<D>], reach: f64) -> Self {
        let elements = mesh.elements.iter();
        let elements = elements.map(|e| (e.nodes, walls[e.wall].open));
        let ends = mesh.free_ends.iter().map(|end| end.node);
        let free = ends.chain(mesh.free_edges.iter().flat_map(|edge| edge.nodes));
        Walls {
            shells: Shells::new(elements, mesh.nodes.len(), free),
            grid: OnceLock::new(),
            planes: Planes::default(),
            mesh,
            reach,
        }
    }

    pub(crate) fn grid(&self) -> &Grid<D> {
        self.grid
            .get_or_init(|| Grid::build(&self.mesh, self.reach))
    }

    /// Sets the levels of the beds that walls follow, from the next motion on.
    pub(crate) fn lay(&mut self, beds: &[Bed]) {
        beds.clone_into(&mut self.mesh.beds);
    }

    pub(crate) fn forget_places(&mut self) {
        self.grid = OnceLock::new();
    }
}

//! Forces of the fluid on spheres and walls.

use rayon::prelude::*;
use sparse::Groups;

use crate::Vector;
use crate::flow::PoreGeometry;
use crate::triangulation::Vertex;

/// Forces on the solid, N, by piezometric pressure; buoyancy comes on top. Of a throat from i to j:
///
/// ```text
/// pressure    A_k (p_i − p_j) n,        A_k the sphere's area in the facet
/// viscous     A_f (p_i − p_j) n γ_k/γ,  A_f the fluid's area, γ_k the wetted area
/// ```
///
/// and the pressure of a cell on its share of a wall. The sum over spheres and walls of the forces along a gradient
/// is that of the pressures on the ends. Source: Catalano 2012, Eqs. (3.10), (3.13), (3.14); (3.13) is printed
/// with the opposite sign, with which that sum does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// Pressure force on every sphere, N.
    pub pressure: Vec<Vector>,
    /// Viscous force on every sphere, N.
    pub viscous: Vec<Vector>,
    /// Pressure force on every wall, N, out of the room.
    pub wall_pressure: Vec<Vector>,
    /// Viscous force on every wall with grip, N.
    pub wall_viscous: Vec<Vector>,
}

impl Forces {
    /// Forces of the pressures of all cells, Pa.
    pub fn new(geometry: &PoreGeometry, pressures: &[f64]) -> Self {
        let mesh = &geometry.mesh;
        let spheres = vec![Vector::zeros(); mesh.spheres.len()];
        let walls = vec![Vector::zeros(); mesh.walls.len()];
        let mut forces = Self {
            pressure: spheres.clone(),
            viscous: spheres,
            wall_pressure: walls.clone(),
            wall_viscous: walls,
        };
        for throat in &geometry.throats {
            let [i, j] = throat.cells;
            let drop = (pressures[i] - pressures[j]) * throat.normal;
            let shares = throat.shares();
            for (c, vertex) in throat.vertices.iter().enumerate() {
                let viscous = throat.fluid_area * shares[c] * drop;
                match *vertex {
                    Vertex::Sphere(k) => {
                        forces.pressure[k] += throat.sectors[c] * drop;
                        forces.viscous[k] += viscous;
                    }
                    Vertex::Wall(w) => forces.wall_viscous[w] += viscous,
                }
            }
        }
        for (w, wall) in mesh.walls.iter().enumerate() {
            for &c in mesh.cells_around(Vertex::Wall(w)) {
                let area = geometry.area_on_wall(c as usize, w);
                forces.wall_pressure[w] -= pressures[c as usize] * area * wall.normal;
            }
        }
        forces
    }

    /// Sum of both parts on a sphere, N.
    pub fn on_sphere(&self, sphere: usize) -> Vector {
        self.pressure[sphere] + self.viscous[sphere]
    }
}

/// F_k = Σ_i p_i u_i^k, with a vector for each cell around each body:
///
/// ```text
/// u_i^k = Σ_j (A_ij^k + A_ij^f γ_ij^k / γ_ij) n_ij          on a sphere k of cell i, m²
/// ```
///
/// and on walls the viscous share and the cell's area in the wall. Bodies are the spheres, then the walls. Source:
/// Catalano 2012, Eqs. (3.10), (3.13), (3.14), (4.6); the same numbers as `dem_pfv::flow::Forces`.
pub(crate) struct UnitForces {
    /// Cells around each body.
    around: Groups,
    vectors: Vec<Vector>,
}

/// Bodies that a task sums at least.
const TASK: usize = 256;

impl UnitForces {
    pub fn new(pores: &PoreGeometry) -> Self {
        let mesh = &pores.mesh;
        let mut slots = vec![[Vector::zeros(); 4]; mesh.cells.len()];
        for throat in &pores.throats {
            let shares = throat.shares();
            for (c, vertex) in throat.vertices.iter().enumerate() {
                let vector = (throat.sectors[c] + throat.fluid_area * shares[c]) * throat.normal;
                for (cell, sign) in throat.cells.into_iter().zip([1.0, -1.0]) {
                    let vertices = mesh.cells[cell].vertices();
                    if let Some(place) = vertices.iter().position(|v| v == vertex) {
                        slots[cell][place] += sign * vector;
                    }
                }
            }
        }
        let spheres = (0..mesh.spheres.len()).map(Vertex::Sphere);
        let bodies = spheres.chain((0..mesh.walls.len()).map(Vertex::Wall));
        let mut vectors = Vec::new();
        for body in bodies {
            for &cell in mesh.cells_around(body) {
                let vertices = mesh.cells[cell as usize].vertices();
                let place = vertices.iter().position(|v| *v == body).unwrap_or(0);
                let mut vector = slots[cell as usize][place];
                if let Vertex::Wall(w) = body {
                    vector -= pores.area_on_wall(cell as usize, w) * mesh.walls[w].normal;
                }
                vectors.push(vector);
            }
        }
        Self {
            around: mesh.around.clone(),
            vectors,
        }
    }

    /// Force on every sphere and wall (N) of the pressures of all cells (Pa); each body sums its cells in their order.
    pub fn apply(&self, pressures: &[f64]) -> Vec<Vector> {
        let force = |body: usize| {
            let vectors = &self.vectors[self.around.range(body)];
            let terms = self.around.members(body).iter().zip(vectors);
            terms.fold(Vector::zeros(), |sum, (c, u)| {
                sum + u * pressures[*c as usize]
            })
        };
        let bodies = (0..self.around.starts.len() - 1).into_par_iter();
        bodies.with_min_len(TASK).map(force).collect()
    }
}

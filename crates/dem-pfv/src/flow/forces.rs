//! Forces of the fluid on spheres and walls.

use nalgebra::Vector3;

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
    pub pressure: Vec<Vector3<f64>>,
    /// Viscous force on every sphere, N.
    pub viscous: Vec<Vector3<f64>>,
    /// Pressure force on every wall, N, out of the room.
    pub wall_pressure: Vec<Vector3<f64>>,
    /// Viscous force on every wall with grip, N.
    pub wall_viscous: Vec<Vector3<f64>>,
}

impl Forces {
    /// Forces of the pressures of all cells, Pa.
    pub fn new(geometry: &PoreGeometry, pressures: &[f64]) -> Self {
        let mesh = &geometry.mesh;
        let spheres = vec![Vector3::zeros(); mesh.spheres.len()];
        let walls = vec![Vector3::zeros(); mesh.walls.len()];
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
    pub fn on_sphere(&self, sphere: usize) -> Vector3<f64> {
        self.pressure[sphere] + self.viscous[sphere]
    }
}

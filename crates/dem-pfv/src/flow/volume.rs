//! Volumes of cells and of the spheres in them.

use nalgebra::Vector3;

use crate::flow::facet::edge;
use crate::flow::solid_angle;
use crate::triangulation::{Cell, Triangulation, Vertex, Wall};

/// Volumes V_i (m³) of all cells with the centres and walls given in place of the mesh's own, connectivity
/// kept; they add up to the room's. With distances a_c of a centre a from wall c:
///
/// ```text
/// tetrahedron     (a − d) × (b − d) · (c − d) / 6
/// prism           A⊥ (a_c + b_c + c_c) / 3,            A⊥ the area projected on the wall
/// wedge           ℓ/3 (a₁a₂ + b₁b₂ + ½ (a₁b₂ + a₂b₁)),  ℓ the length along both walls
/// corner          a₁ a₂ a₃
/// ```
///
/// A volume is negative if the cell has turned inside out. Rates follow by differences in time, from
/// volumes of the same mesh. Source: the exact limit of Catalano 2012, §3.1.
pub fn cell_volumes(mesh: &Triangulation, centres: &[Vector3<f64>], walls: &[Wall]) -> Vec<f64> {
    let volume = |cell: &Cell| volume(cell, centres, walls);
    mesh.cells.iter().map(volume).collect()
}

fn volume(cell: &Cell, centres: &[Vector3<f64>], walls: &[Wall]) -> f64 {
    let (vertices, sign) = spheres_first(cell.vertices());
    let x = |i: usize| match vertices[i] {
        Vertex::Sphere(k) => centres[k],
        Vertex::Wall(_) => Vector3::zeros(),
    };
    let wall = |i: usize| match vertices[i] {
        Vertex::Wall(w) => Some(&walls[w]),
        Vertex::Sphere(_) => None,
    };
    match (wall(1), wall(2), wall(3)) {
        (Some(u), Some(v), Some(w)) => u.distance(x(0)) * v.distance(x(0)) * w.distance(x(0)),
        (None, Some(v), Some(w)) => {
            let [a1, a2, b1, b2] = [
                v.distance(x(0)),
                w.distance(x(0)),
                v.distance(x(1)),
                w.distance(x(1)),
            ];
            let length = sign * (x(0) - x(1)).dot(&v.normal.cross(&w.normal));
            length / 3.0 * (a1 * a2 + b1 * b2 + 0.5 * (a1 * b2 + a2 * b1))
        }
        (_, _, Some(w)) => {
            let base = 0.5 * sign * (x(0) - x(2)).cross(&(x(1) - x(2))).dot(&w.normal);
            base * (0..3).map(|i| w.distance(x(i))).sum::<f64>() / 3.0
        }
        _ => sign * (x(0) - x(3)).cross(&(x(1) - x(3))).dot(&(x(2) - x(3))) / 6.0,
    }
}

/// Vertices with spheres first, and the sign of the permutation.
fn spheres_first(mut vertices: [Vertex; 4]) -> ([Vertex; 4], f64) {
    let mut sign = 1.0;
    for end in (1..4).rev() {
        for i in 0..end {
            let is_wall = |v| matches!(v, Vertex::Wall(_));
            if is_wall(vertices[i]) && !is_wall(vertices[i + 1]) {
                vertices.swap(i, i + 1);
                sign = -sign;
            }
        }
    }
    (vertices, sign)
}

/// Volume of the spheres within a cell, m³: Σ ⅓ R³ |ω|.
pub fn solid_volume(mesh: &Triangulation, cell: &Cell) -> f64 {
    let vertices = cell.vertices();
    let share = |v: &Vertex| {
        let Vertex::Sphere(k) = *v else { return 0.0 };
        let mut others = vertices.iter().filter(|o| *o != v);
        let [a, b, c] = [(); 3].map(|()| {
            others
                .next()
                .map_or(Vector3::zeros(), |o| edge(mesh, k, *o))
        });
        mesh.spheres[k].radius.powi(3) / 3.0 * solid_angle(a, b, c).abs()
    };
    vertices.iter().map(share).sum()
}

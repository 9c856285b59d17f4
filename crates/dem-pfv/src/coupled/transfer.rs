//! Pressures from one mesh to the next.

use crate::coupled::pores::Pores;
use crate::triangulation::{Triangulation, Vertex};

/// Pressure (Pa) of every new cell: that of the old cell of the same vertices, or where there is none, of the old cell
/// around one of its spheres whose middle is nearest.
///
/// A fluid that gives way needs it, and conjugate gradients start from it; a factorisation of stiff fluid does not.
pub(crate) fn transferred(old: &Pores, pressures: &[f64], new: &Pores) -> Vec<f64> {
    let (before, after) = (&old.geometry.mesh, &new.geometry.mesh);
    let (places, middles) = (old.middles(), new.middles());
    let value = |cell: usize| {
        let vertices = sorted(after, cell);
        let mut nearest = (f64::INFINITY, 0.0);
        for vertex in vertices {
            if !matches!(vertex, Vertex::Sphere(_)) {
                continue;
            }
            for &candidate in before.cells_around(vertex) {
                let pressure = pressures[candidate as usize];
                if sorted(before, candidate as usize) == vertices {
                    return pressure;
                }
                let distance = (places[candidate as usize] - middles[cell]).norm_squared();
                if distance < nearest.0 {
                    nearest = (distance, pressure);
                }
            }
        }
        nearest.1
    };
    (0..after.cells.len()).map(value).collect()
}

fn sorted(mesh: &Triangulation, cell: usize) -> [Vertex; 4] {
    let mut vertices = mesh.cells[cell].vertices();
    vertices.sort_unstable();
    vertices
}

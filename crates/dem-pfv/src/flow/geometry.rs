//! Pores and throats of spheres in a box.

use nalgebra::Vector3;

use crate::flow::facet::Facet;
use crate::flow::throat::{Pores, SlipCondition, SolidAngles, Throat};
use crate::flow::volume::solid_volume;
use crate::flow::{FlowError, cell_volumes};
use crate::triangulation::{Triangulation, Vertex};

/// Deepest overlap, in terms of the smaller radius.
const DEEPEST: f64 = 0.1;

/// Cells and throats of a triangulation in a room whose walls meet at right angles.
#[derive(Clone, Debug)]
pub struct PoreGeometry {
    /// The triangulation.
    pub mesh: Triangulation,
    /// Power centre of every cell, m.
    pub centres: Vec<Vector3<f64>>,
    /// Volume of every cell, m³; the sum is that of the room.
    pub volumes: Vec<f64>,
    /// Volume of fluid in every cell, m³.
    pub void_volumes: Vec<f64>,
    /// All throats.
    pub throats: Vec<Throat>,
}

impl PoreGeometry {
    /// Pores and throats; one grip per wall.
    ///
    /// # Errors
    /// A room that is no box, spheres that overlap each other or a wall by more than a tenth of the radius, a list
    /// of grips of another length than the walls.
    pub fn new(
        mesh: Triangulation,
        grips: &[SlipCondition],
        angles: SolidAngles,
    ) -> Result<Self, FlowError> {
        Self::pressed(mesh, grips, angles, DEEPEST)
    }

    /// The same for spheres that a load has pressed together: `deepest` is the largest overlap, in terms of the
    /// smaller radius. Throats that spheres fill are closed. Where a centre is in another sphere, at 1, formulas end.
    ///
    /// # Errors
    /// As [`PoreGeometry::new`].
    pub fn pressed(
        mesh: Triangulation,
        grips: &[SlipCondition],
        angles: SolidAngles,
        deepest: f64,
    ) -> Result<Self, FlowError> {
        if grips.len() != mesh.walls.len() {
            return Err(FlowError::Length {
                what: "grips of walls",
                given: grips.len(),
                needed: mesh.walls.len(),
            });
        }
        check_walls(&mesh)?;
        check_overlaps(&mesh, deepest)?;
        let cells = 0..mesh.cells.len();
        let centres: Vec<_> = cells.map(|c| mesh.power_centre(c)).collect();
        let positions: Vec<_> = mesh.spheres.iter().map(|s| s.centre).collect();
        let volumes = cell_volumes(&mesh, &positions, &mesh.walls);
        let solids = mesh.cells.iter().map(|c| solid_volume(&mesh, c));
        let void_volumes = volumes.iter().zip(solids).map(|(v, s)| v - s).collect();
        let pores = Pores {
            mesh: &mesh,
            centres: &centres,
            grips,
            angles,
        };
        let throats = mesh.facets().map(|f| pores.throat(&f)).collect();
        Ok(Self {
            mesh,
            centres,
            volumes,
            void_volumes,
            throats,
        })
    }

    /// Share (m²) of a cell in a wall: the projection of the facet opposite; zero if it has no part in the wall.
    pub fn area_on_wall(&self, cell: usize, wall: usize) -> f64 {
        let v = self.mesh.cells[cell].vertices();
        let Some(i) = v.iter().position(|v| *v == Vertex::Wall(wall)) else {
            return 0.0;
        };
        let others = std::array::from_fn(|k| v[if k < i { k } else { k + 1 }]);
        let area = Facet::new(&self.mesh, &others).area();
        area.dot(&self.mesh.walls[wall].normal).abs()
    }
}

fn check_walls(mesh: &Triangulation) -> Result<(), FlowError> {
    let walls = &mesh.walls;
    for (first, v) in walls.iter().enumerate() {
        for (second, w) in walls.iter().enumerate().skip(first + 1) {
            let cosine = v.normal.dot(&w.normal).abs();
            if cosine > 1e-12 && cosine < 1.0 - 1e-12 {
                return Err(FlowError::ObliqueWalls(first, second));
            }
        }
    }
    match walls.len() {
        6 => Ok(()),
        walls => Err(FlowError::NoBox(walls)),
    }
}

fn check_overlaps(mesh: &Triangulation, deepest: f64) -> Result<(), FlowError> {
    for cell in &mesh.cells {
        for v in cell.vertices() {
            let Vertex::Sphere(first) = v else { continue };
            let a = &mesh.spheres[first];
            for other in cell.vertices() {
                match other {
                    Vertex::Sphere(second) if second > first => {
                        let b = &mesh.spheres[second];
                        let overlap = a.radius + b.radius - (a.centre - b.centre).norm();
                        if overlap > deepest * a.radius.min(b.radius) {
                            return Err(FlowError::Overlap(first, second, overlap, deepest));
                        }
                    }
                    Vertex::Wall(wall) => {
                        let overlap = a.radius - mesh.walls[wall].distance(a.centre);
                        if overlap > deepest * a.radius {
                            return Err(FlowError::InWall(first, wall, overlap, deepest));
                        }
                    }
                    Vertex::Sphere(_) => {}
                }
            }
        }
    }
    Ok(())
}

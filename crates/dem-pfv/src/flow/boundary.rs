//! Boundary conditions: pressures and sources.

use nalgebra::Vector3;

use crate::flow::PoreGeometry;
use crate::triangulation::Vertex;

/// Pressures and sources of cells. Walls without either are closed.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    pub(crate) pressures: Vec<Option<f64>>,
    pub(crate) sources: Vec<f64>,
}

impl Boundary {
    /// All walls closed, no sources.
    pub fn closed(geometry: &PoreGeometry) -> Self {
        let cells = geometry.mesh.cells.len();
        Self {
            pressures: vec![None; cells],
            sources: vec![0.0; cells],
        }
    }

    /// Gives pressures (Pa) to the cells of a wall where `value` has one for the power centre (m), which lies on
    /// the wall. Earlier values are replaced there.
    pub fn pressure(
        &mut self,
        geometry: &PoreGeometry,
        wall: usize,
        value: impl Fn(Vector3<f64>) -> Option<f64>,
    ) {
        for &c in geometry.mesh.cells_around(Vertex::Wall(wall)) {
            if let Some(p) = value(geometry.centres[c as usize]) {
                self.pressures[c as usize] = Some(p);
            }
        }
    }

    /// Lets fluid in (out if negative) through the part of a wall that `part` names by power centres, m/s, the
    /// same everywhere: each cell takes its area on the wall times this. Returns the total, m³/s.
    pub fn inflow(
        &mut self,
        geometry: &PoreGeometry,
        wall: usize,
        velocity: f64,
        part: impl Fn(Vector3<f64>) -> bool,
    ) -> f64 {
        let mut total = 0.0;
        for &c in geometry.mesh.cells_around(Vertex::Wall(wall)) {
            if part(geometry.centres[c as usize]) {
                let rate = velocity * geometry.area_on_wall(c as usize, wall);
                self.sources[c as usize] += rate;
                total += rate;
            }
        }
        total
    }

    /// Gives the pressure of one cell, Pa.
    pub fn cell_pressure(&mut self, cell: usize, pressure: f64) {
        self.pressures[cell] = Some(pressure);
    }

    /// Adds a source to one cell, m³/s; negative takes fluid out.
    pub fn source(&mut self, cell: usize, rate: f64) {
        self.sources[cell] += rate;
    }

    /// For every cell, whether it has a given pressure.
    pub fn given(&self) -> impl Iterator<Item = bool> {
        self.pressures.iter().map(Option::is_some)
    }
}

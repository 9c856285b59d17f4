//! Boundary conditions, unknowns and entries of the system.

use sparse::UpperTriangle;
use sph_core::Sets;

use crate::Vector;
use crate::flow::{FlowError, PoreGeometry};
use crate::triangulation::Vertex;

/// A cell of a given pressure, in place of the number of an unknown.
pub const GIVEN: u32 = u32::MAX;

/// The lowest cell of every group that pairs join.
pub fn joined(cells: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Vec<u32> {
    let mut groups = Sets::new(cells);
    for pair in pairs {
        groups.join(pair.map(|cell| cell as usize));
    }
    (0..cells).map(|cell| groups.root(cell) as u32).collect()
}

/// The cell whose given pressure holds in each cell: itself, or the first of its pore that has one.
pub fn givers(boundary: &Boundary, pores: &[u32]) -> Vec<u32> {
    let mut first = vec![GIVEN; pores.len()];
    for (c, pore) in pores.iter().enumerate() {
        if boundary.pressures[c].is_some() && first[*pore as usize] == GIVEN {
            first[*pore as usize] = c as u32;
        }
    }
    let giver = |(c, pore): (usize, &u32)| match (boundary.pressures[c], first[*pore as usize]) {
        (None, giver) if giver != GIVEN => giver,
        _ => c as u32,
    };
    pores.iter().enumerate().map(giver).collect()
}

/// Refuses pores that no known pressure can reach; `known` has an entry for each cell.
pub fn reachable(
    conductances: &[f64],
    ends: &[[u32; 2]],
    known: &[bool],
    pores: &[u32],
) -> Result<(), FlowError> {
    let passable = conductances.iter().zip(ends).filter(|(k, _)| **k > 0.0);
    let pairs = passable.map(|(_, e)| e.map(|c| pores[c as usize]));
    let regions = joined(pores.len(), pairs);
    let mut reached = vec![false; pores.len()];
    for (pore, known) in pores.iter().zip(known) {
        reached[regions[*pore as usize] as usize] |= *known;
    }
    let cut_off = |p: &u32| !reached[regions[*p as usize] as usize];
    let cut_off = pores.iter().position(cut_off);
    cut_off.map_or(Ok(()), |cell| Err(FlowError::NoPressure(cell)))
}

/// Unknowns of all cells, in the order of the pores, and their count.
pub fn numbered(pores: &[u32], known: &[bool]) -> (Vec<u32>, usize) {
    let (mut numbers, mut count) = (vec![GIVEN; pores.len()], 0);
    for (c, &pore) in pores.iter().enumerate() {
        if pore as usize != c {
            numbers[c] = numbers[pore as usize];
        } else if !known[c] {
            numbers[c] = count;
            count += 1;
        }
    }
    (numbers, count as usize)
}

pub fn assemble(
    conductances: &[f64],
    ends: &[[u32; 2]],
    unknowns: &[u32],
    count: usize,
) -> (Vec<f64>, UpperTriangle) {
    let mut diagonal = vec![0.0; count];
    let mut entries = Vec::new();
    for (k, e) in conductances.iter().zip(ends) {
        let [u, v] = e.map(|c| unknowns[c as usize]);
        if u == v {
            continue;
        }
        for u in [u, v].into_iter().filter(|u| *u != GIVEN) {
            diagonal[u as usize] += k;
        }
        if u != GIVEN && v != GIVEN {
            entries.push((u.max(v), u.min(v), -k));
        }
    }
    let matrix = UpperTriangle::new(&diagonal, entries);
    (diagonal, matrix)
}

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
        value: impl Fn(Vector) -> Option<f64>,
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
        part: impl Fn(Vector) -> bool,
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

    /// Adds a source to one cell, m³/s; negative takes fluid out.
    pub fn source(&mut self, cell: usize, rate: f64) {
        self.sources[cell] += rate;
    }

    /// Zero wherever a pressure is given, no sources.
    pub(crate) fn silent(&self) -> Self {
        let pressures = self.pressures.iter().map(|p| p.map(|_| 0.0));
        Self {
            pressures: pressures.collect(),
            sources: vec![0.0; self.sources.len()],
        }
    }
}

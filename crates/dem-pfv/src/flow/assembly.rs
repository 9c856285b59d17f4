//! Pores, unknowns and entries of the system.

use sparse::UpperTriangle;

use crate::flow::{Boundary, Conductance, FlowError, PoreGeometry};

/// A cell of a given pressure, in place of the number of an unknown.
pub const GIVEN: u32 = u32::MAX;

pub fn conductances(
    geometry: &PoreGeometry,
    law: &dyn Conductance,
    viscosity: f64,
) -> Result<Vec<f64>, FlowError> {
    let conductance = |t: &crate::flow::Throat| {
        if t.open || t.fluid_area <= 0.0 {
            return Ok(0.0);
        }
        let value = law.conductance(t);
        match value >= 0.0 && value.is_finite() {
            true => Ok(value / (viscosity * t.length)),
            false => Err(FlowError::BadConductance(t.cells, value)),
        }
    };
    geometry.throats.iter().map(conductance).collect()
}

/// The lowest cell of every group that pairs join.
pub fn joined(cells: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Vec<u32> {
    let mut first: Vec<u32> = (0..cells as u32).collect();
    let root = |first: &mut Vec<u32>, mut c: u32| {
        while first[c as usize] != c {
            first[c as usize] = first[first[c as usize] as usize];
            c = first[c as usize];
        }
        c
    };
    for [a, b] in pairs {
        let (a, b) = (root(&mut first, a), root(&mut first, b));
        first[a.max(b) as usize] = a.min(b);
    }
    (0..cells as u32).map(|c| root(&mut first, c)).collect()
}

/// For every pore, the first of its cells that has a given pressure.
pub fn firsts(boundary: &Boundary, pores: &[u32]) -> Vec<u32> {
    let mut first = vec![GIVEN; pores.len()];
    for (c, pore) in pores.iter().enumerate() {
        if boundary.pressures[c].is_some() && first[*pore as usize] == GIVEN {
            first[*pore as usize] = c as u32;
        }
    }
    first
}

/// The cell whose given pressure holds in each cell: itself, or the first of its pore that has one.
pub fn givers(boundary: &Boundary, pores: &[u32], first: &[u32]) -> Vec<u32> {
    let giver = |(c, pore): (usize, &u32)| match (boundary.pressures[c], first[*pore as usize]) {
        (None, giver) if giver != GIVEN => giver,
        _ => c as u32,
    };
    pores.iter().enumerate().map(giver).collect()
}

pub fn reachable(
    conductances: &[f64],
    ends: &[[u32; 2]],
    first: &[u32],
    pores: &[u32],
) -> Result<(), FlowError> {
    let passable = conductances.iter().zip(ends).filter(|(k, _)| **k > 0.0);
    let pairs = passable.map(|(_, e)| e.map(|c| pores[c as usize]));
    let regions = joined(pores.len(), pairs);
    let mut reached = vec![false; pores.len()];
    for (pore, first) in first.iter().enumerate() {
        reached[regions[pore] as usize] |= *first != GIVEN;
    }
    match pores
        .iter()
        .position(|p| !reached[regions[*p as usize] as usize])
    {
        Some(cell) => Err(FlowError::NoPressure(cell)),
        None => Ok(()),
    }
}

/// Unknowns of all cells, in the order of the pores, and their count.
pub fn numbered(pores: &[u32], first: &[u32]) -> (Vec<u32>, usize) {
    let mut numbers = vec![GIVEN; pores.len()];
    let mut count = 0;
    for (c, &pore) in pores.iter().enumerate() {
        if first[pore as usize] != GIVEN {
            continue;
        }
        if pore as usize == c {
            numbers[c] = count;
            count += 1;
        } else {
            numbers[c] = numbers[pore as usize];
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

//! The first cells: those of the corners of a room, or of four spheres.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::triangulation::predicates::{GHOST, Predicates};
use crate::triangulation::{Sphere, TriangulationError, Wall};

/// Cells with O > 0; those with the ghost are seen from below as the others are.
pub type Cells = Vec<[u32; 4]>;

/// Cells of one sphere in a room: one for every corner, and one behind each.
///
/// # Errors
/// Walls that do not close a room, that have no part in it, or of which four meet.
pub fn room(
    predicates: &Predicates,
    walls: &[Wall],
    spheres: usize,
    first: u32,
) -> Result<Cells, TriangulationError> {
    let corners = corners(predicates, walls.len())?;
    closed(&corners, walls.len())?;
    let mut cells = Cells::new();
    for corner in corners {
        let [a, b, c] = corner.map(|w| (spheres + w) as u32);
        cells.push([a, b, c, first]);
        cells.push([b, a, c, GHOST]);
    }
    Ok(cells)
}

/// Triples of walls that meet in a corner of the room, with det(−n) > 0.
fn corners(predicates: &Predicates, walls: usize) -> Result<Vec<[usize; 3]>, TriangulationError> {
    let mut found = Vec::new();
    for i in 0..walls {
        for j in i + 1..walls {
            for k in j + 1..walls {
                let turn = predicates.walls_orientation([i, j, k]);
                if turn != Ordering::Equal && is_corner(predicates, [i, j, k], turn, walls)? {
                    let right = turn == Ordering::Greater;
                    found.push(if right { [i, j, k] } else { [j, i, k] });
                }
            }
        }
    }
    Ok(found)
}

/// True if the point in which three walls meet is inside all others. With it as the origin, the
/// determinant of the four lifted walls is det(−n) of the three times −2c of the fourth, and the
/// point is inside if c < 0.
fn is_corner(
    predicates: &Predicates,
    three: [usize; 3],
    turn: Ordering,
    walls: usize,
) -> Result<bool, TriangulationError> {
    let [i, j, k] = three;
    let mut meets = None;
    for m in (0..walls).filter(|m| !three.contains(m)) {
        match predicates.walls_lifted([i, j, k, m]) {
            Ordering::Equal => meets = Some([i, j, k, m]),
            side if side != turn => return Ok(false),
            _ => {}
        }
    }
    match meets {
        Some(walls) => Err(TriangulationError::FourWallsMeet(walls)),
        None => Ok(true),
    }
}

/// Refuses rooms of which an edge has not two ends, and walls without an edge.
fn closed(corners: &[[usize; 3]], walls: usize) -> Result<(), TriangulationError> {
    let mut ends = BTreeMap::new();
    for corner in corners {
        for skip in 0..3 {
            let [a, b] = [corner[(skip + 1) % 3], corner[(skip + 2) % 3]];
            *ends.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    if let Some(((first, second), corners)) = ends.iter().find(|(_, n)| **n != 2) {
        return Err(TriangulationError::Open(*first, *second, *corners));
    }
    if corners.is_empty() {
        return Err(TriangulationError::Open(0, 1.min(walls - 1), 0));
    }
    match (0..walls).find(|w| corners.iter().all(|c| !c.contains(w))) {
        Some(wall) => Err(TriangulationError::IdleWall(wall)),
        None => Ok(()),
    }
}

/// Cells of four spheres that are not in one plane, far apart: one between them, four behind.
///
/// # Errors
/// All centres lie in one plane.
pub fn four_spheres(
    predicates: &Predicates,
    spheres: &[Sphere],
) -> Result<([u32; 4], Cells), TriangulationError> {
    let x = |i: usize| spheres[i].centre;
    let largest = |measure: &dyn Fn(usize) -> f64| {
        let all = (0..spheres.len()).map(|i| (measure(i), i));
        all.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0, |(_, i)| i)
    };
    let b = largest(&|i| (x(i) - x(0)).norm());
    let c = largest(&|i| (x(b) - x(0)).cross(&(x(i) - x(0))).norm());
    let normal = (x(b) - x(0)).cross(&(x(c) - x(0)));
    let far = largest(&|i| normal.dot(&(x(i) - x(0))).abs());
    let base = [0, b as u32, c as u32];
    let side = |d: usize| predicates.side(base, d as u32);
    let mut fourth = std::iter::once(far).chain(0..spheres.len());
    let Some(d) = fourth.find(|d| side(*d) != Ordering::Equal) else {
        return Err(TriangulationError::Flat);
    };
    let [p, q, r] = match side(d) {
        Ordering::Greater => base,
        _ => [base[1], base[0], base[2]],
    };
    let cell = [p, q, r, d as u32];
    let mut cells = vec![cell];
    for i in 0..4 {
        let mut behind = cell;
        behind[i] = GHOST;
        behind.swap((i + 1) % 4, (i + 2) % 4);
        cells.push(behind);
    }
    Ok((cell, cells))
}

//! The first cells, and the insertion of spheres one by one: locate, carve, fill (Bowyer 1981, Watson 1981).

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};

use crate::triangulation::predicates::{GHOST, Predicates, except};
use crate::triangulation::{Sphere, TriangulationError, Wall};

/// No neighbour yet.
const NONE: u32 = u32::MAX;

/// A triangulation that grows. Neighbour i of a cell is the one across the facet without vertex i.
pub struct Builder<'a> {
    predicates: &'a Predicates,
    pub cells: Vec<[u32; 4]>,
    pub neighbours: Vec<[u32; 4]>,
    /// Places of cells that are no more.
    free: Vec<u32>,
    /// 2n for cells in conflict with sphere n of the insertion, 2n + 1 for those tested without.
    marks: Vec<u32>,
    stamp: u32,
    /// The begin of the next walk.
    last: u32,
    carved: Vec<u32>,
    /// Facets between a carved cell and one that stays: cell, place of the vertex opposite, neighbour.
    rim: Vec<(u32, usize, u32)>,
    /// Edges of the rim: both vertices, the new cell, the place of the vertex opposite.
    edges: Vec<((u32, u32), u32, usize)>,
}

impl<'a> Builder<'a> {
    pub fn new(predicates: &'a Predicates, cells: Cells) -> Self {
        let mut neighbours = vec![[NONE; 4]; cells.len()];
        let mut open = HashMap::new();
        for (c, cell) in cells.iter().enumerate() {
            for i in 0..4 {
                let mut facet: [u32; 3] = except(cell, i);
                facet.sort_unstable();
                if let Some((other, j)) = open.remove(&facet) {
                    neighbours[c][i] = other as u32;
                    let back: &mut [u32; 4] = &mut neighbours[other];
                    back[j] = c as u32;
                } else {
                    open.insert(facet, (c, i));
                }
            }
        }
        debug_assert!(open.is_empty(), "the first cells are closed");
        Self {
            predicates,
            marks: vec![0; cells.len()],
            cells,
            neighbours,
            free: Vec::new(),
            stamp: 0,
            last: 0,
            carved: Vec::new(),
            rim: Vec::new(),
            edges: Vec::new(),
        }
    }

    /// True for places whose cell is no more.
    pub fn vacant(&self) -> Vec<bool> {
        let mut vacant = vec![false; self.cells.len()];
        for c in &self.free {
            vacant[*c as usize] = true;
        }
        vacant
    }

    /// Adds a sphere.
    ///
    /// # Errors
    /// It is hidden by those that are there.
    pub fn insert(&mut self, e: u32) -> Result<(), TriangulationError> {
        let start = self.walk(e);
        if !self.conflict(start, e) {
            return Err(TriangulationError::Hidden(e as usize));
        }
        self.carve(start, e);
        self.fill(e);
        Ok(())
    }

    /// Walks from the last cell to one that holds the centre of `e`, or to one behind the hull that sees it.
    /// Every step crosses a facet that separates; in a regular triangulation such walks end.
    fn walk(&self, e: u32) -> u32 {
        let (cells, neighbours) = (&self.cells, &self.neighbours);
        let mut here = self.last as usize;
        if let Some(ghost) = cells[here].iter().position(|v| *v == GHOST) {
            here = neighbours[here][ghost] as usize;
        }
        let mut from = NONE;
        loop {
            let cell = cells[here];
            let beyond = (0..4).find(|&i| {
                if neighbours[here][i] == from {
                    return false;
                }
                let side = self.predicates.side(except(&cell, i), e);
                // With e in place of vertex i, O has the sign (−1)^(i + 3) of that of the others and e.
                side == [Ordering::Greater, Ordering::Less][i % 2]
            });
            let Some(i) = beyond else {
                return here as u32;
            };
            from = here as u32;
            here = neighbours[here][i] as usize;
            if cells[here].contains(&GHOST) {
                return here as u32;
            }
        }
    }

    /// A sphere in the plane of a facet of the hull is in conflict with the cell behind it if it is
    /// with the cell before it.
    fn conflict(&self, c: u32, e: u32) -> bool {
        let cell = self.cells[c as usize];
        self.predicates.conflict(cell, e).unwrap_or_else(|| {
            let ghost = cell.iter().position(|v| *v == GHOST).unwrap_or(0);
            let before = self.neighbours[c as usize][ghost];
            let before = self.cells[before as usize];
            self.predicates.conflict(before, e).unwrap_or(false)
        })
    }

    fn carve(&mut self, start: u32, e: u32) {
        self.stamp += 1;
        let (hit, miss) = (2 * self.stamp, 2 * self.stamp + 1);
        self.carved.clear();
        self.rim.clear();
        self.carved.push(start);
        self.marks[start as usize] = hit;
        let mut next = 0;
        while let Some(&c) = self.carved.get(next) {
            next += 1;
            for i in 0..4 {
                let n = self.neighbours[c as usize][i];
                let mark = self.marks[n as usize];
                if mark == hit {
                    continue;
                }
                if mark != miss && self.conflict(n, e) {
                    self.marks[n as usize] = hit;
                    self.carved.push(n);
                } else {
                    self.marks[n as usize] = miss;
                    self.rim.push((c, i, n));
                }
            }
        }
    }

    fn fill(&mut self, e: u32) {
        self.edges.clear();
        for f in 0..self.rim.len() {
            let (c, i, n) = self.rim[f];
            let mut cell = self.cells[c as usize];
            cell[i] = e;
            let new = self.place(cell);
            self.neighbours[new as usize][i] = n;
            let back = &mut self.neighbours[n as usize];
            if let Some(j) = back.iter().position(|b| *b == c) {
                back[j] = new;
            }
            for j in (0..4).filter(|j| *j != i) {
                let facet: [u32; 3] = except(&cell, j);
                let [a, b] = except(&facet, if i < j { i } else { i - 1 });
                self.edges.push(((a.min(b), a.max(b)), new, j));
            }
        }
        self.edges.sort_unstable();
        for pair in self.edges.chunks_exact(2) {
            let ((key, a, i), (other, b, j)) = (pair[0], pair[1]);
            debug_assert_eq!(key, other, "the rim of a cavity is closed");
            self.neighbours[a as usize][i] = b;
            self.neighbours[b as usize][j] = a;
        }
        // Only now, so that no new cell has taken the place of one that a neighbour still names.
        self.free.append(&mut self.carved);
    }

    fn place(&mut self, cell: [u32; 4]) -> u32 {
        let place = self.free.pop().unwrap_or_else(|| {
            self.cells.push(cell);
            self.neighbours.push([NONE; 4]);
            self.marks.push(0);
            (self.cells.len() - 1) as u32
        });
        self.cells[place as usize] = cell;
        self.neighbours[place as usize] = [NONE; 4];
        self.marks[place as usize] = 0;
        self.last = place;
        place
    }
}

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
    for (i, j) in (0..walls).flat_map(|i| (i + 1..walls).map(move |j| (i, j))) {
        for k in j + 1..walls {
            match predicates.walls_orientation([i, j, k]) {
                Ordering::Equal => {}
                turn if !is_corner(predicates, [i, j, k], turn, walls)? => {}
                Ordering::Greater => found.push([i, j, k]),
                Ordering::Less => found.push([j, i, k]),
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
    [i, j, k]: [usize; 3],
    turn: Ordering,
    walls: usize,
) -> Result<bool, TriangulationError> {
    let mut meets = None;
    for m in (0..walls).filter(|m| ![i, j, k].contains(m)) {
        match predicates.walls_lifted([i, j, k, m]) {
            Ordering::Equal => meets = Some([i, j, k, m]),
            side if side != turn => return Ok(false),
            _ => {}
        }
    }
    meets.map_or(Ok(true), |walls| {
        Err(TriangulationError::FourWallsMeet(walls))
    })
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
    let idle = (0..walls).find(|w| corners.iter().all(|c| !c.contains(w)));
    idle.map_or(Ok(()), |wall| Err(TriangulationError::IdleWall(wall)))
}

/// Cells of four spheres that are not in one plane, far apart: one between them, four behind.
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

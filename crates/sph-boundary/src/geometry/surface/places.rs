//! Points of walls that are the same place.

use std::collections::HashMap;

use crate::geometry::periodic::PeriodicBox;
use crate::geometry::vector::{Point, add, dot, sub};
use crate::parallel::*;

/// Something numbered, moved by whole periods: a point of a wall as drawn, or a node of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Site {
    pub id: u32,
    pub image: [i32; 3],
}

impl Site {
    pub fn unmoved(id: u32) -> Self {
        let image = [0; 3];
        Self { id, image }
    }

    pub fn moved(self, by: [i32; 3]) -> Self {
        let image = std::array::from_fn(|k| self.image[k] + by[k]);
        Self { image, ..self }
    }

    pub fn moved_back(self, by: [i32; 3]) -> Self {
        self.moved(by.map(|n| -n))
    }
}

/// An edge whichever way it is travelled and across whichever period it is drawn: from `first`, unmoved, to `second`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct EdgeKey {
    pub first: u32,
    pub second: Site,
}

/// An edge between two sites: its key, whether it is travelled like the key, and where the key's first end is drawn.
pub(super) fn edge_key(from: Site, to: Site) -> (EdgeKey, bool, [i32; 3]) {
    let apart = to.moved_back(from.image);
    let forward = (from.id, [0; 3]) < (to.id, apart.image);
    let (first, second) = if forward { (from, to) } else { (to, from) };
    let key = EdgeKey {
        first: first.id,
        second: second.moved_back(first.image),
    };
    (key, forward, first.image)
}

#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct HalfEdge {
    pub key: EdgeKey,
    pub triangle: u32,
    pub edge: u8,
    /// True if it is travelled like the key.
    pub forward: bool,
    /// Cell of the key's first end as drawn.
    pub at: [i32; 3],
}

/// The edges of triangles with these corners, those alike behind each other.
pub(super) fn half_edges(triangles: impl Iterator<Item = [Site; 3]>) -> Vec<HalfEdge> {
    let of = |(triangle, corners): (usize, [Site; 3])| {
        [0, 1, 2].map(|edge| {
            let (key, forward, at) = edge_key(corners[edge], corners[(edge + 1) % 3]);
            HalfEdge {
                key,
                triangle: triangle as u32,
                edge: edge as u8,
                forward,
                at,
            }
        })
    };
    let mut halves: Vec<HalfEdge> = triangles.enumerate().flat_map(of).collect();
    halves.par_sort_unstable();
    halves
}

/// The distinct places among points, by group of walls and up to whole periods.
pub(super) struct Places {
    tolerance: f64,
    pub domain: PeriodicBox<3>,
    pub positions: Vec<Point>,
    pub groups: Vec<usize>,
    /// The last place of each cell, and for each place the one before it in its cell.
    cells: HashMap<[i64; 3], u32>,
    before: Vec<Option<u32>>,
}

impl Places {
    pub fn new(tolerance: f64, domain: &PeriodicBox<3>) -> Self {
        Self {
            tolerance,
            domain: *domain,
            positions: Vec::new(),
            groups: Vec::new(),
            cells: HashMap::new(),
            before: Vec::new(),
        }
    }

    /// Position of a site, m.
    pub fn at(&self, site: Site) -> Point {
        let position = self.positions[site.id as usize];
        if site.image == [0; 3] {
            position
        } else {
            add(position, self.domain.shift(site.image))
        }
    }

    /// The place of a point, a new one if there is none yet.
    pub fn find(&mut self, point: Point, group: usize) -> Site {
        if let Some(site) = self.known(point, group) {
            return site;
        }
        let id = self.positions.len() as u32;
        self.positions.push(point);
        self.groups.push(group);
        let cell = self.wrapped(point).map(|x| self.cell(x));
        self.before.push(self.cells.insert(cell, id));
        Site::unmoved(id)
    }

    fn known(&self, point: Point, group: usize) -> Option<Site> {
        let wrapped = self.wrapped(point);
        let [x, y, z] = [0, 1, 2].map(|k| self.cells_about(k, wrapped[k]));
        let cells = x.iter().flat_map(|i| y.iter().map(move |j| (i, j)));
        for cell in cells.flat_map(|(i, j)| z.iter().map(move |k| [*i, *j, *k])) {
            let mut next = self.cells.get(&cell).copied();
            while let Some(id) = next {
                let apart = sub(point, self.positions[id as usize]);
                let (image, rest) = self.domain.nearest(apart);
                let near = dot(rest, rest) <= self.tolerance * self.tolerance;
                if near && self.groups[id as usize] == group {
                    return Some(Site { id, image });
                }
                next = self.before[id as usize];
            }
        }
        None
    }

    fn wrapped(&self, point: Point) -> Point {
        let periods = self.domain.periods();
        std::array::from_fn(|k| match self.domain.periodic[k] {
            true => (point[k] - self.domain.lower[k]).rem_euclid(periods[k]),
            false => point[k],
        })
    }

    fn cell(&self, x: f64) -> i64 {
        (x / (4.0 * self.tolerance)).floor() as i64
    }

    /// Cells within the tolerance of a wrapped coordinate, also beyond the seam.
    fn cells_about(&self, axis: usize, x: f64) -> Vec<i64> {
        let mut cells = vec![self.cell(x - self.tolerance), self.cell(x + self.tolerance)];
        if self.domain.periodic[axis] {
            let period = self.domain.periods()[axis];
            if x < self.tolerance {
                cells.extend([self.cell(x + period - self.tolerance), self.cell(period)]);
            }
            if x > period - self.tolerance {
                cells.extend([self.cell(0.0), self.cell(x - period + self.tolerance)]);
            }
        }
        cells.sort_unstable();
        cells.dedup();
        cells
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seam_is_one_place() {
        let domain = PeriodicBox {
            lower: [1.0, 0.0, 0.0],
            upper: [3.0, 1.0, 1.0],
            periodic: [true, false, false],
        };
        let mut places = Places::new(1e-6, &domain);
        let first = places.find([1.0, 0.5, 0.5], 0);
        let second = places.find([3.0 - 2e-7, 0.5, 0.5], 0);
        assert_eq!((first.id, second.id, second.image), (0, 0, [1, 0, 0]));
        assert_eq!(places.at(second), [3.0, 0.5, 0.5]);
        assert_eq!(places.find([3.0 - 2e-6, 0.5, 0.5], 0).id, 1);
        assert_eq!(places.find([1.0, 0.5, 0.5], 1).id, 2, "of another group");
        let (key, forward, at) = edge_key(second, places.find([3.0, 0.0, 0.0], 0));
        assert!(forward);
        assert_eq!(
            (key.first, key.second.image, at),
            (0, [-1, 0, 0], [1, 0, 0])
        );
    }
}

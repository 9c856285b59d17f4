//! Triangles sorted by the rays that may meet them.

use surface_file::Winding;

use super::grid::{NearTriangle, TriangleGrid};
use super::vector::Point;

/// What the question on which side a point is needs of a mesh, for the present position.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    /// One set of columns; if all axes are periodic, one along each, and the last one's axis goes
    /// through a triangle.
    pub columns: Vec<Columns>,
    /// The centre of that triangle, m.
    pub target: Point,
    /// Whether the fluid lies beyond all walls.
    pub beyond: bool,
    /// Where there are free edges, what finds the nearest wall.
    pub front: Option<TriangleGrid>,
    /// Where there are free edges, how the walls wind around a place; of the other sign, since normals point into the
    /// fluid.
    pub winding: Option<Winding>,
}

/// Triangles that a ray along an axis may meet, by columns.
#[derive(Clone, Debug)]
pub(super) struct Columns {
    /// The axis of the ray.
    pub along: usize,
    /// The other two axes, in the order that makes them right-handed.
    pub across: [usize; 2],
    lower: [f64; 2],
    per_cell: f64,
    columns: [usize; 2],
    starts: Vec<u32>,
    entries: Vec<NearTriangle>,
}

impl Columns {
    /// Of images of triangles with their bounds across the ray.
    pub fn new(along: usize, across: [usize; 2], images: &[(NearTriangle, [[f64; 2]; 2])]) -> Self {
        let mut lower = [f64::INFINITY; 2];
        let mut upper = [f64::NEG_INFINITY; 2];
        for (_, [low, high]) in images {
            for k in 0..2 {
                lower[k] = lower[k].min(low[k]);
                upper[k] = upper[k].max(high[k]);
            }
        }
        let extent = [0, 1].map(|k| (upper[k] - lower[k]).max(0.0));
        // About two triangles to a column.
        let size = (2.0 * extent[0] * extent[1] / images.len().max(1) as f64).sqrt();
        let longest = extent[0].max(extent[1]);
        let size = size.max(longest / images.len().max(1) as f64);
        let per_cell = if size > 0.0 { 1.0 / size } else { 1.0 };
        let columns = extent.map(|width| (width * per_cell) as usize + 1);
        let mut all = Self {
            along,
            across,
            lower,
            per_cell,
            columns,
            starts: vec![0; columns[0] * columns[1] + 1],
            entries: Vec::new(),
        };
        all.fill(images);
        all
    }

    fn fill(&mut self, images: &[(NearTriangle, [[f64; 2]; 2])]) {
        let covered = |all: &Self, [low, high]: [[f64; 2]; 2]| {
            // A little more, so that rounding loses no ray along the rim.
            let index = |k: usize, x: f64, more: f64| {
                let at = (x - all.lower[k]) * all.per_cell + more;
                (at.max(0.0) as usize).min(all.columns[k] - 1)
            };
            let range = |k: usize| index(k, low[k], -1e-6)..=index(k, high[k], 1e-6);
            let (rows, columns, width) = (range(1), range(0), all.columns[0]);
            rows.flat_map(move |row| columns.clone().map(move |c| row * width + c))
        };
        for (_, bounds) in images {
            for column in covered(self, *bounds) {
                self.starts[column + 1] += 1;
            }
        }
        for column in 1..self.starts.len() {
            self.starts[column] += self.starts[column - 1];
        }
        let total = self.starts.last().map_or(0, |n| *n as usize);
        self.entries = vec![NearTriangle::default(); total];
        let mut next = self.starts.clone();
        for (near, bounds) in images {
            for column in covered(self, *bounds) {
                self.entries[next[column] as usize] = *near;
                next[column] += 1;
            }
        }
    }

    /// Triangles that a ray from the point may meet.
    pub fn column(&self, point: Point) -> &[NearTriangle] {
        let [x, y] = [0, 1].map(|k| (point[self.across[k]] - self.lower[k]) * self.per_cell);
        let (i, j) = (x.max(0.0) as usize, y.max(0.0) as usize);
        let within = x >= -1e-6 && y >= -1e-6 && i < self.columns[0] && j < self.columns[1];
        if !within {
            return &[];
        }
        let column = j * self.columns[0] + i;
        &self.entries[self.starts[column] as usize..self.starts[column + 1] as usize]
    }
}

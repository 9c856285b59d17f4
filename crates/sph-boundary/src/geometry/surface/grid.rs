//! Triangles sorted by cells.

use super::vector::{Point, bounds, dot, sub};

/// Most cells per registered triangle: a grid over a vast empty box is made coarser.
const CELLS_PER_ENTRY: usize = 8;

/// Size of a cell over the reach.
const PART_OF_REACH: f64 = 0.5;

/// What rounding may do to a squared distance, relatively.
pub(super) const ROUNDING: f64 = 1e-9;

/// A triangle and the whole periods to add to its position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NearTriangle {
    /// Index of the triangle.
    pub triangle: u32,
    /// Whole periods.
    pub image: [i8; 3],
}

/// A uniform grid whose cells list the triangles with their centre in them.
///
/// Every image of a triangle that comes near the box is listed once, in 40 bytes. A query looks at
/// all cells within its radius; one far from all walls finds nothing and costs nothing.
#[derive(Clone, Debug)]
pub struct TriangleGrid {
    reach: f64,
    /// Largest radius of a sphere, m.
    widest: f64,
    lower: [f64; 3],
    per_cell: f64,
    cells: [usize; 3],
    /// Start of every cell's list, and the end of the last one.
    starts: Vec<u32>,
    pub(super) entries: Vec<NearTriangle>,
    /// Around every entry.
    pub(super) spheres: Vec<Sphere>,
}

/// The sphere about the mean of a triangle's corners in which it is, m.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sphere {
    pub(super) centre: Point,
    pub(super) radius: f64,
}

impl Sphere {
    /// Squared distance of the centre from a point, m², if the sphere is nearer than `radius`.
    #[inline(always)]
    pub(super) fn within(&self, point: Point, radius: f64) -> Option<f64> {
        let offset = sub(self.centre, point);
        let (distance2, limit) = (dot(offset, offset), radius + self.radius);
        (distance2 < limit * limit).then_some(distance2)
    }
}

impl TriangleGrid {
    /// Of the centres of all images of triangles and the radius of every triangle about its centre; queries
    /// reach `reach` far, m.
    pub(super) fn of(images: &[(NearTriangle, Point)], radii: &[f64], reach: f64) -> Self {
        let [lower, upper] = bounds(images.iter().map(|(_, centre)| *centre));
        let extent: Point = std::array::from_fn(|k| (upper[k] - lower[k]).max(0.0));
        let limit = (CELLS_PER_ENTRY * images.len()).max(1) as f64;
        let mut size = (PART_OF_REACH * reach).max(f64::MIN_POSITIVE);
        while extent.iter().map(|x| (x / size).ceil()).product::<f64>() > limit {
            size *= 1.5;
        }
        let cells = extent.map(|width| (width / size) as usize + 1);
        let mut grid = Self {
            reach,
            widest: radii.iter().copied().fold(0.0, f64::max),
            lower,
            per_cell: 1.0 / size,
            cells,
            starts: vec![0; cells[0] * cells[1] * cells[2] + 1],
            entries: vec![NearTriangle::default(); images.len()],
            spheres: vec![Sphere::default(); images.len()],
        };
        grid.fill(images, radii);
        grid
    }

    /// Counts, then places: the order of `images` is kept in every cell.
    fn fill(&mut self, images: &[(NearTriangle, Point)], radii: &[f64]) {
        let cell = |grid: &Self, centre: Point| {
            let [i, j, k] = [0, 1, 2].map(|axis| {
                let x = (centre[axis] - grid.lower[axis]) * grid.per_cell;
                (x as usize).min(grid.cells[axis] - 1)
            });
            grid.index([i, j, k])
        };
        for (_, centre) in images {
            let cell = cell(self, *centre);
            self.starts[cell + 1] += 1;
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        let mut next = self.starts.clone();
        for (near, centre) in images {
            let cell = cell(self, *centre);
            let place = next[cell] as usize;
            self.entries[place] = *near;
            self.spheres[place] = Sphere {
                centre: *centre,
                radius: radii[near.triangle as usize],
            };
            next[cell] += 1;
        }
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.cells[1] + j) * self.cells[0] + i
    }

    /// Largest radius of a query, m.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// Calls `found` with the place of every image whose sphere is in reach and its centre's squared distance, m².
    #[inline]
    pub(super) fn visit(&self, point: Point, radius: f64, mut found: impl FnMut(usize, f64)) {
        let Some([first, last]) = self.cells_within(point, radius) else {
            return;
        };
        for k in first[2]..=last[2] {
            for j in first[1]..=last[1] {
                let from = self.starts[self.index([first[0], j, k])] as usize;
                let to = self.starts[self.index([last[0], j, k]) + 1] as usize;
                for (place, sphere) in (from..).zip(&self.spheres[from..to]) {
                    if let Some(distance2) = sphere.within(point, radius) {
                        found(place, distance2);
                    }
                }
            }
        }
    }

    /// First and last cell along each axis with centres of spheres that may be in reach.
    fn cells_within(&self, point: [f64; 3], radius: f64) -> Option<[[usize; 3]; 2]> {
        let mut range = [[0; 3]; 2];
        for k in 0..3 {
            let at = (point[k] - self.lower[k]) * self.per_cell;
            let around = (radius + self.widest) * self.per_cell;
            let (low, high) = (at - around, at + around);
            if self.entries.is_empty() || high < 0.0 || low >= self.cells[k] as f64 {
                return None;
            }
            range[0][k] = low.max(0.0) as usize;
            range[1][k] = (high as usize).min(self.cells[k] - 1);
        }
        Some(range)
    }

    /// Bytes that the grid holds.
    pub fn memory(&self) -> usize {
        size_of_val(self.starts.as_slice())
            + size_of_val(self.entries.as_slice())
            + size_of_val(self.spheres.as_slice())
    }
}

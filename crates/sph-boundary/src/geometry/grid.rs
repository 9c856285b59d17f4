//! Segments near a point.

use crate::geometry::mesh::{NearSegment, SegmentMesh};
use crate::geometry::segment_distance::distance_squared;

/// Most cells per registered segment: a grid over a vast empty box is made coarser.
const CELLS_PER_ENTRY: usize = 64;

#[derive(Clone, Copy, Debug)]
struct Entry {
    segment: u32,
    image: [i32; 2],
}

/// A uniform grid whose cells list the segments within reach of any point in them.
///
/// A point far from all walls finds an empty list, or none. Lists ascend by segment, then image.
#[derive(Clone, Debug)]
pub struct SegmentGrid {
    reach: f64,
    lower: [f64; 2],
    per_cell: f64,
    cells: [usize; 2],
    /// Start of every cell's list, and the end of the last one.
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

impl SegmentGrid {
    /// Lists for the present position of the walls and queries up to the radius `reach`, m.
    ///
    /// With periodic directions, points in the box or within `reach` of it are served.
    pub fn build(mesh: &SegmentMesh, reach: f64) -> Self {
        let images = images(mesh, reach);
        let mut lower = [f64::INFINITY; 2];
        let mut upper = [f64::NEG_INFINITY; 2];
        for (_, [low, high]) in &images {
            for k in 0..2 {
                lower[k] = lower[k].min(low[k]);
                upper[k] = upper[k].max(high[k]);
            }
        }
        let extent = [0, 1].map(|k| (upper[k] - lower[k]).max(0.0));
        let limit = (CELLS_PER_ENTRY * images.len()).max(1) as f64;
        let mut size = reach.max(f64::MIN_POSITIVE);
        while (extent[0] / size).ceil() * (extent[1] / size).ceil() > limit {
            size *= 1.5;
        }
        let cells = extent.map(|width| (width / size) as usize + 1);
        let mut grid = Self {
            reach,
            lower,
            per_cell: 1.0 / size,
            cells,
            starts: vec![0; cells[0] * cells[1] + 1],
            entries: Vec::new(),
        };
        grid.fill(&images);
        grid
    }

    /// Counts, then places: the order of `images` is kept in every cell.
    fn fill(&mut self, images: &[(Entry, [[f64; 2]; 2])]) {
        for (_, bounds) in images {
            for cell in self.covered(bounds) {
                self.starts[cell + 1] += 1;
            }
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        let total = self.starts.last().map_or(0, |n| *n as usize);
        self.entries = vec![
            Entry {
                segment: 0,
                image: [0; 2]
            };
            total
        ];
        let mut next = self.starts.clone();
        for (entry, bounds) in images {
            for cell in self.covered(bounds) {
                self.entries[next[cell] as usize] = *entry;
                next[cell] += 1;
            }
        }
    }

    fn covered(&self, [low, high]: &[[f64; 2]; 2]) -> impl Iterator<Item = usize> + use<> {
        let index = |k: usize, x: f64| {
            (((x - self.lower[k]) * self.per_cell) as usize).min(self.cells[k] - 1)
        };
        let (columns, width) = (index(0, low[0])..=index(0, high[0]), self.cells[0]);
        let rows = index(1, low[1])..=index(1, high[1]);
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// Segments within `radius` of a point, ascending; `radius` at most the reach of the grid.
    pub fn near<'a>(
        &'a self,
        mesh: &'a SegmentMesh,
        point: [f64; 2],
        radius: f64,
    ) -> impl Iterator<Item = NearSegment> + 'a {
        debug_assert!(radius <= self.reach, "query beyond the reach of the grid");
        let candidates = self.cell(point).map_or(&[][..], |cell| {
            &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize]
        });
        candidates
            .iter()
            .map(|entry| NearSegment {
                segment: entry.segment as usize,
                image: entry.image,
            })
            .filter(move |near| {
                let [start, end] = mesh.seen_from(point, *near);
                distance_squared(start, end) < radius * radius
            })
    }

    fn cell(&self, point: [f64; 2]) -> Option<usize> {
        let x = (point[0] - self.lower[0]) * self.per_cell;
        let y = (point[1] - self.lower[1]) * self.per_cell;
        let within = x >= 0.0 && y >= 0.0;
        let (column, row) = (x as usize, y as usize);
        (within && column < self.cells[0] && row < self.cells[1])
            .then(|| row * self.cells[0] + column)
    }
}

/// Every image of every segment that comes near the box, with its bounds widened by the reach.
fn images(mesh: &SegmentMesh, reach: f64) -> Vec<(Entry, [[f64; 2]; 2])> {
    let domain = mesh.domain();
    let mut images = Vec::with_capacity(mesh.segments().len());
    for segment in 0..mesh.segments().len() {
        let [a, b] = mesh.ends(segment);
        let low = [0, 1].map(|k| a[k].min(b[k]));
        let high = [0, 1].map(|k| a[k].max(b[k]));
        for i in domain.images(0, low[0], high[0], 2.0 * reach) {
            for j in domain.images(1, low[1], high[1], 2.0 * reach) {
                let shift = domain.shift([i, j]);
                let low = [0, 1].map(|k| low[k] + shift[k] - reach);
                let high = [0, 1].map(|k| high[k] + shift[k] + reach);
                let entry = Entry {
                    segment: segment as u32,
                    image: [i, j],
                };
                images.push((entry, [low, high]));
            }
        }
    }
    images
}

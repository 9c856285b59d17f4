//! Points sorted by cell, so that every cell is one contiguous range.

use sph_core::Vect;

use crate::Domain;

/// Cells per search radius: smaller cells waste fewer candidates, more of them cost loops.
const CELLS_PER_RADIUS: usize = 2;

/// Input of the cells of a grid: the extent of the points and their number. If a process holds some of the points of
/// others, all of them number their cells alike when they take the extent of all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent<const D: usize> {
    /// Least and largest coordinates, m.
    pub corners: [Vect<D>; 2],
    /// Number of points.
    pub points: usize,
}

impl<const D: usize> Extent<D> {
    /// That of these points; those that are nowhere do not count.
    pub fn around(positions: &[Vect<D>]) -> Self {
        let mut finite = positions.iter().filter(|x| x.iter().all(|c| c.is_finite()));
        let first = finite.next().copied().unwrap_or_else(Vect::zeros);
        Extent {
            corners: finite.fold([first; 2], |[lower, upper], x| [lower.inf(x), upper.sup(x)]),
            points: positions.len(),
        }
    }
}

/// Cells along an axis.
#[derive(Clone, Copy, Debug, Default)]
struct CellAxis {
    lower: f64,
    inverse_width: f64,
    /// Cells of the whole extent.
    all: usize,
    /// The first of them that the grid has.
    first: usize,
    /// Number of cells that the grid has.
    count: usize,
    periodic: bool,
}

/// A regular grid over a set of points; row-major with the first axis fastest.
#[derive(Clone, Debug)]
pub struct CellGrid<const D: usize> {
    axes: [CellAxis; D],
    starts: Vec<u32>,
    points: Vec<u32>,
    sorted: bool,
    /// The cell of each point, and the next place in each cell: kept for their memory.
    cells: Vec<u32>,
    next: Vec<u32>,
}

impl<const D: usize> Default for CellGrid<D> {
    fn default() -> Self {
        CellGrid {
            axes: [CellAxis::default(); D],
            starts: Vec::new(),
            points: Vec::new(),
            sorted: true,
            cells: Vec::new(),
            next: Vec::new(),
        }
    }
}

impl<const D: usize> CellGrid<D> {
    /// Sorts points into cells at least `radius / 2` wide.
    ///
    /// Points outside the box count for the cell at its edge, which is still correct.
    pub fn new(positions: &[Vect<D>], radius: f64, domain: &Domain<D>) -> Self {
        let mut grid = Self::default();
        grid.renew(None, positions, radius, domain);
        grid
    }

    /// The same in the memory of this grid, with the cells of an extent of a larger set of points, if these are some of such:
    /// they come in the order that they have among all. Then only the cells around these points are held, along axes that
    /// are not periodic.
    pub fn renew(
        &mut self,
        among: Option<&Extent<D>>,
        positions: &[Vect<D>],
        radius: f64,
        domain: &Domain<D>,
    ) {
        let own = Extent::around(positions);
        self.cells(among.unwrap_or(&own), radius, domain);
        if among.is_some() {
            for axis in (0..D).filter(|a| !domain.periodic[*a]) {
                let [low, high] = own.corners.map(|x| self.coordinate(&x, axis));
                (self.axes[axis].first, self.axes[axis].count) = (low, high + 1 - low);
            }
        }
        self.sort(positions);
    }

    /// All cells of an extent, empty.
    fn cells(&mut self, extent: &Extent<D>, radius: f64, domain: &Domain<D>) {
        let [low, high] = &extent.corners;
        let lower = |a: usize| match domain.periodic[a] {
            true => domain.lower[a],
            false => low[a].max(domain.lower[a]),
        };
        let upper = |a: usize| match domain.periodic[a] {
            true => domain.upper[a],
            false => high[a].min(domain.upper[a]),
        };
        let side = |a: usize| (upper(a) - lower(a)).max(radius);
        // Cells number at most a few per point, however sparse the cloud is.
        let most = 4.0 * extent.points.max(16) as f64;
        let mut width = radius / CELLS_PER_RADIUS as f64;
        let along = |a: usize, width: f64| (side(a) / width).floor().max(1.0);
        while (0..D).map(|a| along(a, width)).product::<f64>() > most {
            width *= 1.5;
        }
        self.axes = std::array::from_fn(|axis| {
            let count = ((side(axis) / width) as usize).max(1);
            CellAxis {
                lower: lower(axis),
                inverse_width: count as f64 / side(axis),
                all: count,
                first: 0,
                count,
                periodic: domain.periodic[axis],
            }
        });
    }

    fn sort(&mut self, positions: &[Vect<D>]) {
        let mut cells = std::mem::take(&mut self.cells);
        cells.clear();
        cells.extend(positions.iter().map(|x| self.cell_of(x) as u32));
        let total: usize = self.axes.iter().map(|axis| axis.count).product();
        let starts = &mut self.starts;
        starts.clear();
        starts.resize(total + 1, 0);
        for &c in &cells {
            starts[c as usize + 1] += 1;
        }
        for c in 0..total {
            starts[c + 1] += starts[c];
        }
        self.sorted = cells.is_sorted();
        self.next.clone_from(starts);
        self.points.clear();
        self.points.resize(positions.len(), 0);
        for (i, &c) in cells.iter().enumerate() {
            let slot = &mut self.next[c as usize];
            self.points[*slot as usize] = i as u32;
            *slot += 1;
        }
        self.cells = cells;
    }

    /// The points in cell order: entry `k` is the index of the point at place `k`.
    pub fn order(&self) -> &[u32] {
        &self.points
    }

    /// Orders the points of each cell by their identities, so that the order does not depend on how they came.
    pub fn order_by(&mut self, identities: &[u32]) {
        let of = |point: &u32| identities[*point as usize];
        for cell in self.starts.windows(2) {
            let points = &mut self.points[cell[0] as usize..cell[1] as usize];
            if !points.is_sorted_by_key(of) {
                points.sort_unstable_by_key(of);
                self.sorted = false;
            }
        }
    }

    /// True if the points came in this order.
    pub fn is_sorted(&self) -> bool {
        self.sorted
    }

    fn coordinate(&self, x: &Vect<D>, axis: usize) -> usize {
        let along = &self.axes[axis];
        let mut c = (x[axis] - along.lower) * along.inverse_width;
        let n = along.all as f64;
        // Walls may lie across a periodic border; a rounding beyond it counts as within.
        if along.periodic && (c < 0.0 || c > n * (1.0 + 1e-12)) {
            c = c.rem_euclid(n);
        }
        // A negative or non-finite value casts to 0, a large one is clamped.
        let cell = (c as usize).min(along.all - 1);
        cell.saturating_sub(along.first).min(along.count - 1)
    }

    pub(crate) fn cell_of(&self, x: &Vect<D>) -> usize {
        (0..D).rev().fold(0, |cell, axis| {
            cell * self.axes[axis].count + self.coordinate(x, axis)
        })
    }

    /// Calls `visit` with ranges of places that together hold every point within `radius`; the same for all points of a cell.
    #[inline]
    pub fn ranges(&self, x: &Vect<D>, radius: f64, visit: impl FnMut(std::ops::Range<usize>)) {
        self.ranges_around([x, x], radius, visit);
    }

    /// The same for all points of a box with these two corners; the ranges ascend.
    #[inline]
    pub fn ranges_around(
        &self,
        corners: [&Vect<D>; 2],
        radius: f64,
        mut visit: impl FnMut(std::ops::Range<usize>),
    ) {
        // Axes that do not exist contribute the single cell 0.
        let spans: [_; 3] = std::array::from_fn(|axis| match axis < D {
            true => self.span(corners, radius, axis),
            false => [(0, 1), (0, 0)],
        });
        let count = |axis: usize| self.axes.get(axis).map_or(1, |axis| axis.count);
        for z_part in spans[2] {
            for z in z_part.0..z_part.1 {
                for y_part in spans[1] {
                    for y in y_part.0..y_part.1 {
                        let row = (z * count(1) + y) * count(0);
                        for (from, to) in spans[0] {
                            let [first, last] = [from, to].map(|k| self.starts[row + k] as usize);
                            if first < last {
                                visit(first..last);
                            }
                        }
                    }
                }
            }
        }
    }

    /// Leaves such ranges for all points of the box around some points.
    pub(crate) fn ranges_into(
        &self,
        points: &[Vect<D>],
        radius: f64,
        ranges: &mut Vec<std::ops::Range<usize>>,
    ) {
        let mut corners = [points[0]; 2];
        for x in points {
            corners = [corners[0].inf(x), corners[1].sup(x)];
        }
        ranges.clear();
        self.ranges_around(corners.each_ref(), radius, |range| ranges.push(range));
    }

    /// Half-open spans of cells along an axis, at most two where a period is crossed.
    fn span(&self, corners: [&Vect<D>; 2], radius: f64, axis: usize) -> [(usize, usize); 2] {
        let n = self.axes[axis].count;
        let reach = (radius * self.axes[axis].inverse_width)
            .ceil()
            .min(n as f64) as usize;
        let [low, high] = corners.map(|x| self.coordinate(x, axis));
        if !self.axes[axis].periodic {
            return [
                (low.saturating_sub(reach), (high + reach + 1).min(n)),
                (0, 0),
            ];
        }
        if high < low || high - low + 2 * reach + 1 >= n {
            return [(0, n), (0, 0)];
        }
        if low < reach {
            [(0, high + reach + 1), (n + low - reach, n)]
        } else if high + reach >= n {
            [(0, high + reach + 1 - n), (low - reach, n)]
        } else {
            [(low - reach, high + reach + 1), (0, 0)]
        }
    }
}

//! A uniform grid of grains.

use crate::grains::Vector;
use crate::grains::setup::Period;
use crate::groups::Groups;

/// Grains by cell; a cell is at least as long as the reach of a pair.
pub(crate) struct Grid {
    low: Vector,
    /// Cells per metre.
    rate: Vector,
    count: [usize; 3],
    periodic: [bool; 3],
    members: Groups,
}

impl Grid {
    pub fn new(positions: &[Vector], period: &Period, reach: f64) -> Self {
        let mut low = Vector::repeat(f64::INFINITY);
        let mut high = Vector::repeat(f64::NEG_INFINITY);
        for p in positions {
            low = low.inf(p);
            high = high.sup(p);
        }
        for (axis, ends) in period.iter().enumerate() {
            if let Some(ends) = ends {
                [low[axis], high[axis]] = *ends;
            }
        }
        // A grain that flew away must not cost memory: cells grow until there are few.
        let most = 8.0 * positions.len() as f64 + 64.0;
        let mut size = reach;
        let counts = loop {
            let counts = (high - low).map(|length| (length / size).floor().max(1.0));
            if counts.product() <= most {
                break counts;
            }
            size *= 1.26;
        };
        let mut grid = Self {
            low,
            rate: counts.zip_map(&(high - low), |n, length| match length > 0.0 {
                true => n / length,
                false => 0.0,
            }),
            count: [counts.x as usize, counts.y as usize, counts.z as usize],
            periodic: period.map(|p| p.is_some()),
            members: Groups::default(),
        };
        let numbers = positions.iter().map(|p| grid.number(grid.cell(p)) as u32);
        let cells: Vec<_> = numbers.zip(0..).collect();
        let count = grid.count.iter().product();
        grid.members = Groups::new(count, cells.into_iter());
        grid
    }

    fn cell(&self, p: &Vector) -> [usize; 3] {
        // A cast from a negative number or beyond the range saturates.
        std::array::from_fn(|k| {
            let along = ((p[k] - self.low[k]) * self.rate[k]) as usize;
            along.min(self.count[k] - 1)
        })
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    fn members(&self, cell: [usize; 3]) -> &[u32] {
        self.members.of(self.number(cell))
    }

    /// Cells on an axis around one, each once.
    fn span(&self, axis: usize, at: usize) -> ([usize; 3], usize) {
        let n = self.count[axis];
        if self.periodic[axis] && n >= 3 {
            return ([(at + n - 1) % n, at, (at + 1) % n], 3);
        }
        let from = at.saturating_sub(1);
        let to = (at + 1).min(n - 1);
        ([from, from + 1, from + 2], to - from + 1)
    }

    /// Calls `visit` for every grain in the cell of a point and in those around it.
    pub fn around(&self, point: &Vector, mut visit: impl FnMut(u32)) {
        let at = self.cell(point);
        let spans: [_; 3] = std::array::from_fn(|axis| self.span(axis, at[axis]));
        let [xs, ys, zs] = spans.each_ref().map(|(cells, count)| &cells[..*count]);
        for &z in zs {
            for &y in ys {
                for &x in xs {
                    self.members([x, y, z]).iter().copied().for_each(&mut visit);
                }
            }
        }
    }

    /// Calls `visit` for every grain in the cells that a box touches.
    pub fn within(&self, low: &Vector, high: &Vector, mut visit: impl FnMut(u32)) {
        let (from, to) = (self.cell(low), self.cell(high));
        for z in from[2]..=to[2] {
            for y in from[1]..=to[1] {
                for x in from[0]..=to[0] {
                    self.members([x, y, z]).iter().copied().for_each(&mut visit);
                }
            }
        }
    }
}

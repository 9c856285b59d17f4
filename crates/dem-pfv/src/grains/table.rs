//! The state of a system of grains, and its table of neighbours: pairs, grains at walls and at triangles.

use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sparse::Groups;
use sph_core::bounds;

use crate::grains::{Grains, MEMORY, Mesh, Period, Vector, Wall, nearest, separation};

/// Two bodies that are near each other.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
pub(crate) struct Slot {
    pub first: u32,
    /// A grain, or a triangle, or nothing at a wall.
    pub second: u32,
    /// True if they touch.
    pub active: bool,
    pub overlap: f64,
    pub normal: Vector,
    pub memory: [f64; MEMORY],
    /// On the first.
    pub force: Vector,
    /// On the first and on the second.
    pub torque: [Vector; 2],
}

impl Slot {
    fn new(first: u32, second: u32) -> Self {
        Self {
            first,
            second,
            ..Self::default()
        }
    }

    fn key(&self) -> (u32, u32) {
        (self.first, self.second)
    }
}

/// All slots: pairs first, then wall by wall, then mesh by mesh, each part in the order of the grains' numbers.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(crate) struct Table {
    pub slots: Vec<Slot>,
    /// Ends of the parts.
    pub ends: Vec<usize>,
    /// Slots of each grain, twice their number plus the side.
    #[serde(skip)]
    entries: Groups,
    /// Positions and shapes at the time the table was made.
    #[serde(skip)]
    then: PreviousState,
}

/// The pairs in contact alone: enough to go on from.
impl Clone for Table {
    fn clone(&self) -> Self {
        let mut kept = Self::default();
        for part in 0..self.ends.len() {
            let slots = &self.slots[self.part(part)];
            kept.slots.extend(slots.iter().filter(|s| s.active));
            kept.ends.push(kept.slots.len());
        }
        kept
    }
}

#[derive(Debug, Default)]
struct PreviousState {
    positions: Vec<Vector>,
    radii: Vec<f64>,
    walls: Vec<Vector>,
    vertices: Vec<Vec<Vector>>,
}

/// A step and the grain that sets it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Limit {
    pub step: f64,
    pub grain: usize,
}

/// Everything a run needs to go on bit for bit, but for the contact laws: columns of the grains, walls,
/// meshes, and the memory of contacts. For any serde format that keeps every bit of a number.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct State {
    /// The grains; the next evaluation finds the contacts of those that were moved.
    pub grains: Grains,
    /// The walls.
    pub walls: Vec<Wall>,
    /// The meshes.
    pub meshes: Vec<Mesh>,
    /// Axes along which the box repeats itself.
    pub period: Period,
    /// Gravity, m/s².
    pub gravity: Vector,
    pub(crate) damping: f64,
    pub(crate) skin: f64,
    /// Time, s.
    pub time: f64,
    /// Steps made.
    pub steps: u64,
    /// Motion since the last evaluation, s.
    pub(crate) last_step: f64,
    pub(crate) limit: Option<Limit>,
    /// Step at which the limit is found anew.
    pub(crate) limit_due: u64,
    #[serde(rename = "contacts")]
    pub(crate) table: Table,
    /// Number of times that the lists of neighbours were made.
    pub renewals: u64,
}

/// Grains per task when lists are made.
const TASK: usize = 256;

impl Table {
    pub fn part(&self, number: usize) -> Range<usize> {
        let before = number.checked_sub(1);
        before.map_or(0, |before| self.ends[before])..self.ends[number]
    }

    /// The slots of every part.
    pub fn parts(&mut self) -> impl Iterator<Item = &mut [Slot]> {
        let (mut rest, mut taken) = (&mut self.slots[..], 0);
        self.ends.iter().map(move |&end| {
            let (part, after) = std::mem::take(&mut rest).split_at_mut(end - taken);
            (rest, taken) = (after, end);
            part
        })
    }

    /// Slots of a grain with the side it has in each: 0 for the first body, 1 for the second.
    pub fn slots_of(&self, grain: usize) -> impl Iterator<Item = (&Slot, usize)> {
        let entries = self.entries.members(grain).iter();
        entries.map(|&entry| (&self.slots[(entry >> 1) as usize], (entry & 1) as usize))
    }

    /// Both tables are sorted, so one walk along them finds the common entries.
    fn carry(&mut self, old: &Self) {
        for (part, new) in self.parts().enumerate().take(old.ends.len()) {
            let mut new = new.iter_mut().peekable();
            for slot in old.slots[old.part(part)].iter().filter(|s| s.active) {
                while new.next_if(|n| n.key() < slot.key()).is_some() {}
                if let Some(n) = new.next_if(|n| n.key() == slot.key()) {
                    *n = *slot;
                }
            }
        }
    }
}

impl State {
    /// True if something may have come near that is not in the table.
    pub(crate) fn expired(&self) -> bool {
        let (then, grains) = (&self.table.then, &self.grains);
        if then.positions.len() != grains.len() || then.walls.len() != self.walls.len() {
            return true;
        }
        let half = 0.5 * self.skin;
        let moved = |wall: &Wall, point: &Vector| (wall.point - point).dot(&wall.normal).abs();
        let mut walls = self.walls.iter().zip(&then.walls);
        if walls.any(|(wall, point)| moved(wall, point) > half) {
            return true;
        }
        for (mesh, old) in self.meshes.iter().zip(&then.vertices) {
            let mut vertices = mesh.vertices.iter().zip(old);
            if vertices.any(|(new, old)| (new - old).norm_squared() > half * half) {
                return true;
            }
        }
        let left = |i: usize| {
            let room = half - (grains.radius[i] - then.radii[i]);
            let way = separation(&grains.position[i], &then.positions[i], &self.period);
            room < 0.0 || way.norm_squared() > room * room
        };
        let all = (0..grains.len()).into_par_iter();
        all.with_min_len(2048).any(left)
    }

    /// Makes the table anew; contacts keep their memory.
    pub(crate) fn renew(&mut self) {
        let (grains, skin) = (&self.grains, self.skin);
        let reach = 2.0 * grains.largest_radius() + skin;
        let grid = Grid::new(&grains.position, &self.period, reach);
        let mut new = Table {
            slots: self.pairs(&grid),
            ..Table::default()
        };
        let pairs = new.slots.len();
        new.ends.push(pairs);
        for wall in &self.walls {
            let near = |&i: &usize| wall.distance(&grains.position[i]) < grains.radius[i] + skin;
            let near = (0..grains.len()).filter(near);
            new.slots.extend(near.map(|i| Slot::new(i as u32, 0)));
            new.ends.push(new.slots.len());
        }
        for mesh in &self.meshes {
            new.slots.extend(self.triangles(&grid, mesh));
            new.ends.push(new.slots.len());
        }
        new.carry(&self.table);
        let entries = new.slots.iter().enumerate().flat_map(|(k, slot)| {
            let second = (k < pairs).then_some((slot.second, 2 * k as u32 + 1));
            [Some((slot.first, 2 * k as u32)), second]
        });
        new.entries = Groups::new(grains.len(), entries.flatten());
        new.then = PreviousState {
            positions: grains.position.clone(),
            radii: grains.radius.clone(),
            walls: self.walls.iter().map(|w| w.point).collect(),
            vertices: self.meshes.iter().map(|m| m.vertices.clone()).collect(),
        };
        self.table = new;
        self.renewals += 1;
    }

    fn pairs(&self, grid: &Grid) -> Vec<Slot> {
        let (grains, n) = (&self.grains, self.grains.len());
        let task = |task: usize| {
            let mut slots = Vec::with_capacity(8 * TASK);
            let mut partners = Vec::new();
            for i in task * TASK..n.min((task + 1) * TASK) {
                let (at, radius) = (grains.position[i], grains.radius[i] + self.skin);
                partners.clear();
                grid.around(&at, |j| {
                    let reach = radius + grains.radius[j as usize];
                    let apart = || separation(&at, &grains.position[j as usize], &self.period);
                    if j as usize > i && apart().norm_squared() < reach * reach {
                        partners.push(j);
                    }
                });
                partners.sort_unstable();
                slots.extend(partners.iter().map(|&j| Slot::new(i as u32, j)));
            }
            slots
        };
        let tasks = (0..n.div_ceil(TASK)).into_par_iter().map(task);
        tasks.collect::<Vec<_>>().concat()
    }

    fn triangles(&self, grid: &Grid, mesh: &Mesh) -> impl Iterator<Item = Slot> {
        let (grains, largest) = (&self.grains, self.grains.largest_radius());
        let found = (0..mesh.triangles.len()).into_par_iter().map(|t| {
            let corners = mesh.corners(t);
            let reach = Vector::repeat(largest + self.skin);
            let low = corners[0].inf(&corners[1]).inf(&corners[2]) - reach;
            let high = corners[0].sup(&corners[1]).sup(&corners[2]) + reach;
            let mut near = Vec::new();
            grid.within(&low, &high, |i| {
                let at = &grains.position[i as usize];
                let reach = grains.radius[i as usize] + self.skin;
                if (nearest(at, corners) - at).norm_squared() < reach * reach {
                    near.push((i, t as u32));
                }
            });
            near
        });
        let mut keys = found.collect::<Vec<_>>().concat();
        keys.sort_unstable();
        keys.into_iter().map(|(i, t)| Slot::new(i, t))
    }
}

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
        let points = positions.iter().map(|p| (*p).into());
        let [mut low, mut high] = bounds(points).map(Vector::from);
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
        let per_length = |n: f64, length: f64| if length > 0.0 { n / length } else { 0.0 };
        let mut grid = Self {
            low,
            rate: counts.zip_map(&(high - low), per_length),
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
        self.members.members(self.number(cell))
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

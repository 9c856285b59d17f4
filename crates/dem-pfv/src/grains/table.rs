//! The table of neighbours: a grid of grains, pairs, grains at walls, grains at triangles, the memory of contacts.

use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::grains::{Grains, MEMORY, Mesh, Period, Vector, Wall, nearest, separation};
use crate::groups::Groups;

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

/// Input of the table.
#[derive(Clone, Copy)]
pub(crate) struct Bodies<'a> {
    pub grains: &'a Grains,
    pub walls: &'a [Wall],
    pub meshes: &'a [Mesh],
    pub period: &'a Period,
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

    /// True if something may have come near that is not in the table.
    pub fn expired(&self, bodies: Bodies<'_>, skin: f64) -> bool {
        let (then, grains) = (&self.then, bodies.grains);
        if then.positions.len() != grains.len() || then.walls.len() != bodies.walls.len() {
            return true;
        }
        let half = 0.5 * skin;
        let moved = |wall: &Wall, point: &Vector| (wall.point - point).dot(&wall.normal).abs();
        let mut walls = bodies.walls.iter().zip(&then.walls);
        if walls.any(|(wall, point)| moved(wall, point) > half) {
            return true;
        }
        for (mesh, old) in bodies.meshes.iter().zip(&then.vertices) {
            let mut vertices = mesh.vertices.iter().zip(old);
            if vertices.any(|(new, old)| (new - old).norm_squared() > half * half) {
                return true;
            }
        }
        let left = |i: usize| {
            let room = half - (grains.radius[i] - then.radii[i]);
            let way = separation(&grains.position[i], &then.positions[i], bodies.period);
            room < 0.0 || way.norm_squared() > room * room
        };
        let all = (0..grains.len()).into_par_iter();
        all.with_min_len(2048).any(left)
    }

    /// Makes the table anew; contacts keep their memory.
    pub fn renew(&mut self, bodies: Bodies<'_>, skin: f64) {
        let (grains, period) = (bodies.grains, bodies.period);
        let largest = grains.largest_radius();
        let grid = Grid::new(&grains.position, period, 2.0 * largest + skin);
        let mut slots = pairs(grains, &grid, period, skin);
        let mut ends = vec![slots.len()];
        for wall in bodies.walls {
            let near = |&i: &usize| wall.distance(&grains.position[i]) < grains.radius[i] + skin;
            let near = (0..grains.len()).filter(near);
            slots.extend(near.map(|i| Slot::new(i as u32, 0)));
            ends.push(slots.len());
        }
        for mesh in bodies.meshes {
            slots.extend(triangles(grains, &grid, mesh, largest, skin));
            ends.push(slots.len());
        }
        let old = std::mem::replace(&mut self.slots, slots);
        let old_ends = std::mem::replace(&mut self.ends, ends);
        self.carry(&old, &old_ends);
        let pairs = self.part(0).end;
        let entries = self.slots.iter().enumerate().flat_map(|(k, slot)| {
            let second = (k < pairs).then_some((slot.second, 2 * k as u32 + 1));
            [Some((slot.first, 2 * k as u32)), second]
        });
        self.entries = Groups::new(grains.len(), entries.flatten());
        self.then = PreviousState {
            positions: grains.position.clone(),
            radii: grains.radius.clone(),
            walls: bodies.walls.iter().map(|w| w.point).collect(),
            vertices: bodies.meshes.iter().map(|m| m.vertices.clone()).collect(),
        };
    }

    /// Both tables are sorted, so one walk along them finds the common entries.
    fn carry(&mut self, old: &[Slot], old_ends: &[usize]) {
        let mut from = 0;
        for (part, &to) in old_ends.iter().enumerate().take(self.ends.len()) {
            let range = self.part(part);
            let mut new = self.slots[range].iter_mut().peekable();
            for slot in old[from..to].iter().filter(|s| s.active) {
                while new.next_if(|n| n.key() < slot.key()).is_some() {}
                if let Some(n) = new.next_if(|n| n.key() == slot.key()) {
                    *n = *slot;
                }
            }
            from = to;
        }
    }
}

fn pairs(grains: &Grains, grid: &Grid, period: &Period, skin: f64) -> Vec<Slot> {
    let n = grains.len();
    let task = |task: usize| {
        let mut slots = Vec::with_capacity(8 * TASK);
        let mut partners = Vec::new();
        for i in task * TASK..n.min((task + 1) * TASK) {
            let (at, radius) = (grains.position[i], grains.radius[i] + skin);
            partners.clear();
            grid.around(&at, |j| {
                let reach = radius + grains.radius[j as usize];
                let apart = || separation(&at, &grains.position[j as usize], period);
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

fn triangles(
    grains: &Grains,
    grid: &Grid,
    mesh: &Mesh,
    largest: f64,
    skin: f64,
) -> impl Iterator<Item = Slot> {
    let found = (0..mesh.triangles.len()).into_par_iter().map(|t| {
        let corners = mesh.corners(t);
        let reach = Vector::repeat(largest + skin);
        let low = corners[0].inf(&corners[1]).inf(&corners[2]) - reach;
        let high = corners[0].sup(&corners[1]).sup(&corners[2]) + reach;
        let mut near = Vec::new();
        grid.within(&low, &high, |i| {
            let at = &grains.position[i as usize];
            let reach = grains.radius[i as usize] + skin;
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

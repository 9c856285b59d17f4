//! s of walls of any shape, on a grid.

use std::collections::BTreeSet;

use rayon::prelude::*;
use sph_core::{Vect, bounds};
use sph_kernels::Sampler;
use sph_neighbours::Domain;

use crate::scale::flat::{REACH, fade, unrolled};
use crate::scale::spline::{Grid, interpolate, value};
use crate::{BoundaryError, Result, SeenElement, WallMesh};

/// Nodes of the grid per smoothing length.
const NODES: f64 = 4.0;
/// Layers of nodes behind the wall that are solved for.
const BEHIND: f64 = 6.0;
/// Lumps of a cell that the wall cuts, and samples of each lump, along every axis.
const LUMPS: usize = 2;
const SAMPLES: usize = 4;
/// Share of ln s + ln ∫ s w that a sweep takes off. Its error falls by 1 − ω (1 + λ), λ from 0 (rough) to 1 (smooth): to a
/// third at most.
const RELAXATION: f64 = 2.0 / 3.0;
const SWEEPS: usize = 40;
/// Largest change of ln s after which no further sweep is made.
const TOLERANCE: f64 = 1e-5;
const MOST_NODES: usize = 20_000_000;

/// ln s of walls less that of their flat faces, as a cubic spline.
#[derive(Debug)]
pub(crate) struct ScaleMap<const D: usize> {
    grid: Grid<D>,
    coefficients: Vec<f64>,
    /// Marks of cells, by their first node, with anything.
    known: Vec<bool>,
    /// The curved wall that is nearest to every node; empty if there is one.
    nearest: Vec<u32>,
    /// The walls with curved elements, ascending.
    walls: Vec<u32>,
}

pub(crate) struct Mapping<'a, const D: usize, M: WallMesh<D>> {
    /// The walls, where they were drawn.
    pub mesh: &'a M,
    /// Elements that are on no flat face.
    pub curved: &'a [bool],
    /// ln s of the flat faces at a place.
    pub flat: &'a (dyn Fn(&Vect<D>) -> f64 + Sync),
    /// Least height over the flat faces, m.
    pub over_flat: &'a (dyn Fn(&Vect<D>) -> f64 + Sync),
    pub kernel: &'a dyn Sampler,
    pub domain: &'a Domain<D>,
    pub wall: &'a str,
}

/// A part of a cell that a wall cuts.
#[derive(Clone, Copy)]
struct Lump<const D: usize> {
    place: Vect<D>,
    volume: f64,
}

/// Nodes and cells of a map that is being made.
struct Cells<const D: usize> {
    /// ln s of the flat faces.
    flat: Vec<f64>,
    /// Marks of cells, by the node they surround, that are all fluid.
    whole: Vec<bool>,
    /// First lump of the cell around each node, and the end.
    first_lump: Vec<u32>,
    lumps: Vec<Lump<D>>,
    /// ln s of the flat faces at the lumps.
    flat_at_lumps: Vec<f64>,
    /// The curved wall that is nearest to every node, on request.
    nearest: Vec<u32>,
    /// Nodes that are solved for, with the share of their value that counts.
    active: Vec<(usize, f64)>,
}

impl<const D: usize> ScaleMap<D> {
    /// Solves s(x) ∫ s w = 1 by ln s ← ln s − ω ln (s ∫ s w) on the nodes near the curved elements; cells that the wall cuts
    /// are sampled.
    ///
    /// # Errors
    /// If the grid would have too many nodes.
    pub fn new<M: WallMesh<D>>(of: &Mapping<'_, D, M>) -> Result<Self> {
        let (h, step) = (of.kernel.smoothing_length(), of.step());
        let nodes = of.mesh.places();
        let curved = || {
            let elements = of.mesh.elements().iter().zip(of.curved);
            elements.filter(|(_, curved)| **curved).map(|(e, _)| e)
        };
        let corners = curved().flat_map(|e| unrolled(e, &nodes, of.domain));
        let [low, high] = bounds(corners.map(|x| x.into())).map(Vect::from);
        // All that an active node sees is on the grid.
        let margin = REACH * h + of.kernel.support_radius() + 4.0 * step;
        let grid = Grid::around(low.add_scalar(-margin), high.add_scalar(margin), step);
        let count: f64 = grid.nodes.iter().map(|n| *n as f64).product();
        if count > MOST_NODES as f64 {
            let why = format!(
                "needs a map of {count} nodes, and {MOST_NODES} are the most: take `walls.usaw`, or larger particles"
            );
            return Err(BoundaryError::unfit(of.wall, why));
        }
        let walls: BTreeSet<u32> = curved().map(|e| e.wall as u32).collect();
        let walls: Vec<u32> = walls.into_iter().collect();
        let cells = Cells::from_elements((&grid, [low, high]), of, walls.len() > 1);
        let mut correction = vec![0.0; grid.len()];
        for sweep in 0..=SWEEPS {
            let sums = cells.sums(&grid, of.kernel, &correction);
            let all = cells.active.iter().zip(sums);
            let mut largest = 0.0_f64;
            let mut next = vec![0.0; grid.len()];
            for ((node, _), sum) in all {
                let whole = cells.flat[*node] + correction[*node];
                let change = -RELAXATION * (whole + sum.max(f64::MIN_POSITIVE).ln());
                largest = largest.max(change.abs());
                next[*node] = correction[*node] + change;
            }
            correction = next;
            if largest < TOLERANCE || sweep == SWEEPS {
                break;
            }
        }
        let mut counts = vec![0.0; grid.len()];
        for (node, share) in &cells.active {
            counts[*node] = share * correction[*node];
        }
        let strides = grid.strides();
        let corner = |node: usize, n: usize| {
            let steps = (0..D).map(|k| (n >> k & 1) * strides[k]);
            counts.get(node + steps.sum::<usize>())
        };
        let known = |node: usize| (0..1 << D).any(|n| corner(node, n).is_some_and(|c| *c != 0.0));
        let known = (0..grid.len()).map(known).collect();
        interpolate(&grid, &mut counts);
        Ok(ScaleMap {
            grid,
            coefficients: counts,
            known,
            nearest: cells.nearest,
            walls,
        })
    }

    /// ln s less that of the flat faces, its gradient, 1/m, and the wall with curved elements that has it; none where there
    /// is nothing.
    pub fn at(&self, x: &Vect<D>) -> Option<(f64, Vect<D>, u32)> {
        let node = self.grid.node_before(x).filter(|node| self.known[*node])?;
        let (value, gradient) = value(&self.grid, &self.coefficients, x)?;
        let wall = self.nearest.get(node).copied().unwrap_or(self.walls[0]);
        Some((value, gradient, wall))
    }

    pub fn middle(&self) -> Vect<D> {
        let half = |k: usize| 0.5 * (self.grid.nodes[k] - 1) as f64 * self.grid.step;
        self.grid.low + Vect::from_fn(|k, _| half(k))
    }
}

struct NodeKind<const D: usize> {
    /// Distance from the walls, m, negative behind them.
    height: f64,
    /// Distance from the nearest curved element, m.
    from_curved: f64,
    lumps: Vec<Lump<D>>,
    /// The wall of that element, on request.
    nearest: u32,
}

impl<const D: usize> Cells<D> {
    /// Of a grid around the box of the curved elements.
    fn from_elements<M: WallMesh<D>>(
        (grid, [low, high]): (&Grid<D>, [Vect<D>; 2]),
        of: &Mapping<'_, D, M>,
        several: bool,
    ) -> Self {
        let h = of.kernel.smoothing_length();
        let nodes = (0..grid.len()).into_par_iter().with_min_len(256);
        let kind = |n: usize| {
            let x = grid.place(n);
            let outside = (low - x).sup(&(x - high)).sup(&Vect::zeros());
            match outside.norm() < REACH * h {
                true => of.near_node(&x, several),
                false => of.far_node(&x),
            }
        };
        let kinds: Vec<NodeKind<D>> = nodes.map(kind).collect();
        let flat = (0..grid.len()).into_par_iter().with_min_len(1024);
        let mut cells = Cells {
            flat: flat.map(|n| (of.flat)(&grid.place(n))).collect(),
            whole: Vec::with_capacity(kinds.len()),
            first_lump: vec![0],
            lumps: Vec::new(),
            flat_at_lumps: Vec::new(),
            nearest: Vec::new(),
            active: Vec::new(),
        };
        let cut = half_diagonal::<D>(grid.step);
        for (n, kind) in kinds.into_iter().enumerate() {
            cells.whole.push(kind.height > cut);
            if several {
                cells.nearest.push(kind.nearest);
            }
            cells.lumps.extend(kind.lumps);
            cells.first_lump.push(cells.lumps.len() as u32);
            if kind.from_curved < REACH * h && kind.height > -BEHIND * grid.step {
                let [share, _] = fade((kind.from_curved / h - REACH + 0.5) / 0.5);
                cells.active.push((n, share));
            }
        }
        cells.flat_at_lumps = cells.lumps.iter().map(|l| (of.flat)(&l.place)).collect();
        cells
    }

    /// ∫ s w at every active node.
    fn sums(&self, grid: &Grid<D>, kernel: &dyn Sampler, correction: &[f64]) -> Vec<f64> {
        let mut coefficients = correction.to_vec();
        interpolate(grid, &mut coefficients);
        let cell = grid.step.powi(D as i32);
        let nodes = self.flat.par_iter().zip(correction).zip(&self.whole);
        let in_cell = |((flat, more), whole): ((&f64, &f64), &bool)| match whole {
            true => cell * (flat + more).exp(),
            false => 0.0,
        };
        let in_cells: Vec<f64> = nodes.map(in_cell).collect();
        let lumps = self.lumps.par_iter().zip(&self.flat_at_lumps);
        let in_lump = |(lump, flat): (&Lump<D>, &f64)| {
            let more = value(grid, &coefficients, &lump.place).map_or(0.0, |(v, _)| v);
            lump.volume * (flat + more).exp()
        };
        let in_lumps: Vec<f64> = lumps.map(in_lump).collect();
        let rows = rows(grid, kernel);
        let one = |[distances, values]: &mut [Vec<f64>; 2], (node, _): &(usize, f64)| {
            let x = grid.place(*node);
            let mut sum = 0.0;
            for (offset, weights) in &rows {
                let from = node.wrapping_add_signed(*offset);
                let to = from + weights.len();
                let own = in_cells[from..to].iter().zip(weights);
                sum += own.map(|(v, w)| v * w).sum::<f64>();
                let lumps = self.first_lump[from] as usize..self.first_lump[to] as usize;
                if !lumps.is_empty() {
                    distances.clear();
                    let own = self.lumps[lumps.clone()].iter();
                    distances.extend(own.map(|lump| (lump.place - x).norm_squared()));
                    values.resize(distances.len(), 0.0);
                    kernel.value(distances, values);
                    let own = values.iter().zip(&in_lumps[lumps]);
                    sum += own.map(|(w, part)| w * part).sum::<f64>();
                }
            }
            sum
        };
        let active = self.active.par_iter().with_min_len(64);
        active.map_init(Default::default, one).collect()
    }
}

/// Rows of nodes within a support and a cell of a node: where each begins, and the kernel values of its nodes.
fn rows<const D: usize>(grid: &Grid<D>, kernel: &dyn Sampler) -> Vec<(isize, Vec<f64>)> {
    let far = kernel.support_radius() + grid.step;
    let reach = (far / grid.step).floor() as isize;
    let (side, strides) = (2 * reach + 1, grid.strides());
    let one = |n: isize| {
        let number = |k: usize| n / side.pow(k as u32 - 1) % side - reach;
        let across: f64 = (1..D).map(|k| (number(k) as f64 * grid.step).powi(2)).sum();
        let half = ((far * far - across).sqrt() / grid.step).floor() as isize;
        if half < 0 || across > far * far {
            return None;
        }
        let offset: isize = (1..D).map(|k| number(k) * strides[k] as isize).sum();
        let distance = |i: isize| (across + (i as f64 * grid.step).powi(2)).sqrt();
        let weights = (-half..=half).map(|i| kernel.at(distance(i)).0);
        Some((offset - half, weights.collect()))
    };
    (0..side.pow(D as u32 - 1)).filter_map(one).collect()
}

impl<const D: usize, M: WallMesh<D>> Mapping<'_, D, M> {
    /// Distance of nodes, m.
    fn step(&self) -> f64 {
        self.kernel.smoothing_length() / NODES
    }

    /// A node too far from curved elements to have a value: of the flat faces alone.
    fn far_node(&self, x: &Vect<D>) -> NodeKind<D> {
        let height = (self.over_flat)(x);
        NodeKind {
            height,
            from_curved: f64::INFINITY,
            lumps: self.lumps(x, height, |at| (self.over_flat)(&(x + at))),
            nearest: 0,
        }
    }

    fn near_node(&self, x: &Vect<D>, several: bool) -> NodeKind<D> {
        let reach = (REACH + 0.5) * self.kernel.smoothing_length();
        // The mesh takes places in the box.
        let place = self.domain.wrapped(*x);
        let near = self.mesh.near(&place, reach);
        let curved = near.iter().filter(|n| self.curved[n.index()]);
        let walls: Vec<usize> = match several {
            true => curved.clone().map(|n| self.mesh.wall_of(*n)).collect(),
            false => Vec::new(),
        };
        let curved = self.mesh.seen(&place, curved);
        let distance = |k: usize| {
            let only = std::slice::from_ref(&curved[k]);
            SeenElement::signed_distance(only, [0.0; D], reach).map_or(f64::INFINITY, f64::abs)
        };
        let nearest = (0..walls.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        let seen = self.mesh.seen(&place, &near);
        let from_curved = SeenElement::signed_distance(&curved, [0.0; D], reach);
        let height = SeenElement::signed_distance(&seen, [0.0; D], reach);
        let height = height.unwrap_or_else(|| match self.mesh.contains(&place) {
            true => f64::INFINITY,
            false => f64::NEG_INFINITY,
        });
        NodeKind {
            height,
            from_curved: from_curved.map_or(f64::INFINITY, f64::abs),
            lumps: self.lumps(x, height, |at| {
                SeenElement::signed_distance(&seen, (*at).into(), reach).unwrap_or(0.0)
            }),
            nearest: nearest.map_or(0, |k| walls[k] as u32),
        }
    }

    /// The lumps of the cell around a node at a height over the walls, if they cut it; `height_at` is that of a place
    /// relative to the node, m.
    fn lumps(&self, x: &Vect<D>, height: f64, height_at: impl Fn(&Vect<D>) -> f64) -> Vec<Lump<D>> {
        let (step, mut lumps) = (self.step(), Vec::new());
        if height.abs() > half_diagonal::<D>(step) {
            return lumps;
        }
        let size = step / (LUMPS * SAMPLES) as f64;
        let place = |n: usize, base: usize, k: usize| n / base.pow(k as u32) % base;
        for l in 0..LUMPS.pow(D as u32) {
            let (mut volume, mut moment) = (0.0, Vect::<D>::zeros());
            for s in 0..SAMPLES.pow(D as u32) {
                let at = Vect::<D>::from_fn(|k, _| {
                    let number = place(l, LUMPS, k) * SAMPLES + place(s, SAMPLES, k);
                    (number as f64 + 0.5) * size - 0.5 * step
                });
                // The share of a sample that is fluid, to first order in its distance.
                let part = (height_at(&at) / size + 0.5).clamp(0.0, 1.0) * size.powi(D as i32);
                volume += part;
                moment += at * part;
            }
            if volume > 0.0 {
                let place = x + moment / volume;
                lumps.push(Lump { place, volume });
            }
        }
        lumps
    }
}

fn half_diagonal<const D: usize>(step: f64) -> f64 {
    0.5 * (D as f64).sqrt() * step
}

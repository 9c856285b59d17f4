//! Topology of facets: openings, and facets that face the other way.

use std::collections::HashMap;

use crate::surface::facets::{Facets, bounds};
use crate::surface::vector::{dot, minus};

/// Edges that hang together and have a facet on one side only.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Number of edges around it.
    pub edges: usize,
    /// Mean of their middles, m.
    pub centre: [f64; 3],
    /// Diagonal of the box around it, m.
    pub size: f64,
}

/// Topology of the facets of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Topology {
    /// The openings, the largest first.
    pub openings: Vec<Opening>,
    /// Facets, counted from 0, that face the other way than most of those they hang together with, by area.
    pub flipped: Vec<usize>,
    /// Edges in which more than two facets meet.
    pub crowded: usize,
    /// Pieces that do not hang together.
    pub parts: usize,
}

/// An edge of a facet, whichever way it is travelled.
#[derive(Clone, Copy)]
struct DirectedEdge {
    ends: [u32; 2],
    facet: u32,
    forward: bool,
}

/// The facet beyond each edge of a facet, and whether the two run along the edge in one direction: they face different
/// ways.
type EdgeNeighbours = Vec<Vec<(u32, bool)>>;

impl Facets {
    /// Topology of the facets.
    pub fn topology(&self) -> Topology {
        let mut halves = Vec::with_capacity(3 * self.triangles.len());
        for (facet, [a, b, c]) in (0..).zip(&self.triangles) {
            halves.extend([(a, b), (b, c), (c, a)].map(|(a, b)| DirectedEdge {
                ends: [*a.min(b), *a.max(b)],
                facet,
                forward: a < b,
            }));
        }
        halves.sort_unstable_by_key(|h| (h.ends, h.facet));
        let mut beside: EdgeNeighbours = vec![Vec::new(); self.triangles.len()];
        let (mut loose, mut crowded) = (Vec::new(), 0);
        for run in halves.chunk_by(|a, b| a.ends == b.ends) {
            match run {
                [one] => loose.push(one.ends),
                [a, b] => {
                    let against = a.forward == b.forward;
                    beside[a.facet as usize].push((b.facet, against));
                    beside[b.facet as usize].push((a.facet, against));
                }
                _ => crowded += 1,
            }
        }
        let (flipped, parts) = self.flipped_facets(&beside);
        Topology {
            openings: self.openings(&loose),
            flipped,
            crowded,
            parts,
        }
    }

    /// Facets against most of their piece, and the number of pieces.
    fn flipped_facets(&self, beside: &EdgeNeighbours) -> (Vec<usize>, usize) {
        let areas: Vec<f64> = self.areas().collect();
        let mut turned: Vec<Option<bool>> = vec![None; areas.len()];
        let (mut flipped, mut parts) = (Vec::new(), 0);
        for seed in 0..areas.len() {
            if turned[seed].is_some() {
                continue;
            }
            parts += 1;
            turned[seed] = Some(false);
            let mut piece = vec![seed];
            let mut next = 0;
            while let Some(&facet) = piece.get(next) {
                next += 1;
                for &(other, against) in &beside[facet] {
                    let other = other as usize;
                    if turned[other].is_none() {
                        turned[other] = Some((turned[facet] == Some(true)) != against);
                        piece.push(other);
                    }
                }
            }
            let area = |way| {
                let of = piece.iter().filter(|f| turned[**f] == Some(way));
                of.map(|f| areas[*f]).sum::<f64>()
            };
            let fewer = area(true) <= area(false);
            flipped.extend(piece.iter().filter(|f| turned[**f] == Some(fewer)));
        }
        flipped.sort_unstable();
        (flipped, parts)
    }

    /// The same surface with some facets turned round.
    pub fn turned(mut self, facets: &[usize]) -> Self {
        for facet in facets {
            self.triangles[*facet].swap(1, 2);
        }
        self
    }

    /// Joins loose edges that share a point.
    fn openings(&self, loose: &[[u32; 2]]) -> Vec<Opening> {
        let mut at: HashMap<u32, Vec<usize>> = HashMap::new();
        for (e, ends) in loose.iter().enumerate() {
            ends.iter().for_each(|p| at.entry(*p).or_default().push(e));
        }
        let mut reached = vec![false; loose.len()];
        let mut openings = Vec::new();
        for first in 0..loose.len() {
            if reached[first] {
                continue;
            }
            reached[first] = true;
            let mut edges = vec![first];
            let mut next = 0;
            while let Some(&edge) = edges.get(next) {
                next += 1;
                for other in loose[edge].iter().flat_map(|p| &at[p]) {
                    if !std::mem::replace(&mut reached[*other], true) {
                        edges.push(*other);
                    }
                }
            }
            let ends = edges.iter().flat_map(|e| &loose[*e]);
            let ends: Vec<[f64; 3]> = ends.map(|p| self.points[*p as usize]).collect();
            let count = ends.len() as f64;
            let centre = std::array::from_fn(|k| ends.iter().map(|p| p[k]).sum::<f64>() / count);
            let [low, high] = bounds(&ends);
            let across = minus(&high, &low);
            let (edges, size) = (edges.len(), dot(&across, &across).sqrt());
            openings.push(Opening {
                edges,
                centre,
                size,
            });
        }
        openings.sort_by(|a, b| b.size.total_cmp(&a.size));
        openings
    }
}

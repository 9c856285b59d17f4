//! Pieces of walls that bound the fluid where more than two meet in an edge.

use std::collections::{BTreeMap, HashSet};

use sph_core::Sets;

use super::edges::Cuts;
use super::patches::Patch;
use super::places::{EdgeKey, Places, edge_key};
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::geometry::wedges::{AdjacentFace, bound_fluid, wedges};

#[derive(Default)]
pub(super) struct FaceContacts {
    /// Edges of the pieces that touched, as they were.
    pub edges: HashSet<EdgeKey>,
    /// By piece: true if it is the rest of one that touched.
    pub pieces: Vec<bool>,
}

/// By piece, whether it bounds the fluid.
///
/// Around an edge a wedge of fluid lies between two faces that look at each other, and these belong together. Where an
/// open face or another wall closes a pipe that has a thickness, three faces meet: the pipe within, its end, and the
/// closing face. The first and the last hold the fluid; the end, and what hangs together with it, is the outside of the
/// pipe. It ends there on the back of another wall, so that no fluid can be before it.
pub(super) fn wetted_pieces(
    pieces: &[Patch],
    cuts: &Cuts<'_>,
    touched: &FaceContacts,
) -> Vec<bool> {
    let mut runs: BTreeMap<EdgeKey, Vec<(usize, bool)>> = BTreeMap::new();
    for (piece, patch) in pieces.iter().enumerate() {
        for edge in &patch.boundary {
            for ends in cuts.along(*edge).windows(2) {
                let (key, forward, _) = edge_key(ends[0], ends[1]);
                runs.entry(key).or_default().push((piece, forward));
            }
        }
    }
    let mut parts = Sets::new(pieces.len());
    // Pieces that nothing continues, each with those that do go on there.
    let mut severed: Vec<(usize, Vec<usize>)> = Vec::new();
    for (key, run) in &runs {
        let pairs = match run[..] {
            [(piece, _)] => {
                if touched.edges.contains(key) {
                    let others = (0..pieces.len()).filter(|p| touched.pieces[*p]);
                    severed.push((piece, others.collect()));
                }
                continue;
            }
            [(a, with), (b, other)] if with != other => vec![[a, b]],
            _ => wedges(around(pieces, cuts.places, key, run)),
        };
        pairs.iter().for_each(|pair| parts.join(*pair));
        let joined: Vec<usize> = pairs.into_iter().flatten().collect();
        let alone = run.iter().filter(|(piece, _)| !joined.contains(piece));
        severed.extend(alone.map(|(piece, _)| (*piece, joined.clone())));
    }
    bound_fluid(parts, pieces.len(), &severed)
}

fn around(
    pieces: &[Patch],
    places: &Places,
    key: &EdgeKey,
    run: &[(usize, bool)],
) -> Vec<AdjacentFace> {
    let along = sub(places.at(key.second), places.positions[key.first as usize]);
    let direction = |(piece, with): (usize, bool)| {
        let inwards = cross(pieces[piece].normal, along);
        if with { inwards } else { inwards.map(|c| -c) }
    };
    let first = direction(run[0]);
    let beside = |&(piece, with): &(usize, bool)| {
        let own = direction((piece, with));
        let sine = dot(along, cross(first, own)) / norm(along);
        AdjacentFace {
            piece,
            with,
            angle: sine.atan2(dot(first, own)),
        }
    };
    run.iter().map(beside).collect()
}

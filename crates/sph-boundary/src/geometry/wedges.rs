//! Pairs of faces or lines around the fluid where more than two meet.

use std::collections::{BTreeMap, HashSet};

use sph_core::Sets;

/// A face at an edge, or a line at a corner.
pub(crate) struct AdjacentFace {
    pub piece: usize,
    /// True if the fluid is on the side of rising angles.
    pub with: bool,
    /// About the edge or corner, rad.
    pub angle: f64,
}

/// Neighbours about an edge or a corner with the fluid between them.
pub(crate) fn wedges(mut around: Vec<AdjacentFace>) -> Vec<[usize; 2]> {
    // Of two back to back, the one with the fluid before it comes first.
    around.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.with.cmp(&b.with)));
    let next = around.iter().cycle().skip(1);
    let pairs = around.iter().zip(next);
    let pairs = pairs.filter(|(a, b)| a.with && !b.with);
    pairs.map(|(a, b)| [a.piece, b.piece]).collect()
}

/// By piece, whether it bounds the fluid; `parts` are those that hang together.
///
/// `severed` are pieces that nothing continues at some place, each with those that do go on there. What hangs together
/// with one of them ends on the back of another wall, so that no fluid can be before it, if those others end nowhere.
pub(crate) fn bound_fluid(
    mut parts: Sets,
    count: usize,
    severed: &[(usize, Vec<usize>)],
) -> Vec<bool> {
    let ends = severed.iter().map(|(piece, _)| parts.root(*piece));
    let ends: HashSet<usize> = ends.collect();
    let mut outside: BTreeMap<usize, bool> = ends.iter().map(|part| (*part, true)).collect();
    for (piece, others) in severed {
        let whole = others.iter().all(|o| !ends.contains(&parts.root(*o)));
        *outside.entry(parts.root(*piece)).or_default() &= whole && !others.is_empty();
    }
    let mut bounds = |piece| !outside.get(&parts.root(piece)).copied().unwrap_or(false);
    (0..count).map(&mut bounds).collect()
}

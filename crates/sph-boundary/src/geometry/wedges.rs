//! Which faces or lines hang together where more than two meet.

use std::collections::{BTreeMap, HashSet};

/// A face at an edge, or a line at a corner.
pub(crate) struct Beside {
    pub piece: usize,
    /// Whether the fluid is on the side of rising angles.
    pub with: bool,
    /// About the edge or corner, rad.
    pub angle: f64,
}

/// Neighbours about an edge or a corner with the fluid between them.
pub(crate) fn wedges(mut around: Vec<Beside>) -> Vec<[usize; 2]> {
    // Of two back to back, the one with the fluid before it comes first.
    around.sort_by(|a, b| a.angle.total_cmp(&b.angle).then(a.with.cmp(&b.with)));
    let next = around.iter().cycle().skip(1);
    let pairs = around.iter().zip(next);
    pairs
        .filter(|(a, b)| a.with && !b.with)
        .map(|(a, b)| [a.piece, b.piece])
        .collect()
}

/// Pieces that hang together, by a piece that stands for them.
pub(crate) struct Parts(Vec<usize>);

impl Parts {
    /// So many pieces, each by itself.
    pub fn new(pieces: usize) -> Self {
        Parts((0..pieces).collect())
    }

    fn of(&mut self, mut piece: usize) -> usize {
        while self.0[piece] != piece {
            self.0[piece] = self.0[self.0[piece]];
            piece = self.0[piece];
        }
        piece
    }

    pub fn join(&mut self, [a, b]: [usize; 2]) {
        let (a, b) = (self.of(a), self.of(b));
        self.0[a.max(b)] = a.min(b);
    }

    /// By piece, whether it bounds the fluid.
    ///
    /// `severed` are pieces that nothing continues at some place, each with those that do go on there. What hangs
    /// together with one of them ends on the back of another wall, so that no fluid can be before it, if those others
    /// end nowhere.
    pub fn bound_fluid(mut self, severed: &[(usize, Vec<usize>)]) -> Vec<bool> {
        let count = self.0.len();
        let ends: HashSet<usize> = severed.iter().map(|(piece, _)| self.of(*piece)).collect();
        let mut outside: BTreeMap<usize, bool> = ends.iter().map(|part| (*part, true)).collect();
        for (piece, others) in severed {
            let whole = others.iter().all(|o| !ends.contains(&self.of(*o)));
            *outside.entry(self.of(*piece)).or_default() &= whole && !others.is_empty();
        }
        let mut bounds = |piece| !outside.get(&self.of(piece)).copied().unwrap_or(false);
        (0..count).map(&mut bounds).collect()
    }
}

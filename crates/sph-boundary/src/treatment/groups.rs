//! Walls that move together, and walls drawn in several pieces.

use std::ops::Range;

use crate::WallSpec;

/// For every wall the first one that moves as it does.
pub(crate) fn groups<const D: usize>(walls: &[WallSpec<D>]) -> Vec<usize> {
    let mut groups: Vec<usize> = Vec::with_capacity(walls.len());
    for (k, wall) in walls.iter().enumerate() {
        let first = match is_piece(walls, k) {
            true => groups[k - 1],
            false => {
                let prescribed = |w: &WallSpec<D>| w.mover.is_none();
                let as_it = |o: &WallSpec<D>| prescribed(o) && o.motion == wall.motion;
                let mut before = walls[..k].iter();
                let together = before.position(|o| prescribed(wall) && as_it(o));
                together.unwrap_or(k)
            }
        };
        groups.push(first);
    }
    groups
}

/// The pieces of a wall, by its first one.
pub(crate) fn pieces<const D: usize>(walls: &[WallSpec<D>], first: usize) -> Range<usize> {
    let more = (first + 1..walls.len()).take_while(|k| is_piece(walls, *k));
    first..first + 1 + more.count()
}

/// True if a wall is a further piece of the one before it, of which there may be thousands.
pub(crate) fn is_piece<const D: usize>(walls: &[WallSpec<D>], k: usize) -> bool {
    k > 0 && walls[k].drawing.name() == walls[k - 1].drawing.name()
}

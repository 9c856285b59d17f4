//! Pairs that do not see each other, because a wall stands between them.

use crate::lists::members::Members;

/// Sorted pairs of indices; a row holds the indices that its own does not see.
#[derive(Clone, Debug, Default)]
pub struct HiddenPairs {
    pairs: Vec<[u32; 2]>,
}

impl HiddenPairs {
    /// Of pairs in any order.
    pub fn from_pairs(mut pairs: Vec<[u32; 2]>) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        HiddenPairs { pairs }
    }

    /// All pairs, ascending.
    pub fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }

    /// True if all see each other.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Indices that an index does not see, ascending.
    pub fn row(&self, index: usize) -> impl Iterator<Item = u32> + '_ {
        let from = self.pairs.partition_point(|[i, _]| (*i as usize) < index);
        let row = self.pairs[from..].iter();
        row.take_while(move |[i, _]| *i as usize == index)
            .map(|[_, j]| *j)
    }

    /// True if an index does not see another.
    #[inline(always)]
    pub fn has(&self, index: usize, other: u32) -> bool {
        !self.is_empty() && self.pairs.binary_search(&[index as u32, other]).is_ok()
    }

    /// Puts candidates that members do not see infinitely far away; `distance2` has one number per lane for each candidate.
    pub(crate) fn part(&self, members: Members<'_>, lanes: usize, distance2: &mut [f64]) {
        if self.is_empty() {
            return;
        }
        for lane in 0..members.count {
            for other in self.row(members.from + lane) {
                if let Some(place) = members.candidates.iter().position(|c| *c == other) {
                    distance2[place * lanes + lane] = f64::INFINITY;
                }
            }
        }
    }
}

/// Pairs hidden by walls, at the present positions. A pair infinitely far apart is in no sum.
#[derive(Clone, Debug, Default)]
pub struct Hidden {
    /// Free particles from free particles, both ways.
    pub particles: HiddenPairs,
    /// Wall points from free particles.
    pub points: HiddenPairs,
    /// Free particles from wall points.
    pub at_points: HiddenPairs,
    /// Free particles from elements.
    pub at_elements: HiddenPairs,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_holds_whom_an_index_does_not_see() {
        let blocked = HiddenPairs::from_pairs(vec![[4, 2], [1, 9], [4, 0], [4, 2]]);
        let row = |i: usize| blocked.row(i).collect::<Vec<_>>();
        assert_eq!([row(1), row(2), row(4)], [vec![9], vec![], vec![0, 2]]);
        assert!(blocked.has(4, 0) && !blocked.has(0, 4));
        let mut distance2 = vec![1.0; 6];
        let members = Members {
            from: 4,
            count: 2,
            candidates: &[0, 1, 2],
        };
        blocked.part(members, 2, &mut distance2);
        let far = f64::INFINITY;
        assert_eq!(distance2, [far, 1.0, 1.0, 1.0, far, 1.0]);
    }
}

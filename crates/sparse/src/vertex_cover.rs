//! The fewest ends that touch every join between two sides.

use std::collections::VecDeque;

use crate::Groups;

/// No end.
const NONE: u32 = u32::MAX;

/// Marks of the ends on the left, and on the right of which there are `right`, that are in a smallest cover of the joins of
/// each end on the left with ends on the right.
/// Source: König 1931, from a largest matching by augmenting paths.
pub fn cover(joins: &Groups, right: usize) -> [Vec<bool>; 2] {
    let left = joins.starts.len() - 1;
    let mut mates = [vec![NONE; left], vec![NONE; right]];
    // The end on the left from which one on the right was reached, in the search of a number.
    let mut reached = vec![(NONE, NONE); right];
    let mut queue = VecDeque::new();
    for begin in 0..left as u32 {
        queue.clear();
        queue.push_back(begin);
        'search: while let Some(u) = queue.pop_front() {
            for &v in joins.members(u as usize) {
                if reached[v as usize].0 == begin {
                    continue;
                }
                reached[v as usize] = (begin, u);
                match mates[1][v as usize] {
                    NONE => {
                        augment(&mut mates, &reached, v);
                        break 'search;
                    }
                    mate => queue.push_back(mate),
                }
            }
        }
    }
    // What alternating paths from unmatched ends on the left reach.
    let mut seen = [vec![false; left], vec![false; right]];
    let unmatched = (0..left as u32).filter(|u| mates[0][*u as usize] == NONE);
    let mut stack: Vec<u32> = unmatched.collect();
    while let Some(u) = stack.pop() {
        if std::mem::replace(&mut seen[0][u as usize], true) {
            continue;
        }
        for &v in joins.members(u as usize) {
            if !std::mem::replace(&mut seen[1][v as usize], true) {
                stack.push(mates[1][v as usize]);
            }
        }
    }
    let [of_left, of_right] = seen;
    [of_left.into_iter().map(|seen| !seen).collect(), of_right]
}

/// Matches along the path that reached an unmatched end on the right.
fn augment(mates: &mut [Vec<u32>; 2], reached: &[(u32, u32)], mut v: u32) {
    loop {
        let (begin, u) = reached[v as usize];
        mates[1][v as usize] = u;
        let before = std::mem::replace(&mut mates[0][u as usize], v);
        if u == begin {
            return;
        }
        v = before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joins(rows: &[&[u32]]) -> Groups {
        let mut joins = Groups::default();
        for row in rows {
            joins.starts.push(joins.members.len() as u32);
            joins.members.extend(*row);
        }
        joins.starts.push(joins.members.len() as u32);
        joins
    }

    /// Every join is touched, by as few ends as a search over all sets finds.
    #[test]
    fn covers_are_smallest() {
        let mut number = 7_u64;
        for _ in 0..300 {
            let mut draw = || {
                number = number
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                (number >> 33) as u32
            };
            let rows: Vec<Vec<u32>> = (0..5)
                .map(|_| (0..5).filter(|_| draw() % 3 == 0).collect())
                .collect();
            let rows: Vec<&[u32]> = rows.iter().map(Vec::as_slice).collect();
            let [left, right] = cover(&joins(&rows), 5);
            let touched = |left: &dyn Fn(usize) -> bool, right: &dyn Fn(usize) -> bool| {
                let mut all = rows.iter().enumerate();
                all.all(|(u, row)| row.iter().all(|v| left(u) || right(*v as usize)))
            };
            assert!(
                touched(&|u| left[u], &|v| right[v]),
                "{rows:?}: {left:?} {right:?}"
            );
            let size = left.iter().chain(&right).filter(|kept| **kept).count();
            let fits = |set: &u32| touched(&|u| set >> u & 1 == 1, &|v| set >> (5 + v) & 1 == 1);
            let least = (0_u32..1024).filter(fits).map(u32::count_ones).min();
            assert_eq!(Some(size as u32), least, "{rows:?}");
        }
    }
}

//! Pieces of wall that end freely, and on which side of them a point is.

use sph_core::Sets;
#[cfg(feature = "plugins")]
use sph_neighbours::ContactBlock;

#[cfg(feature = "plugins")]
use crate::GammaSum;

/// A sum of Γ below this puts a point behind a shell; rounding does not reach it.
const BEHIND: f64 = 1e-9;
/// Least γ: that of a point in a corner behind several shells.
const LEAST: f64 = 0.01;

/// Elements that are connected to a free end.
#[derive(Clone, Debug, Default)]
pub struct Shells {
    /// By element, from 1 on; 0 where the wall is closed. Empty where all are.
    of: Vec<u32>,
    /// By element: whether it is at a free end.
    rim: Vec<bool>,
}

impl Shells {
    /// From the nodes of every element and whether fluid passes it, the number of all nodes, and those at free ends.
    ///
    /// An open face hides nothing: it belongs to no shell and joins none.
    pub fn new<const N: usize>(
        elements: impl Iterator<Item = ([usize; N], bool)> + Clone,
        nodes: usize,
        free: impl Iterator<Item = usize>,
    ) -> Self {
        let mut sets = Sets::new(nodes);
        for (element, _) in elements.clone().filter(|(_, open)| !open) {
            for pair in element.windows(2) {
                sets.join([pair[0], pair[1]]);
            }
        }
        let (mut number, mut ends) = (vec![0; nodes], vec![false; nodes]);
        let mut shells = 0;
        for node in free {
            ends[node] = true;
            let of = &mut number[sets.root(node)];
            if *of == 0 {
                shells += 1;
                *of = shells;
            }
        }
        if shells == 0 {
            return Shells::default();
        }
        let rim = (elements.clone()).map(|(e, open)| !open && e.iter().any(|node| ends[*node]));
        let of = elements.map(|(e, open)| if open { 0 } else { number[sets.root(e[0])] });
        Shells {
            rim: rim.collect(),
            of: of.collect(),
        }
    }

    /// True if there is any.
    pub fn any(&self) -> bool {
        !self.of.is_empty()
    }

    /// True if an element is at a free end.
    pub fn is_rim(&self, element: usize) -> bool {
        self.rim.get(element).is_some_and(|rim| *rim)
    }

    /// Number of the shell of an element, 0 if it is on none.
    #[inline(always)]
    pub fn shell_of(&self, element: usize) -> u32 {
        self.of.get(element).copied().unwrap_or(0)
    }
}

/// Σ Γ over each shell that a point sees.
///
/// Γ_s is the part of the kernel in the shadow of an element, positive before it and negative behind it. Before a shell the
/// sum is that of γ = θ − Σ Γ_s, θ = 1, whether or not the wall goes on: a place beyond a free end is in no shadow. Behind it
/// the wall hides as much of the other side, so that
///
/// ```text
/// γ = 1 − Σ_shells |Σ_s Γ_s| − Σ_others Γ_s
/// ```
///
/// which is continuous where a point passes the free end, as the shell is then seen edge-on.
#[derive(Debug, Default)]
pub struct ShellSums {
    sums: Vec<(u32, f64)>,
}

impl ShellSums {
    pub fn clear(&mut self) {
        self.sums.clear();
    }

    #[inline(always)]
    pub fn add(&mut self, shell: u32, gamma: f64) {
        if shell == 0 {
            return;
        }
        match self.sums.iter_mut().find(|(s, _)| *s == shell) {
            Some((_, sum)) => *sum += gamma,
            None => self.sums.push((shell, gamma)),
        }
    }

    /// The shells that the point is behind, and their sums.
    pub fn behind(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.sums.iter().copied().filter(|(_, sum)| *sum < -BEHIND)
    }

    /// γ of a point behind shells from the sum over all elements; `None` before all of them.
    #[inline(always)]
    pub fn gamma(&self, signed_sum: f64) -> Option<f64> {
        let hidden: f64 = self.behind().map(|(_, sum)| -sum).sum();
        (hidden > 0.0).then(|| (1.0 - signed_sum - 2.0 * hidden).max(LEAST))
    }
}

/// γ and shells of a batch of points.
#[derive(Debug, Default)]
pub struct Gammas {
    /// γ of each point, and planes of contacts up to and including its own.
    pub all: Vec<(f64, u32)>,
    /// Points, counted from 0, and the shells that they are behind.
    pub behind: Vec<(u32, u32)>,
    /// Of the point at hand; kept for its memory.
    sides: ShellSums,
}

impl Gammas {
    /// Clears all.
    pub fn clear(&mut self) {
        self.all.clear();
        self.behind.clear();
    }

    /// Adds a point that sees its elements, pushes their contacts but for those of hidden shells, and adds Γ to those of
    /// the shells. What it is behind is no contact.
    #[cfg(feature = "plugins")]
    #[inline(always)]
    pub(crate) fn add<const D: usize>(
        &mut self,
        contacts: &mut ContactBlock<D>,
        mut see: impl FnMut(&mut ContactBlock<D>, &mut ShellSums, &[u32]) -> GammaSum<D>,
    ) {
        let (planes, point) = (contacts.planes(), self.all.len() as u32);
        self.sides.clear();
        let sum = see(contacts, &mut self.sides, &[]);
        let behind = self.sides.gamma(sum.signed_sum);
        let gamma = match behind.filter(|_| sum.contact_fraction == 0.0) {
            None => sum.gamma(),
            Some(gamma) => {
                let hidden: Vec<u32> = self.sides.behind().map(|(shell, _)| shell).collect();
                contacts.truncate(planes);
                see(contacts, &mut ShellSums::default(), &hidden);
                self.behind.extend(hidden.iter().map(|s| (point, *s)));
                gamma
            }
        };
        self.all.push((gamma, contacts.planes()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_pieces_with_a_free_end_are_shells() {
        let lines = [[0, 1], [1, 2], [3, 4], [4, 3], [5, 6], [6, 7]].map(|nodes| (nodes, false));
        let shells = Shells::new(lines.into_iter(), 8, [0, 2, 7].into_iter());
        let of: Vec<u32> = (0..6).map(|k| shells.shell_of(k)).collect();
        assert_eq!(of, [1, 1, 0, 0, 2, 2]);
        assert!(!Shells::new(lines[2..4].iter().copied(), 8, [].into_iter()).any());
    }

    #[test]
    fn a_face_that_fluid_passes_is_on_no_shell() {
        let lines = [([0, 1], false), ([1, 2], true), ([2, 3], false)];
        let shells = Shells::new(lines.into_iter(), 4, [0, 3].into_iter());
        assert_eq!([0, 1, 2].map(|k| shells.shell_of(k)), [1, 0, 2]);
        assert!(shells.is_rim(0) && !shells.is_rim(1));
    }

    #[test]
    fn behind_a_shell_its_shadow_is_on_the_other_side() {
        let mut sums = ShellSums::default();
        sums.add(1, -0.3);
        sums.add(0, 0.1);
        sums.add(1, 0.1);
        let gamma = sums.gamma(-0.1).expect("it is behind");
        assert!((gamma - 0.7).abs() < 1e-15, "{gamma}");
        sums.clear();
        sums.add(1, 0.3);
        assert_eq!(sums.gamma(0.3), None);
    }
}

//! The parts of space that ranks own.

use sph_core::Vect;

use crate::decomposition::{
    bisect::check,
    {PartError, Transport, TransportError},
};

/// Halvings of an interval until its ends are one number, or nearly.
const HALVINGS: usize = 52;
/// Costs are counted in this share of the mean cost of a particle, so that their sums are exact.
const GRAIN: f64 = 1.0 / 1024.0;

/// A binary tree of planes: each cuts the space of a group of ranks across an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Cuts<const D: usize> {
    ranks: usize,
    /// Axis and place of the plane of each group, by the first rank behind it; place 0 is unused.
    planes: Vec<(usize, f64)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Group {
    first: usize,
    ranks: usize,
}

impl Group {
    /// Its lower and its upper half.
    fn halves(self) -> [Group; 2] {
        let lower = self.ranks / 2;
        let parts = [
            (self.first, lower),
            (self.first + lower, self.ranks - lower),
        ];
        parts.map(|(first, ranks)| Group { first, ranks })
    }
}

impl<const D: usize> Cuts<D> {
    /// Cuts between particles of which every rank holds some, so that all ranks get the same cost: the longest axis of each
    /// group is cut, group by group. All ranks find the same planes.
    ///
    /// # Errors
    /// Numbers that are not finite; messages that fail.
    pub fn balanced(
        places: &[Vect<D>],
        costs: &[f64],
        ranks: usize,
        communicator: &dyn Transport,
    ) -> Result<Self, PartError> {
        check(places, costs)?;
        let mean = mean(costs, communicator)?;
        let grains = |c: &f64| 1 + (c / (mean * GRAIN)).min(1e6) as u64;
        let costs: Vec<u64> = costs.iter().map(grains).collect();
        let mut cuts = Cuts {
            ranks,
            planes: vec![(0, 0.0); ranks],
        };
        let mut groups = vec![Group { first: 0, ranks }];
        while groups.iter().any(|g| g.ranks > 1) {
            let wide: Vec<Group> = groups.iter().copied().filter(|g| g.ranks > 1).collect();
            cuts.cut(&wide, places, &costs, communicator)?;
            let halves = |g: Group| match g.ranks {
                1 => vec![g],
                _ => g.halves().to_vec(),
            };
            groups = groups.into_iter().flat_map(halves).collect();
        }
        Ok(cuts)
    }

    /// Finds the planes of all groups of a level at once.
    fn cut(
        &mut self,
        groups: &[Group],
        places: &[Vect<D>],
        costs: &[u64],
        communicator: &dyn Transport,
    ) -> Result<(), PartError> {
        let level = groups.iter().map(|g| g.ranks).max().unwrap_or(1);
        let mut numbers = vec![None; self.ranks];
        for (number, group) in groups.iter().enumerate() {
            numbers[group.first] = Some(number);
        }
        let number = |x: &Vect<D>| {
            let group = self.group_of(x, level);
            numbers[group.first].filter(|n| groups[*n] == group)
        };
        let of: Vec<Option<usize>> = places.iter().map(number).collect();
        // Corners of all groups: −lower, upper.
        let mut corners = vec![f64::NEG_INFINITY; 2 * D * groups.len()];
        let mut wanted = vec![0_u64; groups.len()];
        for ((x, cost), group) in places.iter().zip(costs).zip(&of) {
            let Some(g) = *group else { continue };
            wanted[g] += cost;
            for axis in 0..D {
                let [low, high] = [0, 1].map(|end| 2 * (g * D + axis) + end);
                corners[low] = corners[low].max(-x[axis]);
                corners[high] = corners[high].max(x[axis]);
            }
        }
        communicator.largest(&mut corners)?;
        communicator.total(&mut wanted)?;
        let span = |g: usize, axis: usize| {
            let at = 2 * (g * D + axis);
            (-corners[at], corners[at + 1])
        };
        let longest = |g: usize| {
            let length = |axis: &usize| span(g, *axis).1 - span(g, *axis).0;
            let axes = (0..D).rev();
            axes.max_by(|a, b| length(a).total_cmp(&length(b)))
                .unwrap_or(0)
        };
        let axes: Vec<usize> = (0..groups.len()).map(longest).collect();
        let mut between: Vec<(f64, f64)> = (0..groups.len()).map(|g| span(g, axes[g])).collect();
        for _ in 0..HALVINGS {
            let middle = |(low, high): &(f64, f64)| 0.5 * (low + high);
            let mut below = vec![0_u64; groups.len()];
            for ((x, cost), group) in places.iter().zip(costs).zip(&of) {
                let Some(g) = *group else { continue };
                if x[axes[g]] < middle(&between[g]) {
                    below[g] += cost;
                }
            }
            communicator.total(&mut below)?;
            for (g, group) in groups.iter().enumerate() {
                let aim = wanted[g] / group.ranks as u64 * group.halves()[0].ranks as u64;
                let here = middle(&between[g]);
                match below[g] < aim {
                    true => between[g].0 = here,
                    false => between[g].1 = here,
                }
            }
        }
        for (g, group) in groups.iter().enumerate() {
            self.planes[group.halves()[1].first] = (axes[g], between[g].1);
        }
        Ok(())
    }

    /// The group that a place belongs to, as soon as it has at most `ranks` ranks.
    fn group_of(&self, x: &Vect<D>, ranks: usize) -> Group {
        let mut group = Group {
            first: 0,
            ranks: self.ranks,
        };
        while group.ranks > ranks {
            let [lower, upper] = group.halves();
            let (axis, place) = self.planes[upper.first];
            group = if x[axis] < place { lower } else { upper };
        }
        group
    }

    /// The rank that owns a place.
    pub fn owner(&self, x: &Vect<D>) -> u32 {
        self.group_of(x, 1).first as u32
    }
}

/// Mean cost of a particle; 1 where nothing costs anything. The same on all ranks, to a share of a thousandth.
fn mean(costs: &[f64], communicator: &dyn Transport) -> Result<f64, TransportError> {
    let mut most = [costs.iter().copied().fold(0.0, f64::max)];
    communicator.largest(&mut most)?;
    if most[0] <= 0.0 {
        return Ok(1.0);
    }
    let counted = |c: &f64| (c / most[0] * 1e6) as u64;
    let mut sums = [costs.iter().map(counted).sum(), costs.len() as u64];
    communicator.total(&mut sums)?;
    Ok((sums[0] as f64 / 1e6 / sums[1].max(1) as f64).max(1e-6) * most[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decomposition::Thread;

    /// The right third costs five times as much; two ranks hold half of the particles each, or one all.
    #[test]
    fn all_ranks_find_the_same_planes_and_each_part_costs_the_same() {
        let place =
            |k: usize| Vect::<2>::new((k % 60) as f64 + 0.01 * (k / 60) as f64, (k / 60) as f64);
        let places: Vec<_> = (0..60 * 20).map(place).collect();
        let cost = |x: &Vect<2>| if x[0] < 40.0 { 1.0 } else { 5.0 };
        let costs: Vec<f64> = places.iter().map(cost).collect();
        let whole = Thread::communicator(1);
        for ranks in [1, 2, 3, 5, 8, 16] {
            let cuts = Cuts::balanced(&places, &costs, ranks, &whole[0]).expect("cuts");
            let mut shares = vec![0.0; ranks];
            for (x, c) in places.iter().zip(&costs) {
                shares[cuts.owner(x) as usize] += c;
            }
            let mean = costs.iter().sum::<f64>() / ranks as f64;
            // Each of log₂ cuts is off by what stands on one line across, at most 20 particles of 5.
            let bound = 100.0 * (ranks as f64).log2().ceil() + 1e-9;
            for share in &shares {
                assert!(
                    (share - mean).abs() <= bound,
                    "{ranks} ranks: {share} of {mean}"
                );
            }
            let half = |k: usize, communicator: Thread| {
                let own = || (0..places.len()).filter(move |n| n % 2 == k);
                let mine: Vec<_> = own().map(|n| places[n]).collect();
                let price: Vec<_> = own().map(|n| costs[n]).collect();
                Cuts::balanced(&mine, &price, ranks, &communicator).expect("cuts")
            };
            let split: Vec<_> = std::thread::scope(|scope| {
                let halves = Thread::communicator(2).into_iter().enumerate();
                let halves: Vec<_> = halves
                    .map(|(k, communicator)| scope.spawn(move || half(k, communicator)))
                    .collect();
                let joined = halves.into_iter().map(|h| h.join().expect("a rank"));
                joined.collect()
            });
            assert_eq!(split, vec![cuts.clone(), cuts], "{ranks} ranks");
        }
    }
}

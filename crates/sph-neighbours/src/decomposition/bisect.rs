//! Recursive coordinate bisection.

use std::ops::Range;

use sph_core::Vect;

use crate::decomposition::DecompositionError;
use crate::decomposition::ghosts::around;

/// Refuses no rank, and more ranks than particles.
pub(crate) fn check_ranks(ranks: usize, particles: usize) -> Result<(), DecompositionError> {
    let fault = match ranks {
        0 => "there must be a rank at least".into(),
        _ if ranks > particles => {
            format!("{ranks} ranks for {particles} particles: some would own nothing")
        }
        _ => return Ok(()),
    };
    Err(DecompositionError(fault))
}

/// The owner of every particle: the set is cut across its longest axis so that both sides have the cost of their ranks, and
/// so on. Places that are the same go by their index, so that every rank finds the same owners. Each rank owns one particle at least.
/// Source: Berger & Bokhari 1987, IEEE Trans. Comput. C-36, 570–580.
///
/// # Errors
/// No rank, more ranks than particles, numbers that are not finite.
pub fn bisect<const D: usize>(
    places: &[Vect<D>],
    costs: &[f64],
    ranks: usize,
) -> Result<Vec<u32>, DecompositionError> {
    let particles = places.len();
    check_ranks(ranks, particles)?;
    if costs.len() != particles {
        let fault = format!("{} costs for {particles} particles", costs.len());
        return Err(DecompositionError(fault));
    }
    check(places, costs)?;
    let mut all: Vec<u32> = (0..particles as u32).collect();
    let mut owners = vec![0; particles];
    let mut cutter = Cutter {
        places,
        costs,
        owners: &mut owners,
    };
    cutter.cut(&mut all, 0..ranks as u32);
    Ok(owners)
}

pub(crate) fn check<const D: usize>(
    places: &[Vect<D>],
    costs: &[f64],
) -> Result<(), DecompositionError> {
    let whole = |k: &usize| places[*k].iter().all(|x| x.is_finite()) && costs[*k] >= 0.0;
    let fault = match (0..places.len()).find(|k| !whole(k) || costs[*k].is_infinite()) {
        Some(particle) => {
            format!("particle {particle} has a place or a cost that cannot be divided")
        }
        None => return Ok(()),
    };
    Err(DecompositionError(fault))
}

struct Cutter<'a, const D: usize> {
    places: &'a [Vect<D>],
    costs: &'a [f64],
    owners: &'a mut [u32],
}

impl<const D: usize> Cutter<'_, D> {
    fn cut(&mut self, part: &mut [u32], ranks: Range<u32>) {
        if ranks.len() == 1 {
            part.iter()
                .for_each(|k| self.owners[*k as usize] = ranks.start);
            return;
        }
        let axis = self.longest(part);
        let at = |k: &u32| self.places[*k as usize][axis];
        part.sort_unstable_by(|a, b| at(a).total_cmp(&at(b)).then(a.cmp(b)));
        let lower = ranks.len() / 2;
        let total: f64 = part.iter().map(|k| self.costs[*k as usize]).sum();
        let target = total * lower as f64 / ranks.len() as f64;
        let mut sum = 0.0;
        let here = part.iter().position(|k| {
            let cost = self.costs[*k as usize];
            // The cut is nearer to the target before this one than behind it.
            let beyond = sum + 0.5 * cost > target;
            sum += cost;
            beyond
        });
        let least = lower;
        let most = part.len() - (ranks.len() - lower);
        let (low, high) = part.split_at_mut(here.unwrap_or(part.len()).clamp(least, most));
        let middle = ranks.start + lower as u32;
        self.cut(low, ranks.start..middle);
        self.cut(high, middle..ranks.end);
    }

    fn longest(&self, part: &[u32]) -> usize {
        let [low, high] = around(part.iter().map(|k| &self.places[*k as usize]));
        (high - low).imax()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    fn lattice() -> Vec<Vector2<f64>> {
        let place = |k: usize| Vector2::new((k % 60) as f64, (k / 60) as f64);
        (0..60 * 20).map(place).collect()
    }

    #[test]
    fn every_rank_has_its_share_of_the_cost() {
        let places = lattice();
        // The right third costs five times as much.
        let cost = |x: &Vector2<f64>| if x[0] < 40.0 { 1.0 } else { 5.0 };
        let costs: Vec<f64> = places.iter().map(cost).collect();
        let total: f64 = costs.iter().sum();
        for ranks in [1, 2, 3, 5, 8, 16] {
            let owners = bisect(&places, &costs, ranks).expect("owners");
            let mut shares = vec![0.0; ranks];
            let all = owners.iter().zip(&costs);
            all.for_each(|(o, c)| shares[*o as usize] += c);
            // Each of at most log₂ cuts is off by half a particle, 5.
            let bound = 2.5 * (ranks as f64).log2().ceil() + 1e-9;
            for share in shares {
                let off = (share - total / ranks as f64).abs();
                assert!(off <= bound, "{ranks} ranks: off by {off}, bound {bound}");
            }
        }
    }

    #[test]
    fn impossible_divisions_are_refused() {
        let places = lattice();
        let costs = vec![1.0; places.len()];
        let told = |costs: &[f64], ranks| {
            let refused = bisect(&places, costs, ranks);
            refused.expect_err("an error").to_string()
        };
        assert!(told(&costs, 0).contains("a rank at least"));
        assert!(told(&costs, 1201).contains("own nothing"));
        assert!(told(&costs[1..], 2).contains("1199 costs"));
        let mut broken = costs.clone();
        broken[7] = f64::NAN;
        assert!(told(&broken, 2).contains("particle 7 "));
        // Particles on one place go by their index.
        let same = vec![Vector2::new(1.0, 1.0); 8];
        assert_eq!(
            bisect(&same, &[1.0; 8], 4),
            Ok(vec![0, 0, 1, 1, 2, 2, 3, 3])
        );
        // Nothing costs anything: each has a particle all the same.
        let owners = bisect(&same, &[0.0; 8], 8).expect("owners");
        assert_eq!(owners, (0..8).collect::<Vec<_>>());
    }
}

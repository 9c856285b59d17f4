//! The nearest of many places.

use sph_core::Vect;

/// Places in a binary tree: the middle one along an axis, those before it, those behind it; the axes take turns.
///
/// No crate does it for less: 40 lines, and any dimension.
pub(crate) struct PlaceTree<const D: usize>(Vec<Vect<D>>);

impl<const D: usize> PlaceTree<D> {
    /// Sorts places.
    pub fn new(mut places: Vec<Vect<D>>) -> Self {
        sort(&mut places, 0);
        PlaceTree(places)
    }

    /// The distance to the nearest one, m; infinite if there is none.
    pub fn distance(&self, x: &Vect<D>) -> f64 {
        let mut least = f64::INFINITY;
        search(&self.0, 0, x, &mut least);
        least.sqrt()
    }
}

fn sort<const D: usize>(places: &mut [Vect<D>], axis: usize) {
    if places.len() < 2 {
        return;
    }
    let middle = places.len() / 2;
    places.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
    let (before, behind) = places.split_at_mut(middle);
    let next = (axis + 1) % D;
    sort(before, next);
    sort(&mut behind[1..], next);
}

fn search<const D: usize>(places: &[Vect<D>], axis: usize, x: &Vect<D>, least: &mut f64) {
    let middle = places.len() / 2;
    let Some(place) = places.get(middle) else {
        return;
    };
    *least = least.min((x - place).norm_squared());
    let apart = x[axis] - place[axis];
    let (before, behind) = (&places[..middle], &places[middle + 1..]);
    let next = (axis + 1) % D;
    let (own, other) = if apart < 0.0 {
        (before, behind)
    } else {
        (behind, before)
    };
    search(own, next, x, least);
    if apart * apart < *least {
        search(other, next, x, least);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_least_of_all_distances() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut place = || Vect::<3>::from_fn(|_, _| random());
        let places: Vec<_> = (0..500).map(|_| place()).collect();
        let tree = PlaceTree::new(places.clone());
        for _ in 0..200 {
            let x = place() * 2.0;
            let all = places.iter().map(|p| (p - x).norm_squared());
            assert_eq!(tree.distance(&x), all.fold(f64::INFINITY, f64::min).sqrt());
        }
        assert_eq!(
            PlaceTree::<2>::new(Vec::new()).distance(&Vect::zeros()),
            f64::INFINITY
        );
    }
}

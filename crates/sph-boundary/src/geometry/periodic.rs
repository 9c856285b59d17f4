//! A box whose opposite sides may be the same place.

use crate::error::{BoundaryError, Result};
use crate::geometry::cells::product;
use crate::geometry::vector::sub;

/// An axis-aligned box, each axis periodic or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicBox<const D: usize = 2> {
    /// Lower corner, m.
    pub lower: [f64; D],
    /// Upper corner, m.
    pub upper: [f64; D],
    /// Axes along which the two sides are the same place.
    pub periodic: [bool; D],
}

impl<const D: usize> Default for PeriodicBox<D> {
    fn default() -> Self {
        Self::none()
    }
}

impl<const D: usize> PeriodicBox<D> {
    /// No periodic direction.
    pub fn none() -> Self {
        Self {
            lower: [0.0; D],
            upper: [0.0; D],
            periodic: [false; D],
        }
    }

    /// The box of a flow.
    #[cfg(feature = "plugins")]
    pub fn from_domain(domain: &sph_neighbours::Domain<D>) -> Self {
        Self {
            lower: domain.lower.into(),
            upper: domain.upper.into(),
            periodic: domain.periodic,
        }
    }

    /// Periods in metres, 0 across an axis that is not periodic.
    pub fn periods(&self) -> [f64; D] {
        std::array::from_fn(|k| match self.periodic[k] {
            true => self.upper[k] - self.lower[k],
            false => 0.0,
        })
    }

    /// Refuses a periodic axis without extent.
    pub(crate) fn check(&self) -> Result<()> {
        let mut periodic = (0..D).filter(|k| self.periodic[*k]);
        periodic.try_for_each(|k| BoundaryError::check_positive("period", self.periods()[k]))
    }

    /// The whole number of periods nearest to a displacement, and the rest of it.
    pub(crate) fn nearest(&self, displacement: [f64; D]) -> ([i32; D], [f64; D]) {
        let periods = self.periods();
        let image = std::array::from_fn(|k| match self.periodic[k] {
            true => (displacement[k] / periods[k]).round() as i32,
            false => 0,
        });
        (image, sub(displacement, self.shift(image)))
    }

    /// A place moved into the box along its periodic directions, m.
    pub(crate) fn wrapped(&self, place: [f64; D]) -> [f64; D] {
        let periods = self.periods();
        std::array::from_fn(|k| match self.periodic[k] {
            true => self.lower[k] + (place[k] - self.lower[k]).rem_euclid(periods[k]),
            false => place[k],
        })
    }

    /// The most periods from the box to any of the places, 0 if all are in it.
    pub(crate) fn periods_to(&self, places: impl Iterator<Item = [f64; D]>) -> f64 {
        let periods = self.periods();
        let beyond = |x: [f64; D]| {
            let along = |k: usize| match self.periodic[k] {
                true => (self.lower[k] - x[k]).max(x[k] - self.upper[k]) / periods[k],
                false => 0.0,
            };
            (0..D).map(along).fold(0.0, f64::max)
        };
        places.map(beyond).fold(0.0, f64::max)
    }

    /// The displacement of an image, m.
    pub(crate) fn shift(&self, image: [i32; D]) -> [f64; D] {
        let periods = self.periods();
        std::array::from_fn(|k| f64::from(image[k]) * periods[k])
    }

    /// Images that a box must be moved by to come within other bounds, m, ascending; wholly unmoved along axes that are not
    /// periodic.
    pub(crate) fn images_within(
        &self,
        [low, high]: [[f64; D]; 2],
        own: [[f64; D]; 2],
    ) -> impl Iterator<Item = [i32; D]> + use<D> {
        let periods = self.periods();
        let range = |k: usize| match self.periodic[k] {
            false => [0; 2],
            true => {
                let first = ((low[k] - own[1][k]) / periods[k]).ceil();
                let last = ((high[k] - own[0][k]) / periods[k]).floor();
                [first as i64, last as i64]
            }
        };
        product(std::array::from_fn(range)).map(|image| image.map(|n| n as i32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_reach_into_the_box_from_both_sides() {
        let channel = PeriodicBox {
            lower: [0.0; 2],
            upper: [10.0, 1.0],
            periodic: [true, false],
        };
        let images = |x: [f64; 2]| {
            let around = [[-1.0, -1.0], [11.0, 2.0]];
            let all = channel.images_within(around, x.map(|x| [x, 0.5]));
            all.map(|[n, _]| n).collect::<Vec<_>>()
        };
        assert_eq!(images([9.5, 10.0]), [-1, 0]);
        assert_eq!(images([4.0, 5.0]), [0]);
        assert_eq!(channel.nearest([-9.9, 3.0]).0, [-1, 0]);
        assert_eq!(channel.shift([-1, 0]), [-10.0, 0.0]);
    }

    #[test]
    fn period_must_be_positive() {
        let flat = PeriodicBox {
            lower: [0.0; 2],
            upper: [0.0; 2],
            periodic: [true, false],
        };
        assert!(flat.check().is_err());
        assert!(PeriodicBox::<2>::none().check().is_ok());
    }
}

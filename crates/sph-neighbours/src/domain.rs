//! The box of the flow, and its periodic directions.

use sph_core::Vect;
use sph_kernels::lanes::Lane;

/// A box; along a periodic axis the upper face is the lower one.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain<const D: usize> {
    /// Lower corner, m.
    pub lower: Vect<D>,
    /// Upper corner, m.
    pub upper: Vect<D>,
    /// Periodic axes.
    pub periodic: [bool; D],
}

impl<const D: usize> Domain<D> {
    /// A box without periodic axes.
    pub fn open(lower: Vect<D>, upper: Vect<D>) -> Self {
        Domain {
            lower,
            upper,
            periodic: [false; D],
        }
    }

    /// Length of the box along an axis, m.
    #[inline(always)]
    pub fn length(&self, axis: usize) -> f64 {
        self.upper[axis] - self.lower[axis]
    }

    /// The separation between nearest images.
    #[inline(always)]
    pub fn nearest_image(&self, mut d: Vect<D>) -> Vect<D> {
        for axis in 0..D {
            if self.periodic[axis] {
                let length = self.length(axis);
                if d[axis] > 0.5 * length {
                    d[axis] -= length;
                } else if d[axis] < -0.5 * length {
                    d[axis] += length;
                }
            }
        }
        d
    }

    /// The same of any displacement, however many periods it has.
    pub fn nearest(&self, mut d: Vect<D>) -> Vect<D> {
        for axis in (0..D).filter(|axis| self.periodic[*axis]) {
            let length = self.length(axis);
            d[axis] -= (d[axis] / length).round() * length;
        }
        d
    }

    /// [`Domain::nearest_image`] in all lanes.
    #[inline(always)]
    pub(crate) fn nearest_images<L: Lane>(&self, mut d: [L; D]) -> [L; D] {
        for (axis, d) in d.iter_mut().enumerate() {
            if self.periodic[axis] {
                let length = L::splat(self.length(axis));
                let half = L::splat(0.5 * self.length(axis));
                let near = (-half - *d).where_positive(*d + length, *d);
                *d = (*d - half).where_positive(*d - length, near);
            }
        }
        d
    }

    /// The position moved into the box along its periodic axes.
    pub fn wrapped(&self, mut x: Vect<D>) -> Vect<D> {
        for axis in 0..D {
            if self.periodic[axis] {
                let length = self.length(axis);
                let turns = ((x[axis] - self.lower[axis]) / length).floor();
                if turns != 0.0 {
                    x[axis] -= turns * length;
                }
                // A value a rounding error below the lower face lands on the upper one.
                if x[axis] >= self.upper[axis] {
                    x[axis] = self.lower[axis];
                }
            }
        }
        x
    }

    /// True if an image across a periodic face may be nearer than `reach`.
    #[inline(always)]
    pub fn near_periodic_face(&self, x: &Vect<D>, reach: f64) -> bool {
        (0..D).any(|axis| {
            self.periodic[axis]
                && (x[axis] - self.lower[axis] < reach || self.upper[axis] - x[axis] < reach)
        })
    }

    /// The domain, where images across periodic faces may be nearer to a place with this reach of its list.
    pub(crate) fn wrapping(&self, x: &Vect<D>, reach: f64) -> Option<&Self> {
        // The particle itself may have left the box by up to the skin since the last build.
        self.near_periodic_face(x, 2.0 * reach).then_some(self)
    }

    /// True if the position is inside along the axes that are not periodic.
    pub fn contains(&self, x: &Vect<D>) -> bool {
        (0..D).all(|a| self.periodic[a] || (x[a] >= self.lower[a] && x[a] <= self.upper[a]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 m by 1 m, periodic along x.
    fn channel() -> Domain<2> {
        Domain {
            lower: Vect::<2>::new(-0.5, 0.0),
            upper: Vect::<2>::new(1.5, 1.0),
            periodic: [true, false],
        }
    }

    #[test]
    fn an_image_is_half_a_period_away_at_most_and_whole_periods_off() {
        let channel = channel();
        for k in -40..=40 {
            let d = Vect::<2>::new(0.0731 * f64::from(k), 0.9 * f64::from(k));
            let near = channel.nearest(d);
            let periods = (d[0] - near[0]) / 2.0;
            assert!(near[0].abs() <= 1.0 && (periods - periods.round()).abs() < 1e-14);
            assert_eq!(near[1], d[1], "not periodic");
            // Separations within the box are one period off at most.
            if d[0].abs() < 2.0 {
                assert_eq!(channel.nearest_image(d), near, "{d}");
            }
        }
    }

    #[test]
    fn lanes_have_the_bits_of_numbers() {
        let channel = channel();
        for x in [-2.0, -1.0 - 1e-15, -1.0, -0.3, 0.0, 1.0, 1.0 + 1e-15, 1.9] {
            let d = Vect::<2>::new(x, -x);
            let lanes = channel.nearest_images::<f64>([x, -x]);
            assert_eq!(Vect::from(lanes), channel.nearest_image(d), "{x}");
        }
    }

    /// The upper face is the lower one, also for positions that rounding puts on it.
    #[test]
    fn a_place_is_wrapped_to_the_one_that_it_is() {
        let channel = channel();
        let at = |x: f64| channel.wrapped(Vect::<2>::new(x, 7.0));
        for (x, wrapped) in [
            (-0.5, -0.5),
            (1.5, -0.5),
            (1.25, 1.25),
            (-0.75, 1.25),
            (9.75, 1.75 - 2.0),
            (-0.5 - 1e-16, -0.5),
        ] {
            assert_eq!(at(x), Vect::<2>::new(wrapped, 7.0), "{x}");
        }
        let unit = Domain {
            periodic: [true],
            ..Domain::open(Vect::<1>::new(0.0), Vect::<1>::new(1.0))
        };
        assert_eq!(unit.wrapped(Vect::<1>::new(-1e-20))[0], 0.0);
        assert!(channel.contains(&Vect::<2>::new(99.0, 0.5)));
        assert!(!channel.contains(&Vect::<2>::new(0.0, 1.1)));
    }
}

//! The box the flow lives in, and which of its directions are periodic.

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

    /// Whether any axis is periodic.
    pub fn any_periodic(&self) -> bool {
        self.periodic.iter().any(|p| *p)
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

    /// Whether an image across a periodic face may be nearer than `reach`.
    #[inline(always)]
    pub fn near_periodic_face(&self, x: &Vect<D>, reach: f64) -> bool {
        (0..D).any(|axis| {
            self.periodic[axis]
                && (x[axis] - self.lower[axis] < reach || self.upper[axis] - x[axis] < reach)
        })
    }

    /// Whether the position is inside along the axes that are not periodic.
    pub fn contains(&self, x: &Vect<D>) -> bool {
        (0..D).all(|a| self.periodic[a] || (x[a] >= self.lower[a] && x[a] <= self.upper[a]))
    }
}

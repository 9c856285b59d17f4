//! A region in a box that may be periodic: depths across the period, where lattices start.

use crate::{Polygon, Region, Shape};

/// A relative length that counts as rounding.
pub(crate) const ROUNDING: f64 = 1e-6;

/// A region with its periodic images.
pub(crate) struct PeriodicRegion<'a, const D: usize> {
    base: Periodic<'a, D>,
    cuts: Vec<Periodic<'a, D>>,
    periods: [Option<[f64; 2]>; D],
    shifts: Vec<[f64; D]>,
}

struct Periodic<'a, const D: usize> {
    shape: &'a Shape<D>,
    /// Axes along which the shape fills the period: its surfaces there are none.
    spans: [bool; D],
}

impl<'a, const D: usize> PeriodicRegion<'a, D> {
    pub fn new(region: &'a Region<D>, spacing: f64, periods: &[Option<[f64; 2]>; D]) -> Self {
        let periodic = |shape: &'a Shape<D>| Periodic {
            shape,
            spans: spans(shape, spacing, periods),
        };
        let mut shifts = vec![[0.0; D]];
        for k in 0..D {
            let Some([lo, hi]) = periods[k] else { continue };
            for n in 0..shifts.len() {
                for sign in [-1.0, 1.0] {
                    let mut shift = shifts[n];
                    shift[k] = sign * (hi - lo);
                    shifts.push(shift);
                }
            }
        }
        PeriodicRegion {
            base: periodic(&region.base),
            cuts: region.cuts.iter().map(periodic).collect(),
            periods: *periods,
            shifts,
        }
    }

    /// Axes along which the region fills the period.
    pub fn spans(&self) -> [bool; D] {
        self.base.spans
    }

    /// Shifts to all images, the first of them none.
    pub fn shifts(&self) -> &[[f64; D]] {
        &self.shifts
    }

    /// Lower and upper corner of the box around the region, m.
    pub fn bounds(&self) -> ([f64; D], [f64; D]) {
        self.base.shape.bounds()
    }

    /// Distance from the surface, positive inside; surfaces across a filled period do not count.
    pub fn depth(&self, x: &[f64; D]) -> f64 {
        let x = wrapped(x, &self.periods);
        let of = |part: &Periodic<D>| part.depth(&x, &self.shifts, &self.periods);
        let cuts = self.cuts.iter().map(|c| -of(c));
        cuts.fold(of(&self.base), f64::min)
    }
}

impl<const D: usize> Periodic<'_, D> {
    fn depth(&self, x: &[f64; D], shifts: &[[f64; D]], periods: &[Option<[f64; 2]>; D]) -> f64 {
        let moved = |s: &[f64; D]| -> [f64; D] { std::array::from_fn(|k| x[k] - s[k]) };
        let deepest = |shape: &Shape<D>| {
            let depths = shifts.iter().map(|s| shape.depth(&moved(s)));
            depths.fold(f64::NEG_INFINITY, f64::max)
        };
        match self.shape {
            Shape::Cuboid { lo, hi } => {
                let far = |k: usize| match self.spans[k] {
                    true => 4.0 * (hi[k] - lo[k]),
                    false => 0.0,
                };
                deepest(&Shape::Cuboid {
                    lo: std::array::from_fn(|k| lo[k] - far(k)),
                    hi: std::array::from_fn(|k| hi[k] + far(k)),
                })
            }
            Shape::Polygon(polygon) if self.spans.contains(&true) => {
                self.across(polygon, [0, 1], x, shifts, periods)
            }
            Shape::Extrusion {
                polygon,
                axis,
                ends,
            } if self.spans.contains(&true) => {
                let mut rest = (0..D).filter(|k| k != axis);
                let axes = std::array::from_fn(|_| rest.next().unwrap_or(0));
                let side = self.across(polygon, axes, x, shifts, periods);
                let end = |s: &[f64; D]| {
                    let at = x[*axis] - s[*axis];
                    (at - ends[0]).min(ends[1] - at)
                };
                match self.spans[*axis] {
                    true => side,
                    false => side.min(shifts.iter().map(end).fold(f64::NEG_INFINITY, f64::max)),
                }
            }
            Shape::Cylinder { from, to, radius } if self.spans.contains(&true) => {
                let far = |a: &[f64; D], b: &[f64; D]| {
                    std::array::from_fn(|k| a[k] + 4.0 * (a[k] - b[k]))
                };
                deepest(&Shape::Cylinder {
                    from: far(from, to),
                    to: far(to, from),
                    radius: *radius,
                })
            }
            // It has no images: a wave that fits the period is its own.
            Shape::Side { .. } | Shape::OverWave(_) => self.shape.depth(x),
            shape => deepest(shape),
        }
    }

    /// Distance from the sides of a polygon in the plane of two axes that are no ends of the
    /// period, positive inside.
    fn across(
        &self,
        polygon: &Polygon,
        axes: [usize; 2],
        x: &[f64; D],
        shifts: &[[f64; D]],
        periods: &[Option<[f64; 2]>; D],
    ) -> f64 {
        let [lo, hi] = sph_core::bounds(polygon.points().iter().copied());
        let sealed = |a: [f64; 2], b: [f64; 2]| {
            (0..2).any(|k| {
                let near = ROUNDING * (hi[k] - lo[k]);
                let on = |plane: f64| (a[k] - plane).abs() <= near && (b[k] - plane).abs() <= near;
                self.spans[axes[k]] && (on(lo[k]) || on(hi[k]))
            })
        };
        let away = |s: &[f64; D]| {
            let flat = axes.map(|k| x[k] - s[k]);
            polygon.distance(flat, |a, b| !sealed(a, b))
        };
        let away = shifts.iter().map(away).fold(f64::INFINITY, f64::min);
        // A point on a plane that is no surface is judged just beside the plane.
        let beside = std::array::from_fn(|k| match (self.spans[axes[k]], periods[axes[k]]) {
            (true, Some(_)) => {
                let step = ROUNDING * (hi[k] - lo[k]);
                x[axes[k]].clamp(lo[k] + step, hi[k] - step)
            }
            _ => x[axes[k]],
        });
        match polygon.contains(beside) {
            true => away,
            false => -away,
        }
    }
}

/// Axes along which a shape fills the period; a round one never does, and a cylinder only along its
/// own axis.
pub(crate) fn spans<const D: usize>(
    shape: &Shape<D>,
    spacing: f64,
    periods: &[Option<[f64; 2]>; D],
) -> [bool; D] {
    let (lo, hi) = shape.bounds();
    let near = ROUNDING * spacing;
    std::array::from_fn(|k| match (shape, periods[k]) {
        (Shape::Ball { .. } | Shape::Ellipse { .. } | Shape::Cone { .. }, _) | (_, None) => false,
        (Shape::Cylinder { from, to, .. }, _) if (0..D).any(|j| j != k && from[j] != to[j]) => {
            false
        }
        (_, Some(period)) => lo[k] <= period[0] + near && hi[k] >= period[1] - near,
    })
}

/// The point's image inside the period.
pub(crate) fn wrapped<const D: usize>(x: &[f64; D], periods: &[Option<[f64; 2]>; D]) -> [f64; D] {
    std::array::from_fn(|k| match periods[k] {
        Some([lo, hi]) if x[k] < lo || x[k] >= hi => {
            let image = lo + (x[k] - lo).rem_euclid(hi - lo);
            if image < hi { image } else { lo }
        }
        _ => x[k],
    })
}

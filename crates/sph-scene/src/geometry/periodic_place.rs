//! A region in a box that may be periodic: depths across the period, where lattices start.

use crate::geometry::shapes::axes_across;
use crate::{Polygon, Region, Shape};

/// A relative length that counts as rounding.
pub(crate) const ROUNDING: f64 = 1e-6;

/// A region with its periodic images.
pub(crate) struct PeriodicRegion<'a, const D: usize> {
    base: Part<'a, D>,
    cuts: Vec<Part<'a, D>>,
    periods: [Option<[f64; 2]>; D],
    /// Shifts to all images, the first of them none.
    pub shifts: Vec<[f64; D]>,
}

/// A shape, and the axes along which it fills the period: its surfaces there are none.
type Part<'a, const D: usize> = (&'a Shape<D>, [bool; D]);

impl<'a, const D: usize> PeriodicRegion<'a, D> {
    pub fn new(region: &'a Region<D>, spacing: f64, periods: &[Option<[f64; 2]>; D]) -> Self {
        let part = |shape: &'a Shape<D>| (shape, spans(shape, spacing, periods));
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
            base: part(&region.base),
            cuts: region.cuts.iter().map(part).collect(),
            periods: *periods,
            shifts,
        }
    }

    /// Axes along which the region fills the period.
    pub fn spans(&self) -> [bool; D] {
        self.base.1
    }

    /// Lower and upper corner of the box around the region, m.
    pub fn bounds(&self) -> ([f64; D], [f64; D]) {
        self.base.0.bounds()
    }

    /// Distance from the surface, positive inside; surfaces across a filled period do not count.
    pub fn depth(&self, x: &[f64; D]) -> f64 {
        let x = wrapped(x, &self.periods);
        let cuts = self.cuts.iter().map(|cut| -self.part_depth(*cut, &x));
        cuts.fold(self.part_depth(self.base, &x), f64::min)
    }

    fn part_depth(&self, (shape, spans): Part<'_, D>, x: &[f64; D]) -> f64 {
        let moved = |s: &[f64; D]| -> [f64; D] { std::array::from_fn(|k| x[k] - s[k]) };
        let deepest = |shape: &Shape<D>| {
            let depths = self.shifts.iter().map(|s| shape.depth(&moved(s)));
            depths.fold(f64::NEG_INFINITY, f64::max)
        };
        let spanned = spans.contains(&true);
        match shape {
            Shape::Cuboid { lo, hi } => {
                let far = |k: usize| if spans[k] { 4.0 * (hi[k] - lo[k]) } else { 0.0 };
                deepest(&Shape::Cuboid {
                    lo: std::array::from_fn(|k| lo[k] - far(k)),
                    hi: std::array::from_fn(|k| hi[k] + far(k)),
                })
            }
            Shape::Polygon(polygon) if spanned => self.across(polygon, spans, [0, 1], x),
            Shape::Extrusion {
                polygon,
                axis,
                ends,
            } if spanned => {
                let side = self.across(polygon, spans, axes_across(*axis), x);
                let end = |s: &[f64; D]| {
                    let at = x[*axis] - s[*axis];
                    (at - ends[0]).min(ends[1] - at)
                };
                if spans[*axis] {
                    return side;
                }
                let ends = self.shifts.iter().map(end);
                side.min(ends.fold(f64::NEG_INFINITY, f64::max))
            }
            Shape::Cylinder { from, to, radius } if spanned => {
                let far = |a: &[f64; D], b: &[f64; D]| {
                    std::array::from_fn(|k| a[k] + 4.0 * (a[k] - b[k]))
                };
                let (from, to, radius) = (far(from, to), far(to, from), *radius);
                deepest(&Shape::Cylinder { from, to, radius })
            }
            // It has no images: a wave that fits the period is its own.
            Shape::Side { .. } | Shape::OverWave(_) => shape.depth(x),
            shape => deepest(shape),
        }
    }

    /// Distance from the sides of a polygon in the plane of two axes that are no ends of the period, positive inside.
    fn across(&self, polygon: &Polygon, spans: [bool; D], axes: [usize; 2], x: &[f64; D]) -> f64 {
        let [lo, hi] = polygon.bounds();
        let sealed = |a: [f64; 2], b: [f64; 2]| {
            (0..2).any(|k| {
                let near = ROUNDING * (hi[k] - lo[k]);
                let on = |plane: f64| (a[k] - plane).abs() <= near && (b[k] - plane).abs() <= near;
                spans[axes[k]] && (on(lo[k]) || on(hi[k]))
            })
        };
        let away = |s: &[f64; D]| {
            let flat = axes.map(|k| x[k] - s[k]);
            polygon.distance(flat, |a, b| !sealed(a, b))
        };
        let away = self.shifts.iter().map(away).fold(f64::INFINITY, f64::min);
        // A point on a plane that is no surface is judged just beside the plane.
        let beside = std::array::from_fn(|k| match spans[axes[k]] {
            true => {
                let step = ROUNDING * (hi[k] - lo[k]);
                x[axes[k]].clamp(lo[k] + step, hi[k] - step)
            }
            false => x[axes[k]],
        });
        let inside = polygon.contains(beside);
        if inside { away } else { -away }
    }
}

/// Axes along which a shape fills the period; a round one never does, and a cylinder only along its own axis.
pub(crate) fn spans<const D: usize>(
    shape: &Shape<D>,
    spacing: f64,
    periods: &[Option<[f64; 2]>; D],
) -> [bool; D] {
    let (lo, hi) = shape.bounds();
    let fills = fills((&lo, &hi), spacing, periods);
    let ends = |k: usize| match shape {
        Shape::Ball { .. } | Shape::Ellipse { .. } | Shape::Cone { .. } => false,
        Shape::Cylinder { from, to, .. } => (0..D).all(|j| j == k || from[j] == to[j]),
        _ => true,
    };
    std::array::from_fn(|k| fills[k] && ends(k))
}

/// Axes along which a box fills the period.
pub(crate) fn fills<const D: usize>(
    (lo, hi): (&[f64; D], &[f64; D]),
    spacing: f64,
    periods: &[Option<[f64; 2]>; D],
) -> [bool; D] {
    let near = ROUNDING * spacing;
    let within = |k: usize, [from, to]: [f64; 2]| lo[k] <= from + near && hi[k] >= to - near;
    std::array::from_fn(|k| periods[k].is_some_and(|period| within(k, period)))
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

//! The box of a zone, and the band around it.

use sph_boundary::Wall;
use sph_core::Vect;
use sph_scene::{Scene, Zone};

use super::sample::REACH;

/// Width of the band over the support of the finer particles: those of the zone have all neighbours in its inner half, and
/// these have all of theirs in the band.
const BAND: f64 = 2.0;

/// A box along the axes; along a period that it spans it has no sides.
#[derive(Clone, Debug)]
pub(crate) struct Frame<const D: usize> {
    low: Vect<D>,
    high: Vect<D>,
    /// Width of the band around it, m.
    pub band: f64,
    /// Corners of its core, in which the flow around is led by the zone.
    core: [Vect<D>; 2],
}

impl<const D: usize> Frame<D> {
    /// The box of a zone whose particles have a support, m.
    pub fn new(scene: &Scene, zone: &Zone, support: f64) -> Self {
        let periods = scene.numerics.periodic.bounds::<D>();
        let [low, high] = &zone.bounds;
        let spans = |k: usize| periods[k].is_some_and(|[lo, hi]| low[k] <= lo && hi <= high[k]);
        let end = |corner: &[f64], infinite: f64| {
            Vect::from_fn(|k, _| if spans(k) { infinite } else { corner[k] })
        };
        let (low, high) = (end(low, f64::NEG_INFINITY), end(high, f64::INFINITY));
        Frame {
            low,
            high,
            band: BAND * support,
            core: [low, high],
        }
    }

    /// With a core that begins a fit's radius behind each side with fluid before it; `spacing` is that around the zone, m.
    ///
    /// Between core and side both flows are computed: a flow that is fitted to the other at once copies its own errors.
    pub fn with_core(mut self, walls: Option<&dyn Wall<D>>, spacing: f64) -> Self {
        for axis in 0..D {
            for side in 0..2 {
                if self.is_open(walls, spacing, (axis, side)) {
                    let inwards = if side == 0 { 1.0 } else { -1.0 };
                    self.core[side][axis] += inwards * REACH * spacing;
                }
            }
        }
        self
    }

    /// True if there may be fluid before a side: a place in front of all walls.
    pub fn is_open(
        &self,
        walls: Option<&dyn Wall<D>>,
        spacing: f64,
        (axis, side): (usize, usize),
    ) -> bool {
        let Some(walls) = walls else {
            return true;
        };
        let ends = [self.low, self.high];
        if !ends[side][axis].is_finite() {
            return false;
        }
        let outwards = if side == 0 { -1.0 } else { 1.0 };
        // Along a period that the box spans all places are alike for what stands in it.
        let first = ends[side][axis] + 0.25 * outwards * spacing;
        let span = |k: usize| match (k == axis, self.low[k].is_finite()) {
            (true, _) => (first, outwards * spacing, 3),
            (false, true) => {
                let length = self.high[k] - self.low[k];
                let count = (length / spacing).ceil();
                (self.low[k], length / count, count as usize + 1)
            }
            (false, false) => (0.0, 0.0, 1),
        };
        let spans: [_; D] = std::array::from_fn(span);
        let places: usize = spans.iter().map(|(_, _, count)| count).product();
        (0..places).any(|mut place| {
            let x = Vect::from_fn(|k, _| {
                let (first, step, count) = spans[k];
                let number = place % count;
                place /= count;
                first + step * number as f64
            });
            walls.contains(&x)
        })
    }

    /// True if a place is in the box widened by a margin, m.
    pub fn holds(&self, x: &Vect<D>, margin: f64) -> bool {
        (0..D).all(|k| self.low[k] - margin <= x[k] && x[k] < self.high[k] + margin)
    }

    /// True if a place is in the outer half of the band, or beyond it.
    pub fn is_outer(&self, x: &Vect<D>) -> bool {
        !self.holds(x, 0.5 * self.band)
    }

    /// True if a place is in the core.
    pub fn in_core(&self, x: &Vect<D>) -> bool {
        (0..D).all(|k| self.core[0][k] <= x[k] && x[k] < self.core[1][k])
    }

    /// Corners of the box widened by a margin, m.
    pub fn corners(&self, margin: f64) -> [Vect<D>; 2] {
        [self.low.add_scalar(-margin), self.high.add_scalar(margin)]
    }
}

//! Segments seen from many points, side by side.

use sph_kernels::lanes::{Body, Lane, MOST, dispatch};

use super::renormalisation::{OnLine, Renormalisation2d, SegmentIntegral};

/// Segments in reach of the points that see them, one after the other; kept for its memory.
#[derive(Debug, Default)]
pub struct SegmentBatch {
    height: Vec<f64>,
    along: [Vec<f64>; 2],
    distance2: [Vec<f64>; 2],
    /// h ∫ w dS and Γ of the discs.
    discs: [Vec<f64>; 2],
    /// The segment, and the height of the point over its line, m.
    pub(crate) seen: Vec<(u32, f64)>,
    /// Segments up to and including each point's.
    pub(crate) ends: Vec<usize>,
}

impl SegmentBatch {
    pub(crate) fn clear(&mut self) {
        let [along, distance2] = [&mut self.along, &mut self.distance2];
        let all = along.iter_mut().chain(distance2);
        all.chain([&mut self.height]).for_each(Vec::clear);
        self.seen.clear();
        self.ends.clear();
    }

    pub(crate) fn end(&mut self) {
        self.ends.push(self.seen.len());
    }

    #[inline(always)]
    fn at(&self, k: usize) -> OnLine<f64> {
        OnLine {
            height: self.height[k],
            along: [self.along[0][k], self.along[1][k]],
            distance2: [self.distance2[0][k], self.distance2[1][k]],
        }
    }
}

impl Renormalisation2d {
    /// Adds a segment if it is in reach; arguments as of [`segment`](Renormalisation2d::segment).
    #[inline(always)]
    pub(crate) fn see(
        &self,
        batch: &mut SegmentBatch,
        segment: u32,
        ends: [[f64; 2]; 2],
        normal: [f64; 2],
    ) {
        let seen = self.on_line(ends[0], ends[1], normal);
        let support = self.support;
        if seen.height.abs() >= support || seen.along[0] >= support || seen.along[1] <= -support {
            return;
        }
        batch.height.push(seen.height);
        for k in 0..2 {
            batch.along[k].push(seen.along[k]);
            batch.distance2[k].push(seen.distance2[k]);
        }
        let distance = -(normal[0] * ends[0][0] + normal[1] * ends[0][1]);
        batch.seen.push((segment, distance));
    }

    pub(crate) fn weigh(&self, batch: &mut SegmentBatch) {
        // The last vector is filled up with segments out of reach.
        let all = batch.height.len();
        let full = all.next_multiple_of(MOST);
        let away = 2.0 * self.support;
        batch.height.resize(full, away);
        for k in 0..2 {
            batch.along[k].resize(full, 0.0);
            batch.distance2[k].resize(full, away * away);
            batch.discs[k].resize(full, 0.0);
        }
        dispatch(Discs {
            integrals: self,
            batch,
        });
    }

    #[inline(always)]
    pub(crate) fn weighed(&self, batch: &SegmentBatch, k: usize) -> SegmentIntegral {
        self.finished(&batch.at(k), [batch.discs[0][k], batch.discs[1][k]])
    }
}

struct Discs<'a> {
    integrals: &'a Renormalisation2d,
    batch: &'a mut SegmentBatch,
}

impl Body for Discs<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lane>(self) {
        let SegmentBatch {
            height,
            along,
            distance2,
            discs,
            ..
        } = self.batch;
        for from in (0..height.len()).step_by(L::N) {
            let [y1, y2] = along;
            let [q1, q2] = distance2;
            let seen = OnLine {
                height: L::load(&height[from..]),
                along: [L::load(&y1[from..]), L::load(&y2[from..])],
                distance2: [L::load(&q1[from..]), L::load(&q2[from..])],
            };
            let [kernel, gamma] = self.integrals.discs(&seen);
            kernel.store(&mut discs[0][from..]);
            gamma.store(&mut discs[1][from..]);
        }
    }
}

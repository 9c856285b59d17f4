//! Faces that take fluid out and have air before a part of them.

use std::ops::Range;

use sph_core::Vect;

use crate::faces::Faces;

/// Share of an element with fluid before it below which air comes to the face; where rows are very uneven it does so for a
/// moment in a full pipe, which passes its rate all the same.
const AIR: f64 = 0.5;

/// Dry share of the elements within a support from which on water goes as if it were alone.
const BESIDE: f64 = 0.2;

impl<const D: usize> Faces<D> {
    /// Lets a face that takes fluid out idle as far as it draws air: nothing happens before a full face.
    ///
    /// Air is light. So a face that draws it does not suck: the pressure is not below that of a surface, p ≥ 0, and with the
    /// characteristic that leaves the fluid water goes out with u_i − p_i/ρc at most. Water that comes faster than the face
    /// asks for takes the place of the air: the dry part of the volume is shared out among the elements with air beside
    /// them. Else ρc (u − u_i) would throw jets back. Drops go with their own velocity. Nothing comes in.
    pub(crate) fn draw_air(&mut self, own: Range<usize>) {
        if own.clone().all(|k| self.inside[k].filled >= AIR) {
            return;
        }
        let (mut spare, mut wanted) = (0.0, 0.0);
        for k in own.clone() {
            let [aim, faster] = self.speeds(k);
            let (measure, filled) = (self.places[k].measure, self.inside[k].filled);
            // Where the law has shared out its volume among the filled elements, there is no rest.
            if self.outside[k].share == Some(1.0) {
                spare -= measure * (1.0 - filled) * aim;
            }
            wanted += measure * filled * faster;
        }
        let part = if wanted > spare { spare / wanted } else { 1.0 };
        let idling: Vec<f64> = own.clone().map(|k| self.idling(k, part)).collect();
        for (k, normal) in own.zip(idling) {
            self.outside[k].velocity = self.places[k].normal * normal;
            self.outside[k].share = None;
            // A jet has no rows: a port beside it would stand in for fluid that is not there.
            self.lacking[k] *= 1.0 - self.isolation(k);
        }
    }

    /// Velocity along the normal that the law of an element imposes, and by how much the water before it goes out
    /// faster as far as air
    /// is beside it, m/s.
    fn speeds(&self, k: usize) -> [f64; 2] {
        let along = |u: &Vect<D>| u.dot(&self.places[k].normal);
        let aim = along(&self.outside[k].velocity);
        let faster = (aim - along(&self.inside[k].velocity)).max(0.0);
        [aim, faster * self.isolation(k)]
    }

    /// Degree to which water before an element moves as if it were alone: 1 from a [share](BESIDE) of dry elements
    /// around it on.
    fn isolation(&self, k: usize) -> f64 {
        let around = self.smooth[k].iter();
        let [dry, whole] = around.fold([0.0, 0.0], |[dry, whole], (j, w)| {
            [dry + w * (1.0 - self.inside[*j as usize].filled), whole + w]
        });
        (dry / (BESIDE * whole)).min(1.0)
    }

    /// Velocity along the normal with which an element lets out where the face draws air, m/s; `part` is the share of
    /// faster inflow that takes the place of air.
    fn idling(&self, k: usize, part: f64) -> f64 {
        let inside = &self.inside[k];
        let within = inside.velocity.dot(&self.places[k].normal);
        if !inside.wet {
            return within.min(0.0);
        }
        let [aim, faster] = self.speeds(k);
        let unsucked = within - inside.pressure.max(0.0) / inside.impedance;
        (aim - part * faster).max(unsucked).min(0.0)
    }
}

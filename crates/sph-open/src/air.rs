//! Faces that take fluid out and have air before a part of them.

use std::ops::Range;

use sph_core::Vect;

use crate::faces::Faces;

/// Share of an element with fluid before it below which air comes to the face: uneven rows leave more.
const AIR: f64 = 0.5;

impl<const D: usize> Faces<D> {
    /// Lets a face that takes fluid out idle as far as it draws air: nothing happens before a full face.
    ///
    /// Air is light. So a face that draws it does not suck: the pressure is not below that of a surface, p ≥ 0, and with the
    /// characteristic that leaves the fluid water goes out with u_i − p_i/ρc at most. What comes faster than the face asks for
    /// takes the place of the air beside it: an element passes as much as the elements within a support are asked for. A jet
    /// would be thrown back by ρc (u − u_i) else. Where there are drops they go with their own velocity. Nothing comes in.
    pub(crate) fn draw_air(&mut self, own: Range<usize>) {
        if own.clone().all(|k| self.inside[k].filled >= AIR) {
            return;
        }
        let idling: Vec<f64> = own.clone().map(|k| self.idling(k)).collect();
        for (k, normal) in own.zip(idling) {
            self.outside[k].velocity = self.places[k].normal * normal;
            self.outside[k].share = None;
        }
    }

    /// Velocity along the normal with which an element lets out where the face draws air, m/s.
    fn idling(&self, k: usize) -> f64 {
        let (inside, outside) = (&self.inside[k], &self.outside[k]);
        let along = |u: &Vect<D>| u.dot(&self.places[k].normal);
        let (within, aim) = (along(&inside.velocity), along(&outside.velocity));
        if !inside.wet {
            return within.min(0.0);
        }
        let around = self.smooth[k].iter();
        let [filled, whole] = around.fold([0.0, 0.0], |[filled, whole], (j, w)| {
            [filled + w * self.inside[*j as usize].filled, whole + w]
        });
        let most = match outside.share {
            Some(share) if share >= 1.0 && filled > 0.0 => aim * whole / filled,
            _ => aim,
        };
        let unsucked = within - inside.pressure.max(0.0) / inside.impedance;
        aim.min(within.max(most)).max(unsucked).min(0.0)
    }
}

//! The pressure of a face, taken out of what an uneven arrangement of particles makes of it.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

use crate::faces::{CLOSED, Faces};

/// Shares of a full support, ΣVw/γ, below which a particle is at a free surface, and from which on it is in the bulk.
const SURFACE: [f64; 2] = [0.85, 0.95];

impl<const D: usize> Faces<D> {
    /// Kicks particles before open faces so that a pressure that is the same everywhere does not move them.
    ///
    /// The gradient of the pressure is a sum of pressures, so that momentum is kept. Of a constant pressure r it makes the
    /// force −r ε/γ_a,
    ///
    ///   ε_a = Σ_b θ_b (V_a² + V_b²) ∇w_ab − Σ_s (V_a² + V_s²)/V_s ∇γ_as,
    ///
    /// which is zero for rows that have come to rest before a wall, and not for rows that pass a face: of a lattice it
    /// is up to 0.085 γ_a V_a²/δr (h = 2 δr). It throws back 4 to 8 % of a pulse. Momentum passes an open face anyway,
    /// so the gradient is that of p − r, with the pressure at the face for r: the mean of its elements by their
    /// |∇γ_as|. This fades from half of the support on, and at a free surface.
    pub fn balance(&self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        let mut velocity = world.free.take(fields::VELOCITY)?;
        let free = &world.free;
        let (mass, gamma) = (free.get(fields::MASS)?, free.get(fields::RENORMALISATION)?);
        let all = velocity.par_iter_mut().enumerate().with_min_len(1024);
        all.try_for_each(|(i, u)| {
            let pressure = self.pressure_before(world, i);
            if pressure != 0.0 {
                *u += self.unevenness(world, i)? * (pressure * dt / (mass[i] * gamma[i]));
            }
            Ok::<_, StepError>(())
        })?;
        Ok(world.free.put(fields::VELOCITY, velocity)?)
    }

    /// Pressure of the faces that a particle sees, Pa: 0 where it sees none.
    fn pressure_before(&self, world: &World<D>, i: usize) -> f64 {
        let (mut sum, mut weight, mut nearest) = (0.0, 0.0, f64::INFINITY);
        for contact in world.walls.contacts.of(i) {
            if self.open[contact.element as usize] != CLOSED {
                let w = contact.gradient.norm();
                sum += w * world.walls.elements.pressure[contact.element as usize];
                weight += w;
                nearest = f64::min(nearest, contact.distance);
            }
        }
        let fades = 2.0 * (1.0 - nearest / world.kernel.support_radius());
        match weight > 0.0 && fades > 0.0 {
            true => sum / weight * fades.min(1.0),
            false => 0.0,
        }
    }

    /// ε_a of [`balance`](Self::balance), 0 at a free surface.
    fn unevenness(&self, world: &World<D>, i: usize) -> Result<Vect<D>, StepError> {
        let free = &world.free;
        let (position, volume) = (free.get(fields::POSITION)?, free.get(fields::VOLUME)?);
        let gamma = free.get(fields::RENORMALISATION)?[i];
        let (own, limit) = (volume[i], world.kernel.support_radius().powi(2));
        let mut filling = own * world.kernel.at(0.0).0;
        let mut sum = Vect::<D>::zeros();
        let mut add = |place: &Vect<D>, volume: f64, share: f64| {
            let apart = world.domain.nearest_image(position[i] - place);
            let r2 = apart.norm_squared();
            if r2 < limit {
                let (w, factor) = world.kernel.at(r2.sqrt());
                filling += share * volume * w;
                sum += apart * (share * (own * own + volume * volume) * factor);
            }
        };
        for &j in world.lists.free.candidates(i) {
            if j as usize != i {
                add(&position[j as usize], volume[j as usize], 1.0);
            }
        }
        let points = &world.walls.points;
        for &v in world.lists.wall.row(i) {
            let v = v as usize;
            add(&points.position[v], points.volume[v], points.share[v]);
        }
        for contact in world.walls.contacts.of(i) {
            let volume = world.walls.elements.volume[contact.element as usize];
            sum -= contact.gradient * ((own * own + volume * volume) / volume);
        }
        let [none, full] = SURFACE;
        let bulk = ((filling / gamma - none) / (full - none)).clamp(0.0, 1.0);
        Ok(sum * bulk)
    }
}

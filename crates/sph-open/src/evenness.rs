//! The pressure of a face, freed from the error of an uneven arrangement of particles.

use sph_core::{StepError, Vect, fields};
use sph_neighbours::{Around, Values, World, walk_into};

use crate::faces::{CLOSED, Faces};

/// Shares of a full support, ΣVw/γ, below which a particle is at a free surface, and from which on it is in the bulk. The
/// outer row of a lattice has 0.62 to 0.78, as for shifting.
const SURFACE: [f64; 2] = [0.85, 0.95];

/// Time in which rows arrange themselves to a pressure, over that in which sound crosses a support. Ours: long for a pulse of
/// sound, short for a wave of the surface.
const SLOW: f64 = 50.0;

impl<const D: usize> Faces<D> {
    /// Kicks particles before open faces so that sound does not move them where it is the same everywhere.
    ///
    /// The gradient of the pressure is a sum of pressures, so that momentum is kept. Of a constant pressure r it makes the
    /// force −r ε/γ_a,
    ///
    ///   ε_a = Σ_b θ_b (V_a² + V_b²) ∇w_ab − Σ_s (V_a² + V_s²)/V_s ∇γ_as,
    ///
    /// which is zero for rows that have come to rest before a wall, and not for rows that pass a face: of a lattice it
    /// is up to 0.085 γ_a V_a²/δr (h = 2 δr). It throws back 4 to 8 % of a pulse. Momentum passes an open face anyway,
    /// so the gradient is that of p − r, with the pressure at the face for r, of its elements by their |∇γ_as|. This fades
    /// from half of the support on, and at a free surface.
    ///
    /// Rows that stay arrange themselves to a slow pressure p̄, and the force keeps them even: without it still water below
    /// a level stirs itself. Of p̄ there is N²/(1 + N²) in r, with the number N of rows that pass in the time of the mean;
    /// nothing where the law [keeps rows even](crate::OpenBoundary::keeps_rows_even).
    pub fn balance(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError> {
        if self.memory.dt == 0.0 {
            return Ok(());
        }
        let mut kicks = std::mem::take(&mut self.kicks);
        kicks.resize(world.free.len(), Vect::zeros());
        let (mass, volume) = world.free.all((fields::MASS, fields::VOLUME))?;
        let elements = 0..self.elements.len();
        let taken: Vec<f64> = elements.map(|k| self.taken_out(k)).collect();
        let mut before = std::mem::take(&mut self.before);
        before.resize(world.free.len(), 0.0);
        for &i in &world.walls.contacts.particles {
            before[i as usize] = self.pressure_before(world, &taken, i as usize);
        }
        let sees = |i: usize| before[i] != 0.0;
        walk_into(world, Values::Both, sees, &mut kicks, |around| {
            let i = around.rows.particle;
            let factor = around.rows.inverse_renormalisation * dt / mass[i];
            unevenness(world, volume, around) * (before[i] * factor)
        })?;
        let mut velocity = world.free.take(fields::VELOCITY)?;
        for &i in &world.walls.contacts.particles {
            let kick = &mut kicks[i as usize];
            velocity[i as usize] += std::mem::replace(kick, Vect::zeros());
            before[i as usize] = 0.0;
        }
        self.before = before;
        world.free.put(fields::VELOCITY, velocity)?;
        self.kicks = kicks;
        Ok(())
    }

    /// Time over which pressures are slow before an element, s.
    pub fn slowly(&self, k: usize) -> f64 {
        let inside = &self.inside[k];
        SLOW * self.support * inside.density / inside.impedance
    }

    /// r of an element, Pa.
    fn taken_out(&self, k: usize) -> f64 {
        let (now, slow) = (self.outside[k].pressure, self.memory.slow[k]);
        let rows = self.memory.current[k] * self.slowly(k) / self.spacing;
        let stays = match self.faces[self.face_of[k]].law.keeps_rows_even() {
            true => 1.0,
            false => 1.0 / (1.0 + rows * rows),
        };
        now - slow + (1.0 - stays) * (slow + self.backgrounds[self.phase(k)])
    }

    /// Pressure of the faces that a particle sees, as far as it is `taken` out of their elements, Pa: 0 where it sees none.
    fn pressure_before(&self, world: &World<D>, taken: &[f64], i: usize) -> f64 {
        let (mut sum, mut weight, mut nearest) = (0.0, 0.0, f64::INFINITY);
        for contact in world.walls.contacts.of_particle(i) {
            let k = self.open[contact.element as usize];
            if k != CLOSED {
                let w = contact.gradient.norm();
                sum += w * taken[k as usize];
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
}

/// ε_a of [`Faces::balance`], 0 at a free surface.
fn unevenness<const D: usize>(world: &World<D>, volume: &[f64], around: &Around<'_, D>) -> Vect<D> {
    let rows = &around.rows;
    let own = volume[rows.particle];
    let mut filling = own * world.kernel.value_at_zero();
    let mut sum = Vect::<D>::zeros();
    for ((j, pair), w) in rows.free.pairs().zip(around.free) {
        let other = volume[j];
        filling += other * w;
        sum += pair.separation * ((own * own + other * other) * pair.factor);
    }
    let points = &world.walls.points;
    for ((v, pair), w) in rows.wall.pairs().zip(around.wall) {
        let (other, share) = (points.volume[v], points.share[v]);
        filling += share * other * w;
        sum += pair.separation * (share * (own * own + other * other) * pair.factor);
    }
    for contact in rows.contacts {
        let other = contact.volume;
        sum -= contact.gradient * ((own * own + other * other) / other);
    }
    let [none, full] = SURFACE;
    let filled = filling * rows.inverse_renormalisation;
    sum * ((filled - none) / (full - none)).clamp(0.0, 1.0)
}

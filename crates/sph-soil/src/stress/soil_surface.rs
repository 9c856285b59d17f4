//! Particles of a soil at its surface.

use sph_core::Vect;
use sph_neighbours::{Lane, LanePair, Neighbourhood, World, pair_sum};

/// Half angle of the empty cone above a surface particle: cos 45° in the plane, cos 30° in space.
fn cosine<const D: usize>() -> f64 {
    match D {
        2 => std::f64::consts::FRAC_1_SQRT_2,
        _ => 0.75_f64.sqrt(),
    }
}

/// |N| h below which a particle is taken to be surrounded evenly.
const EVEN: f64 = 0.1;

/// The soil around particles: Σ V ∇w against its outward normal, and whether there is any.
pub(crate) struct Grains<'a, S> {
    /// Of all particles, m^d.
    pub volume: &'a [f64],
    /// Test whether a particle is soil. Others do not hide a surface: water and air.
    pub soil: S,
}

#[pair_sum]
impl<const D: usize, S: Fn(usize) -> bool + Sync> Grains<'_, S> {
    /// The outward normal N = −Σ V ∇w, 1/m, and −Σ F, positive where there are grains.
    fn pair<L: Lane>(&self, _: &(), j: usize, pair: &LanePair<D, L>, sum: &mut ([L; D], L)) {
        if !(self.soil)(j) {
            return;
        }
        // ∇w points to the neighbour: against it is away from the grains.
        let weight = L::splat(self.volume[j]) * pair.factor;
        for k in 0..D {
            sum.0[k] -= pair.separation[k] * weight;
        }
        sum.1 -= pair.factor;
    }
}

impl<S: Fn(usize) -> bool> Grains<'_, S> {
    /// The normal −Σ V ∇w of the soil, 1/m, towards the missing part of the kernel, walls being filled; and whether no grain
    /// and no wall is in the cone around it of a particle with these sums and walls. One without grains around, −Σ F = 0, is at
    /// the surface.
    ///
    /// Source: the cone of Marrone et al. 2010, with neighbours of the soil only.
    pub fn surface<const D: usize>(
        &self,
        world: &World<D>,
        positions: &[Vect<D>],
        (normal, grains): ([f64; D], f64),
        rows: &Neighbourhood<'_, D>,
    ) -> (Vect<D>, bool) {
        let mut normal = Vect::from(normal);
        let points = &world.walls.points;
        // What is behind a wall counts as filled: the sum over a full neighbourhood is ∇γ.
        for (v, pair) in rows.wall.pairs() {
            normal -= pair.separation * (points.share[v] * points.volume[v] * pair.factor);
        }
        for contact in rows.contacts {
            normal += contact.gradient;
        }
        if grains <= 0.0 {
            return (normal, true);
        }
        let size = normal.norm();
        if size * world.kernel.smoothing_length() < EVEN {
            return (normal, false);
        }
        let outward = normal / size;
        let within = |apart: &Vect<D>| -apart.dot(&outward) > cosine::<D>() * apart.norm();
        let (i, limit) = (rows.particle, world.kernel.support_radius().powi(2));
        let blocks = |j: usize| {
            let apart = world.domain.nearest_image(positions[i] - positions[j]);
            j != i && (self.soil)(j) && apart.norm_squared() < limit && within(&apart)
        };
        let mut candidates = world.lists.nearest().candidates(i).iter();
        let blocked = candidates.any(|j| blocks(*j as usize));
        let at_surface = !blocked && !rows.wall.separation.iter().any(within);
        (normal, at_surface)
    }
}

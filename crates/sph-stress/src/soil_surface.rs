//! Which particles of a soil lie at its surface.

use sph_core::Vect;
use sph_neighbours::{Around, WallPoints};

/// Half angle of the empty cone above a surface particle: cos 45° in the plane, cos 30° in space.
fn cosine<const D: usize>() -> f64 {
    match D {
        2 => std::f64::consts::FRAC_1_SQRT_2,
        _ => 0.75_f64.sqrt(),
    }
}

/// |N| h below which a particle is taken to be surrounded evenly.
const EVEN: f64 = 0.1;

/// Whether no grain and no wall is in the cone around the outward normal N = −Σ V ∇w of the grains.
///
/// Everybody who is not `soil` is looked through: water and air. A particle without grains around
/// is at the surface.
///
/// Source: the cone of Marrone et al. 2010, with neighbours of the soil only.
pub fn at_surface<const D: usize>(
    around: &Around<'_, D>,
    points: &WallPoints<D>,
    volume: &[f64],
    length: f64,
    soil: impl Fn(usize) -> bool,
) -> bool {
    let rows = &around.rows;
    let mut normal = Vect::<D>::zeros();
    let mut grains = 0;
    for (k, &j) in rows.free.index.iter().enumerate() {
        let j = j as usize;
        if soil(j) {
            grains += 1;
            // ∇w points to the neighbour: against it is away from the grains.
            normal -= rows.free.separation[k] * (volume[j] * rows.free.factor[k]);
        }
    }
    if grains == 0 {
        return true;
    }
    // What is behind a wall counts as filled: the sum over a full neighbourhood is ∇γ.
    for (k, &v) in rows.wall.index.iter().enumerate() {
        let weight = points.share[v as usize] * points.volume[v as usize];
        normal -= rows.wall.separation[k] * (weight * rows.wall.factor[k]);
    }
    for contact in rows.contacts {
        normal += contact.gradient;
    }
    let size = normal.norm();
    if size * length < EVEN {
        return false;
    }
    let outward = normal / size;
    let within = |apart: &Vect<D>| -apart.dot(&outward) > cosine::<D>() * apart.norm();
    let free = rows.free.index.iter().zip(rows.free.separation);
    let mut above = free.filter(|(j, _)| soil(**j as usize));
    let blocked = above.any(|(_, apart)| within(apart));
    !blocked && !rows.wall.separation.iter().any(within)
}

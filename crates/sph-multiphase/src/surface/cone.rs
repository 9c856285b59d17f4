//! Particles at a free surface, by a cone test.

use rayon::prelude::*;
use sph_core::{Access, Field, Scalar, Stage, StepError, Vect, fields, stage};
use sph_neighbours::{Around, CHUNK, Values, World, walk_into};

/// Kind of a particle by its place: [`Place`] as a number.
pub const FREE_SURFACE: Field<Scalar> = Field::new(
    "free_surface",
    "1",
    "0 in the fluid, 1 within reach of a free surface, 2 at one, 3 alone",
);

/// Place of a particle, by the arrangement around it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// No free surface within the support.
    #[default]
    Inside,
    /// Within the support of a particle at a surface.
    Near,
    /// At a free surface.
    At,
    /// Its neighbours fill less of its support than it does itself.
    Alone,
}

impl Place {
    /// As it is written in [`FREE_SURFACE`].
    pub fn number(self) -> f64 {
        self as u8 as f64
    }
}

/// Cosine of the half angle of the cone that is empty over a surface, 45°.
const CONE: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A particle of a plane surface has half of its support filled: one with less looks out on two sides.
const HALF: f64 = 0.5;

/// |∇C| of a support that is full but for noise, over 1/R: it has no outward normal. In the first row of a plane surface it is
/// 1.1 to 1.4 (Wendland C2, h = 1.3 to 3 δr). Ours.
const FAINT: f64 = 0.2;

/// Kernel sum of a support above which no surface is searched. The empty cone alone takes 1/4 of a disc and 0.146 of a
/// ball, so that an even surface has at most 0.75 and 0.854. A crowded one may have more: it lacks nothing, and counts
/// as inside. Ours.
const FULL: f64 = 0.95;

/// The cone test: a particle is at a free surface where no neighbour lies within 45° of n = −∇C/|∇C|, C = Σθδr^d w, or where
/// less than half of its support is filled; alone, where its neighbours fill less of it than it does itself.
///
/// Volumes are those of the lattice, δr^d, so that the test does not depend on densities. Walls count in ∇C as filled.
/// Only particles whose support is filled to less than 0.95 are examined, where the sum is known from γρ − K.
///
/// Source: Marrone et al. 2010, J. Comput. Phys. 229, 3652–3663, §3.1, with the cone of the first step alone; the bounds for
/// sheets and lone particles are ours.
///
/// `sums`: densities are K and a sum.
pub(super) fn free_surface<const D: usize>(sums: bool) -> impl Stage<World<D>> {
    // Particles at the surface, then those near them.
    let mut access = Access::none().rings(2);
    access = access.both(fields::POSITION).writes(FREE_SURFACE);
    if sums {
        access = access
            .here((fields::MASS, fields::DENSITY, fields::DENSITY_CONSTANT))
            .where_there(fields::RENORMALISATION);
    }
    // Kept for its memory.
    let mut places = Vec::new();
    stage("free surface", access, move |world: &mut World<D>| {
        let mut surface = world.free.take(FREE_SURFACE)?;
        match sums {
            true => find(world, lacking(world)?, &mut places, &mut surface)?,
            false => find(world, |_| true, &mut places, &mut surface)?,
        }
        Ok(world.free.put(FREE_SURFACE, surface)?)
    })
}

/// Particles at a surface, among those that `wanted` names, then those near them.
fn find<const D: usize>(
    world: &World<D>,
    wanted: impl Fn(usize) -> bool + Sync,
    places: &mut Vec<Place>,
    surface: &mut [f64],
) -> Result<(), StepError> {
    places.clear();
    places.resize(world.free.len(), Place::Inside);
    let measured = |around: &Around<'_, D>| place(world, around);
    walk_into(world, Values::Both, wanted, places, measured)?;
    let places = &places[..];
    let lists = world.lists.nearest();
    let position = world.free.get(fields::POSITION)?;
    let reach2 = world.kernel.support_radius().powi(2);
    let at = |j: u32| places[j as usize] == Place::At;
    let hidden = &world.lists.hidden.particles;
    let near = |i: usize, candidates: &[u32]| {
        let all = candidates.iter().filter(|j| at(**j));
        let mut apart = all.map(|&j| (j, position[i] - position[j as usize]));
        let near = |r| world.domain.nearest_image(r).norm_squared() < reach2;
        apart.any(|(j, r)| near(r) && !hidden.has(i, j))
    };
    let blocks = surface.par_chunks_mut(CHUNK).enumerate();
    blocks.for_each(|(block, surface)| {
        // Particles of a cluster have the same candidates.
        let mut known: Option<(&[u32], bool)> = None;
        for (i, out) in (block * CHUNK..).zip(surface) {
            let candidates = lists.candidates(i);
            let any = match known {
                Some((of, any)) if std::ptr::eq(of, candidates) => any,
                _ => candidates.iter().any(|j| at(*j)),
            };
            known = Some((candidates, any));
            let place = match places[i] {
                Place::Inside if any && near(i, candidates) => Place::Near,
                other => other,
            };
            *out = place.number();
        }
    });
    Ok(())
}

/// Test whether the support of a particle lacks fluid: (γρ − K)δr^d/(γm) < 0.95.
fn lacking<const D: usize>(
    world: &World<D>,
) -> Result<impl Fn(usize) -> bool + Sync + '_, StepError> {
    let cell = world.spacing.powi(D as i32);
    let (mass, density) = world.free.all((fields::MASS, fields::DENSITY))?;
    let constant = world.free.get(fields::DENSITY_CONSTANT)?;
    let gamma = world.free.get(fields::RENORMALISATION).ok();
    Ok(move |i: usize| {
        let sum = density[i] - constant[i] / gamma.map_or(1.0, |g| g[i]);
        sum * cell < FULL * mass[i]
    })
}

/// Measures of the neighbourhood of a particle, but for surfaces of others.
fn place<const D: usize>(world: &World<D>, around: &Around<'_, D>) -> Place {
    let rows = &around.rows;
    let points = &world.walls.points;
    let cell = world.spacing.powi(D as i32);
    let own = cell * world.kernel.value_at_zero();
    let mut others = cell * around.free.iter().sum::<f64>();
    let mut gradient = Vect::<D>::zeros();
    for (separation, factor) in rows.free.separation.iter().zip(rows.free.factor) {
        gradient += separation * (cell * factor);
    }
    for ((v, pair), w) in rows.wall.pairs().zip(around.wall) {
        let part = points.share[v] * points.volume[v];
        others += part * w;
        gradient += pair.separation * (part * pair.factor);
    }
    let inverse = rows.inverse_renormalisation;
    if others * inverse < own {
        return Place::Alone;
    }
    let filling = (others + own) * inverse;
    if filling < HALF {
        return Place::At;
    }
    for contact in rows.contacts {
        gradient -= contact.gradient * filling;
    }
    let Some(inwards) = gradient.try_normalize(FAINT / world.kernel.support_radius()) else {
        return Place::Inside;
    };
    // Beside walls there may be more noise, and it may face the wall.
    let faces = |normal: &Vect<D>| normal.dot(&inwards) > CONE * normal.norm();
    if rows.contacts.iter().any(|contact| faces(&contact.gradient)) {
        return Place::Inside;
    }
    // Separations point from the neighbour to the particle.
    let pairs = rows.free.separation.iter().zip(rows.free.distance2);
    let mut seen = pairs.map(|(r, r2)| (r.dot(&inwards), r2));
    match seen.any(|(along, r2)| along > CONE * r2.sqrt()) {
        true => Place::Inside,
        false => Place::At,
    }
}

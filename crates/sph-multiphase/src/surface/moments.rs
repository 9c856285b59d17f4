//! Moments of supports that a free surface cuts.

use rayon::prelude::*;
use sph_core::{Access, Stage, Symmetric, Vect, fields, stage};
use sph_neighbours::{
    Lane, LanePair, Neighbourhood, PairSum, Particles, World, add_scaled, walk_in_lanes,
};

use super::half_space::HalfSpace;

sph_core::fields! {
    /// N_a/γ_a, by which a divergence becomes exact for linear velocities: 0 where the support is full.
    pub MOMENT_EXCESS: SymmetricTensor = "moment_excess", "1",
        "inverse of the first moment of a support cut by a free surface, less one, over γ";
    /// The share of a support that the arrangement explains as lacking.
    pub(super) EXPLAINED_DEFICIT: Scalar = "explained_deficit", "1",
        "share of the support that the free surface takes, by its place";
}

/// Share of a support that lacks, from which N counts as a whole. Ours: where N starts with a lack of 0.01, and K′ with it, a
/// wave loses three times as much.
const LACKING: f64 = 0.03;

/// ‖N‖ up to which N counts as a whole, and from which not at all, for sheets and tips: 1.1 in the first row of a plane
/// surface. Ours, not varied.
const WHOLE: [f64; 2] = [1.5, 3.0];

/// Share of a support that lacks in an uneven arrangement, besides a plane surface. Ours, not varied.
const UNEVEN: f64 = 0.05;

/// Σ w, Σ ∇w and −Σ r⊗∇w of free neighbours.
struct Moments;

impl<const D: usize> PairSum<D> for Moments {
    const VALUES: bool = true;
    const SCALED: bool = true;
    type Own<L: Lane> = ();
    type Sum<L: Lane> = (L, [L; D], [L; 6]);

    #[inline(always)]
    fn own<L: Lane>(&self, _: Particles) {}
    #[inline(always)]
    fn pair<L: Lane>(&self, _: &(), _: usize, pair: &LanePair<D, L>, sum: &mut Self::Sum<L>) {
        sum.0 += pair.value;
        add_scaled(&mut sum.1, &pair.separation, pair.factor);
        let r = &pair.separation;
        for i in 0..D {
            for j in i..D {
                sum.2[Symmetric::PLACE[i][j]] -= r[i] * r[j] * pair.factor;
            }
        }
    }
}

/// N/γ and the explained deficit of every particle.
pub(super) fn moments<const D: usize>() -> impl Stage<World<D>> {
    let access = Access::none()
        .both(fields::POSITION)
        .writes((MOMENT_EXCESS, EXPLAINED_DEFICIT));
    // Kept for their memory.
    let (mut half_space, mut all) = (None, Vec::new());
    let name = "moments at free surfaces";
    stage(name, access, move |world: &mut World<D>| {
        let table = || HalfSpace::new(&*world.kernel, D);
        let half_space = half_space.get_or_insert_with(table);
        all.resize(world.free.len(), (Symmetric::ZERO, 0.0));
        let found = |sums, rows: &Neighbourhood<'_, D>| at_surface(world, half_space, sums, rows);
        walk_in_lanes(world, &Moments, |_| true, &mut all, found)?;
        let mut excess = world.free.take(MOMENT_EXCESS)?;
        let mut deficit = world.free.take(EXPLAINED_DEFICIT)?;
        let columns = excess.par_iter_mut().zip(&mut deficit).zip(&all);
        columns.for_each(|((n, d), of)| (*n, *d) = *of);
        world.free.put(MOMENT_EXCESS, excess)?;
        Ok(world.free.put(EXPLAINED_DEFICIT, deficit)?)
    })
}

/// N/γ and the explained deficit of a particle.
fn at_surface<const D: usize>(
    world: &World<D>,
    half_space: &HalfSpace,
    (values, slopes, moments): (f64, [f64; D], [f64; 6]),
    rows: &Neighbourhood<'_, D>,
) -> (Symmetric, f64) {
    let (kernel, points) = (&*world.kernel, &world.walls.points);
    let cell = world.spacing.powi(D as i32);
    let scale = rows.scale().filter(|_| world.walls.scales);
    let own = scale.map_or(kernel.value_at_zero(), |scale| scale.own_value);
    let (mut filling, mut slope) = (cell * (own + values), Vect::from(slopes) * cell);
    let mut moment = Symmetric(moments) * cell;
    let mut normal = scale.map_or(Vect::zeros(), |scale| scale.slope);
    for (k, &v) in rows.wall.index.iter().enumerate() {
        let part = points.share[v as usize] * points.volume[v as usize];
        let (r, factor) = (rows.wall.separation[k], rows.wall.factor[k]);
        filling += part * kernel.at(rows.wall.distance2[k].sqrt()).0;
        slope += r * (part * factor);
        moment = moment - outer(&r) * (part * factor);
    }
    let inverse = match world.walls.scales {
        true => 1.0,
        false => rows.inverse_renormalisation,
    };
    if !world.walls.scales {
        rows.contacts.iter().for_each(|c| normal += c.gradient);
    }
    let (filling, moment) = (filling * inverse, moment * inverse);
    let along = match normal.try_normalize(0.0) {
        Some(n) => slope - n * n.dot(&slope),
        None => slope,
    };
    let plane = half_space.deficit(along.norm() * inverse);
    let lack = 1.0 - filling;
    let explained = plane + (lack - plane - UNEVEN).max(0.0);
    if lack <= 0.0 {
        return (Symmetric::ZERO, explained);
    }
    let moment = across(moment, &normal, filling);
    let Some(inverted) = moment.try_inverse() else {
        return (Symmetric::ZERO, explained);
    };
    let excess = inverted - nalgebra::Matrix3::identity();
    let fade = (WHOLE[1] - excess.norm()) / (WHOLE[1] - WHOLE[0]);
    let part = fade.clamp(0.0, 1.0) * (lack / LACKING).min(1.0);
    let excess: [[f64; 3]; 3] = (excess * (part * inverse)).into();
    (Symmetric::part_of(excess), explained)
}

/// r⊗r.
fn outer<const D: usize>(r: &Vect<D>) -> Symmetric {
    let mut product = Symmetric::ZERO;
    for i in 0..D {
        for j in i..D {
            product.0[Symmetric::PLACE[i][j]] = r[i] * r[j];
        }
    }
    product
}

/// The moment with the filling across a wall, in whose direction its half lacks fluid, as along a surface that meets the wall;
/// 1 in the direction that a plane has not.
fn across<const D: usize>(
    moment: Symmetric,
    normal: &Vect<D>,
    filling: f64,
) -> nalgebra::Matrix3<f64> {
    let mut matrix = moment.matrix();
    if D == 2 {
        matrix[(2, 2)] = 1.0;
    }
    let Some(normal) = normal.try_normalize(0.0) else {
        return matrix;
    };
    let n = nalgebra::Vector3::from_fn(|k, _| normal.get(k).copied().unwrap_or(0.0));
    let along = nalgebra::Matrix3::identity() - n * n.transpose();
    along * matrix * along + n * n.transpose() * filling
}

//! Moments of supports that a free surface cuts, and kernel sums below a plane surface.

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use sph_core::{Access, Stage, Symmetric, Vect, fields, stage};
use sph_kernels::{Sampler, gauss_points};
use sph_neighbours::{Lane, LanePair, Neighbourhood, World, add_scaled, pair_sum, walk_in_lanes};

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

#[pair_sum]
impl<const D: usize> Moments {
    const VALUES: bool = true;
    const SCALED: bool = true;

    fn pair<L: Lane>(
        &self,
        _: &(),
        _: usize,
        pair: &LanePair<D, L>,
        sum: &mut (L, [L; D], [L; 6]),
    ) {
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
    for (v, pair) in rows.wall.pairs() {
        let part = points.share[v] * points.volume[v];
        filling += part * kernel.at(pair.distance2.sqrt()).0;
        slope += pair.separation * (part * pair.factor);
        moment = moment - outer(&pair.separation) * (part * pair.factor);
    }
    let mut inverse = 1.0;
    if !world.walls.scales {
        inverse = rows.inverse_renormalisation;
        rows.contacts.iter().for_each(|c| normal += c.gradient);
    }
    let (filling, moment) = (filling * inverse, moment * inverse);
    let unit = normal.try_normalize(0.0);
    let along = unit.map_or(slope, |n| slope - n * n.dot(&slope));
    let plane = half_space.deficit(along.norm() * inverse);
    let lack = 1.0 - filling;
    let explained = plane + (lack - plane - UNEVEN).max(0.0);
    if lack <= 0.0 {
        return (Symmetric::ZERO, explained);
    }
    let Some(inverted) = across(moment, &normal, filling).try_inverse() else {
        return (Symmetric::ZERO, explained);
    };
    let excess = inverted - Matrix3::identity();
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
fn across<const D: usize>(moment: Symmetric, normal: &Vect<D>, filling: f64) -> Matrix3<f64> {
    let mut matrix = moment.matrix();
    if D == 2 {
        matrix[(2, 2)] = 1.0;
    }
    let Some(normal) = normal.try_normalize(0.0) else {
        return matrix;
    };
    let n = Vector3::from_fn(|k, _| normal.get(k).copied().unwrap_or(0.0));
    let along = Matrix3::identity() - n * n.transpose();
    along * matrix * along + n * n.transpose() * filling
}

const DEPTHS: usize = 256;

/// The share of the support that a plane surface takes, over the slope of the concentration: 1 − S(d) over w₁(d).
///
/// w₁(z) is the kernel integrated over the plane at a distance z (1/m), S(d) = ∫_{−∞}^d w₁ dz its share of a half-space at
/// a depth d (m) below the surface.
pub(super) struct HalfSpace {
    /// w₁ at growing depths, 1/m: it falls.
    slope: Vec<f64>,
    /// 1 − S there.
    deficit: Vec<f64>,
}

impl HalfSpace {
    pub(super) fn new(kernel: &dyn Sampler, dimension: usize) -> Self {
        let reach = kernel.support_radius();
        let depth = |k: usize| reach * k as f64 / DEPTHS as f64;
        let plane = |z: f64| -> f64 {
            let radius = (reach * reach - z * z).max(0.0).sqrt();
            let ring = |y: f64| match dimension {
                2 => 2.0,
                _ => 2.0 * std::f64::consts::PI * y,
            };
            let at = |y: f64| ring(y) * kernel.at((z * z + y * y).sqrt()).0;
            let points = gauss_points(0.0, radius, 16);
            points.map(|[y, part]| part * at(y)).sum()
        };
        let mut deficit = vec![0.0; DEPTHS + 1];
        for k in (0..DEPTHS).rev() {
            let row = gauss_points(depth(k), depth(k + 1), 1);
            deficit[k] = deficit[k + 1] + row.map(|[z, part]| part * plane(z)).sum::<f64>();
        }
        HalfSpace {
            slope: (0..=DEPTHS).map(|k| plane(depth(k))).collect(),
            deficit,
        }
    }

    /// 1 − S(d) at the depth d where w₁ is `slope`, 1/m: from 1/2 at the surface to 0.
    pub(super) fn deficit(&self, slope: f64) -> f64 {
        let k = self.slope.partition_point(|s| *s > slope);
        if k == 0 || k > DEPTHS {
            return self.deficit[k.min(DEPTHS)];
        }
        let part = (self.slope[k - 1] - slope) / (self.slope[k - 1] - self.slope[k]);
        self.deficit[k - 1] + part * (self.deficit[k] - self.deficit[k - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_kernels::{Kernel, by_name};

    #[test]
    fn a_plane_surface_takes_half_of_the_support_at_it_and_nothing_beyond() {
        for dimension in [2, 3] {
            let kernel = by_name("wendland-c2").unwrap().sampler(dimension, 0.5);
            let table = HalfSpace::new(&*kernel, dimension);
            let steepest = table.slope[0];
            assert!((table.deficit(2.0 * steepest) - 0.5).abs() < 1e-6);
            assert_eq!(table.deficit(0.0), 0.0);
            let falls = (1..100).map(|k| table.deficit(steepest * f64::from(k) / 100.0));
            assert!(falls.is_sorted());
        }
    }
}

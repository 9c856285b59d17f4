//! The distance to the free surface.

use rayon::prelude::*;
use sph_core::{BoxTree, Field, Scalar, StepError, Vect, fields};
use sph_neighbours::{Around, Values, World, walk, walk_some};

/// Distance to the nearest free surface, m.
pub const SURFACE_DISTANCE: Field<Scalar> = Field::new(
    "surface_distance",
    "m",
    "distance to the nearest particle at a free surface, plus half a spacing",
);

/// Share of a full support, ΣVw/γ, above which a particle is not at a surface, however its neighbours stand.
const FULL: f64 = 0.9;
/// Radius of the cone that is empty above a surface particle, in spacings.
const CONE: f64 = 2.0;
/// Cosine of half of its angle.
const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The distance of every particle to the free surface, m; NaN where there is none.
///
/// A particle is at the surface if its support is less than 90 % full, walls counted as full (ΣVw/γ < 0.9), and no other
/// is in the cone of 45° and two spacings that opens against ∇C, the gradient of that share. The surface is taken half a
/// spacing outside of such particles. On a lattice whose rows are parallel to a flat surface this is exact; elsewhere it is
/// right to a spacing.
///
/// It is computed for outputs, when they are written, and never in a step.
///
/// Source: the cone is that of Marrone et al. 2010, Eq. 9, with the spacing for its length; the rest is ours.
///
/// # Errors
/// If a column of the flow is missing.
pub fn surface_distance<const D: usize>(world: &World<D>) -> Result<Vec<f64>, StepError> {
    let positions = world.free.get(fields::POSITION)?;
    let surface = at_surface(world)?;
    let found = positions.iter().zip(&surface).filter(|(_, s)| **s);
    let places: Vec<Vect<D>> = found.flat_map(|(x, _)| images_of(world, *x)).collect();
    let tree = BoxTree::new(places.iter().map(|place| [(*place).into(); 2]).collect());
    let half = 0.5 * world.spacing;
    let distance = |x: &Vect<D>| {
        let apart = |k: usize| (x - places[k]).norm_squared();
        let nearest = tree.nearest((*x).into(), f64::INFINITY, apart);
        nearest.map_or(f64::NAN, |(apart, _)| apart.sqrt() + half)
    };
    let all = positions.par_iter().with_min_len(256).map(distance);
    Ok(all.collect())
}

/// A place and its images beyond periodic borders.
pub(crate) fn images_of<const D: usize>(world: &World<D>, x: Vect<D>) -> Vec<Vect<D>> {
    let mut all = vec![x];
    for axis in (0..D).filter(|a| world.domain.periodic[*a]) {
        let length = world.domain.length(axis);
        for k in 0..all.len() {
            for turn in [-1.0, 1.0] {
                let mut image = all[k];
                image[axis] += turn * length;
                all.push(image);
            }
        }
    }
    all
}

/// Marks of particles at a free surface.
fn at_surface<const D: usize>(world: &World<D>) -> Result<Vec<bool>, StepError> {
    let outward = outward(world)?;
    let reach = CONE * world.spacing;
    let empty = walk_some(
        world,
        Values::Gradient,
        |i| outward[i].is_some(),
        |around: &Around<'_, D>| {
            let Some(normal) = outward[around.rows.particle] else {
                return false;
            };
            let rows = &around.rows.free;
            let mut others = rows.separation.iter().zip(rows.distance2);
            // The separation points from the neighbour to the particle.
            !others.any(|(d, r2)| *r2 < reach * reach && -d.dot(&normal) > HALF * r2.sqrt())
        },
    )?;
    Ok(empty.into_iter().map(|e| e.unwrap_or(false)).collect())
}

/// The direction out of the fluid, of particles whose support is not full; zero where it has none.
fn outward<const D: usize>(world: &World<D>) -> Result<Vec<Option<Vect<D>>>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let points = &world.walls.points;
    let own = world.kernel.value_at_zero();
    walk(world, Values::Both, |around: &Around<'_, D>| {
        let (rows, i) = (&around.rows, around.rows.particle);
        let mut filling = volume[i] * own;
        let mut gradient = Vect::<D>::zeros();
        for (k, (&j, w)) in rows.free.index.iter().zip(around.free).enumerate() {
            let v = volume[j as usize];
            filling += v * w;
            gradient += rows.free.separation[k] * (v * rows.free.factor[k]);
        }
        for (k, (&v, w)) in rows.wall.index.iter().zip(around.wall).enumerate() {
            let part = points.share[v as usize] * points.volume[v as usize];
            filling += part * w;
            gradient += rows.wall.separation[k] * (part * rows.wall.factor[k]);
        }
        let share = filling * rows.inverse_renormalisation;
        for contact in rows.contacts {
            gradient -= contact.gradient * share;
        }
        (share < FULL).then(|| -gradient.try_normalize(0.0).unwrap_or_else(Vect::zeros))
    })
}

//! Friction velocities of particles on a bed of another phase.

use std::f64::consts::PI;

use sph_core::{Access, Stage, StepError, Vect, fields, stage};
use sph_kernels::Sampler;
use sph_neighbours::{Around, Values, World, walk_some};

use crate::columns::{BED_DISTANCE, BED_FRICTION_VELOCITY};
use crate::wall::{LEAST_DISTANCE, WallLaw};

/// Steps of the table and of its integrals.
const STEPS: usize = 200;

/// Share of the kernel that lies beyond a plane at a distance, m: ∫ w(r) A(r) dr over the caps A of spheres, by Simpson's rule.
fn kernel_beyond(kernel: &dyn Sampler, distance: f64) -> f64 {
    let width = kernel.support_radius() - distance;
    let cap = |r: f64| match kernel.dimension() {
        2 => 2.0 * r * (distance / r).min(1.0).acos(),
        _ => 2.0 * PI * r * (r - distance),
    };
    let at = |k: usize| {
        let r = distance + width * k as f64 / STEPS as f64;
        let weight = match k {
            0 | STEPS => 1.0,
            _ if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        match r > 0.0 {
            true => weight * kernel.at(r).0 * cap(r),
            false => 0.0,
        }
    };
    (0..=STEPS).map(at).sum::<f64>() * width / (3 * STEPS) as f64
}

/// The distance of a plane that has a share of the kernel beyond it, m; 0 for half of it and more.
fn distance_of(shares: &[f64], radius: f64, share: f64) -> f64 {
    let after = shares.partition_point(|s| *s > share);
    match after {
        0 => 0.0,
        k if k == shares.len() => radius,
        k => {
            let part = (shares[k - 1] - share) / (shares[k - 1] - shares[k]);
            radius * (k as f64 - 1.0 + part) / (shares.len() - 1) as f64
        }
    }
}

struct BedView<const D: usize> {
    distance: f64,
    slip: Vect<D>,
}

/// The bed of the phase `bed` as particles with a viscosity see it; `shares` are those of the kernel beyond planes.
fn bed_view<const D: usize>(
    world: &World<D>,
    (bed, shares): (u32, &[f64]),
    viscosities: impl Fn(usize) -> Option<f64> + Sync,
) -> Result<Vec<Option<Option<BedView<D>>>>, StepError> {
    let (phase, velocity) = world.free.all((fields::PHASE, fields::VELOCITY))?;
    let volume = world.free.get(fields::VOLUME)?;
    let points = &world.walls.points;
    let own = world.kernel.value_at_zero();
    let radius = world.kernel.support_radius();
    let wanted = |i: usize| viscosities(i).is_some();
    walk_some(world, Values::Both, wanted, |around: &Around<'_, D>| {
        let (rows, i) = (&around.rows, around.rows.particle);
        let mut filling = volume[i] * own;
        let (mut share, mut momentum) = (0.0, Vect::<D>::zeros());
        let mut towards = Vect::<D>::zeros();
        for (k, (&j, w)) in rows.free.index.iter().zip(around.free).enumerate() {
            let part = volume[j as usize] * w;
            filling += part;
            if phase[j as usize] == bed {
                share += part;
                momentum += velocity[j as usize] * part;
                let slope = volume[j as usize] * rows.free.factor[k];
                towards += rows.free.separation[k] * slope;
            }
        }
        for (&v, w) in rows.wall.index.iter().zip(around.wall) {
            filling += points.share[v as usize] * points.volume[v as usize] * w;
        }
        let normal = towards.try_normalize(0.0)?;
        let filling = (filling * rows.inverse_renormalisation).max(1.0);
        let distance = distance_of(shares, radius, share / filling);
        let slip = velocity[i] - momentum / share;
        (distance < world.spacing).then(|| BedView {
            distance: distance.max(LEAST_DISTANCE * world.spacing),
            slip: slip - normal * slip.dot(&normal),
        })
    })
}

/// [`BED_FRICTION_VELOCITY`] and [`BED_DISTANCE`] of particles within a spacing of a bed of the phase `bed`; ν of every phase,
/// m²/s, none of those without a bed.
pub(crate) fn bed_shear<const D: usize>(
    bed: u32,
    viscosities: Vec<Option<f64>>,
    law: WallLaw,
) -> impl Stage<World<D>> {
    let access = Access::none()
        .here(fields::POSITION)
        .both((fields::PHASE, fields::VELOCITY, fields::VOLUME))
        .where_there(fields::RENORMALISATION)
        .writes((BED_FRICTION_VELOCITY, BED_DISTANCE));
    // Shares of the kernel beyond a plane at equal steps of the distance, from 0 to the support radius; filled at first need.
    let mut shares = Vec::new();
    stage("rough bed", access, move |world: &mut World<D>| {
        if shares.is_empty() {
            let radius = world.kernel.support_radius();
            let at = |k: usize| kernel_beyond(&*world.kernel, radius * k as f64 / STEPS as f64);
            shares = (0..=STEPS).map(at).collect();
        }
        let mut friction = world.free.take(BED_FRICTION_VELOCITY)?;
        let mut distances = world.free.take(BED_DISTANCE)?;
        let phase = world.free.get(fields::PHASE)?;
        let viscosity = |i: usize| viscosities[phase[i] as usize];
        let seen = bed_view(world, (bed, &shares[..]), viscosity)?;
        for (i, seen) in seen.into_iter().enumerate() {
            (friction[i], distances[i]) = (0.0, f64::INFINITY);
            let (Some(nu), Some(Some(seen))) = (viscosity(i), seen) else {
                continue;
            };
            let found = law.friction_velocity(seen.slip.norm(), seen.distance, nu);
            friction[i] = found.map_err(|error| StepError::stage("rough bed", error))?;
            distances[i] = seen.distance;
        }
        world.free.put(BED_FRICTION_VELOCITY, friction)?;
        Ok(world.free.put(BED_DISTANCE, distances)?)
    })
}

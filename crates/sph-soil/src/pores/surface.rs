//! The surface of a soil, through which its pores drain.

use sph_core::{StepError, Vect, fields};
use sph_neighbours::{Rows, Surroundings, World, walk_in_lanes};

use super::surface_distance::SurfaceDistance;
use crate::stress::soil_surface::Grains;

/// A particle by which fluid goes in and out.
pub(crate) struct Outlet {
    /// Its index.
    pub particle: usize,
    /// Flux per pressure and mobility, m^(d−2).
    pub conductance: f64,
    /// Particles of the fluid in reach, with their shares of the flux; empty where the fluid is left out.
    pub fluid: Vec<(u32, f64)>,
}

/// Part of the kernel of a particle that is beyond the soil.
#[derive(Clone, Copy, Default)]
struct Exposure {
    /// |N|, 1/m.
    missing: f64,
    at_surface: bool,
}

/// The outlets of a soil, in ascending order: particles within a support of its surface. With `fluid` only those that it touches.
pub(crate) fn outlets<const D: usize>(
    world: &World<D>,
    soil: &(impl Fn(usize) -> bool + Sync),
    fluid: Option<&dyn Fn(usize) -> bool>,
    distance: &SurfaceDistance,
) -> Result<Vec<Outlet>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let positions = world.free.get(fields::POSITION)?;
    let exposures = exposures(world, soil, volume, positions)?;
    let limit = world.kernel.support_radius().powi(2);
    let mut near = vec![false; volume.len()];
    for i in (0..volume.len()).filter(|&i| exposures[i].at_surface) {
        near[i] = true;
        for &j in world.lists.nearest().candidates(i) {
            let j = j as usize;
            let apart = world.domain.nearest_image(positions[i] - positions[j]);
            near[j] |= soil(j) && apart.norm_squared() < limit;
        }
    }
    let surroundings = Surroundings::new(world)?;
    let mut rows = Rows::default();
    let outlet = |i: usize| {
        let missing = exposures[i].missing;
        let mut shares = Vec::new();
        if let Some(fluid) = fluid {
            let free = surroundings.neighbourhood(i, &mut rows).free;
            let both = free.index.iter().zip(free.factor);
            let touched = both.filter(|(j, _)| fluid(**j as usize));
            shares.extend(touched.map(|(j, f)| (*j, -f * volume[*j as usize])));
            let all: f64 = shares.iter().map(|(_, share)| share).sum();
            if all <= 0.0 {
                return None;
            }
            shares.iter_mut().for_each(|(_, share)| *share /= all);
        }
        Some(Outlet {
            particle: i,
            conductance: 2.0 * volume[i] * missing / distance.at(missing),
            fluid: shares,
        })
    };
    Ok((0..volume.len())
        .filter(|&i| near[i])
        .filter_map(outlet)
        .collect())
}

fn exposures<const D: usize>(
    world: &World<D>,
    soil: &(impl Fn(usize) -> bool + Sync),
    volume: &[f64],
    positions: &[Vect<D>],
) -> Result<Vec<Exposure>, StepError> {
    let grains = Grains { volume, soil };
    let mut exposures = vec![Exposure::default(); volume.len()];
    walk_in_lanes(world, &grains, soil, &mut exposures, |sums, rows| {
        let outward = grains.outward(world, sums.0, rows);
        Exposure {
            missing: outward.norm(),
            at_surface: grains.at_surface(world, positions, (outward, sums.1), rows),
        }
    })?;
    Ok(exposures)
}

//! The surface of a soil and the walls through which its pores drain and are fed.

use sph_core::{StepError, fields};
use sph_neighbours::{Rows, Surroundings, World, walk_in_lanes};

use crate::stress::soil_surface::Grains;

/// A particle by which fluid goes in and out.
pub(crate) struct Outlet {
    pub particle: usize,
    /// Flux per pressure and mobility, m^(d−2).
    pub conductance: f64,
    /// Particles of the fluid in reach, with their shares of the flux; empty where the fluid is left out.
    pub fluid: Vec<(u32, f64)>,
}

/// The outlets of a soil, in ascending order: particles within a support of its surface. With `fluid` only those that it touches.
pub(crate) fn outlets<const D: usize>(
    world: &World<D>,
    soil: &(impl Fn(usize) -> bool + Sync),
    fluid: Option<&dyn Fn(usize) -> bool>,
    distance: &SurfaceDistance,
) -> Result<Vec<Outlet>, StepError> {
    let (volume, positions) = world.free.all((fields::VOLUME, fields::POSITION))?;
    let grains = Grains { volume, soil };
    // |N|, 1/m, of the part of the kernel beyond the soil; and whether a particle is at the surface.
    let mut exposures = vec![(0.0, false); volume.len()];
    walk_in_lanes(world, &grains, soil, &mut exposures, |sums, rows| {
        let (outward, at_surface) = grains.surface(world, positions, sums, rows);
        (outward.norm(), at_surface)
    })?;
    let limit = world.kernel.support_radius().powi(2);
    let mut near = vec![false; volume.len()];
    for i in (0..volume.len()).filter(|&i| exposures[i].1) {
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
        let missing = exposures[i].0;
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
    let near = (0..volume.len()).filter(|&i| near[i]);
    Ok(near.filter_map(outlet).collect())
}

/// Particles before a wall with the flux per pressure and mobility from the wall to them, m^(d−2): 2 V |∇γ_as|/d_as.
pub(crate) fn feeds<const D: usize>(
    world: &World<D>,
    wall: u32,
) -> Result<Vec<(usize, f64)>, StepError> {
    let (elements, contacts) = (&world.walls.elements, &world.walls.contacts);
    let (positions, volume) = world.free.all((fields::POSITION, fields::VOLUME))?;
    let least = LEAST_DISTANCE * world.spacing;
    let feed = |i: usize| {
        let own = contacts.of_particle(i).iter();
        let own = own.filter(|c| elements.wall[c.element as usize] == wall);
        let each = own.map(|contact| {
            let s = contact.element as usize;
            let apart = world
                .domain
                .nearest_image(positions[i] - elements.centre[s]);
            contact.gradient.norm() / apart.dot(&elements.normal[s]).abs().max(least)
        });
        (i, 2.0 * volume[i] * each.sum::<f64>())
    };
    let all = contacts.particles.iter().map(|i| feed(*i as usize));
    Ok(all.filter(|(_, conductance)| *conductance > 0.0).collect())
}

/// Spacings to a wall below which none counts.
const LEAST_DISTANCE: f64 = 0.1;

/// Distances d by the integral I(d) = ∫ w dA of the kernel over the plane, which is |Σ V ∇w| over the soil before it.
#[derive(Debug)]
pub(crate) struct SurfaceDistance {
    /// I, 1/m, at distances from 0 to the support radius; falling.
    integrals: Vec<f64>,
    /// m.
    radius: f64,
}

const PLACES: usize = 256;
const POINTS: usize = 256;
/// Share of the support radius below which no particle is from its surface.
const LEAST: f64 = 0.05;

impl SurfaceDistance {
    /// Of a kernel w(r), 1/m^d, in D dimensions with a support radius, m.
    pub fn new<const D: usize>(radius: f64, kernel: &dyn Fn(f64) -> f64) -> Self {
        let integral = |d: f64| {
            let end = (radius * radius - d * d).max(0.0).sqrt();
            let step = end / POINTS as f64;
            let at = |k: usize| {
                let across = (k as f64 + 0.5) * step;
                let ring = match D {
                    2 => 2.0,
                    _ => std::f64::consts::TAU * across,
                };
                ring * kernel(across.hypot(d))
            };
            (0..POINTS).map(at).sum::<f64>() * step
        };
        let place = |k: usize| radius * k as f64 / (PLACES - 1) as f64;
        SurfaceDistance {
            integrals: (0..PLACES).map(|k| integral(place(k))).collect(),
            radius,
        }
    }

    /// d, m, of an integral, 1/m.
    pub fn at(&self, integral: f64) -> f64 {
        let k = self.integrals.partition_point(|i| *i > integral);
        let place = match k {
            0 => 0.0,
            PLACES => (PLACES - 1) as f64,
            _ => {
                let (above, below) = (self.integrals[k - 1], self.integrals[k]);
                (k - 1) as f64 + (above - integral) / (above - below)
            }
        };
        self.radius * (place / (PLACES - 1) as f64).max(LEAST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The half plane beyond, in cells of a sixteenth of a spacing, on both sides of a plane half a spacing away and more.
    #[test]
    fn distances_follow_from_the_missing_part_of_the_kernel() {
        let spacing = 0.01;
        let (h, cell) = (2.0 * spacing, spacing / 16.0);
        let strength = 7.0 / (4.0 * std::f64::consts::PI * h * h);
        // Wendland C2 in the plane, and −w'/r.
        let left = |r: f64| (1.0 - 0.5 * r / h).max(0.0);
        let kernel = |r: f64| strength * left(r).powi(4) * (1.0 + 2.0 * r / h);
        let slope = |r: f64| 5.0 * strength / (h * h) * left(r).powi(3);
        let table = SurfaceDistance::new::<2>(2.0 * h, &kernel);
        for row in 0..3 {
            let distance = (f64::from(row) + 0.5) * spacing;
            let mut missing = 0.0;
            for above in 0..96 {
                let y = distance + (f64::from(above) + 0.5) * cell;
                for across in -96..=96 {
                    let r = f64::hypot(f64::from(across) * cell, y);
                    missing += cell * cell * slope(r) * y;
                }
            }
            let found = table.at(missing);
            let error = (found - distance).abs();
            assert!(error < 1e-3 * spacing, "row {row}: {found}");
        }
    }
}

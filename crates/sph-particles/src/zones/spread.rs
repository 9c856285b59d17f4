//! Particles of a band are pushed apart until no two lie together.

use rayon::prelude::*;
use sph_boundary::Wall;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::CellGrid;
use sph_solver::Flow;

use super::frame::Frame;

/// Share of the overlap of two particles by which they part in a step: a band is passed in some hundred steps.
const PART: f64 = 0.02;
/// Distance over the spacing below which particles part. Particles that are evenly disordered are seldom nearer.
const NEAREST: f64 = 0.8;

/// No particle is moved nearer to a wall than this share of the spacing.
const NEAR_WALL: f64 = 0.3;

/// Moves the particles of a flow beyond the sides of `frame` away from others that are near.
///
/// Those that come in lie in pairs and gaps, as their parents; in the zone that order would form at the expense of the
/// flow's pressure and energy.
///
/// # Errors
/// If a column is missing.
pub(crate) fn spread<const D: usize>(
    flow: &mut Flow<D>,
    frame: &Frame<D>,
) -> Result<(), StepError> {
    let spacing = flow.world.spacing;
    let reach = NEAREST * spacing;
    let mut position = flow.world.free.take(fields::POSITION)?;
    let domain = &flow.world.domain;
    let near = |x: &Vect<D>| !frame.holds(x, -spacing);
    let band: Vec<usize> = (0..position.len())
        .filter(|k| near(&position[*k]))
        .collect();
    let places: Vec<Vect<D>> = band.iter().map(|k| position[*k]).collect();
    let grid = CellGrid::new(&places, reach, domain);
    let moved = |n: usize| {
        let x = places[n];
        let mut way = Vect::<D>::zeros();
        grid.ranges(&x, reach, |found| {
            for other in grid.order()[found].iter().map(|k| *k as usize) {
                let d = domain.nearest(x - places[other]);
                let r = d.norm();
                if r > 0.0 && r < reach {
                    way += d * (PART * (reach / r - 1.0).min(1.0));
                }
            }
        });
        x + way
    };
    let aside: Vec<Vect<D>> = (0..band.len())
        .into_par_iter()
        .with_min_len(256)
        .map(moved)
        .collect();
    let walls = flow.walls.as_deref();
    let near_wall = NEAR_WALL * spacing;
    for (k, place) in band.iter().zip(aside) {
        let led = !frame.holds(&position[*k], 0.0);
        let free = |w: &dyn Wall<D>| w.contains(&place) && w.clearance(&place, near_wall).is_none();
        if led && place != position[*k] && walls.is_none_or(free) {
            position[*k] = domain.wrapped(place);
        }
    }
    flow.world.free.put(fields::POSITION, position)?;
    Ok(())
}

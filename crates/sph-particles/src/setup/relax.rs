//! Relaxing the first particles, so that the density sum is even next to slanted and curved walls.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sph_boundary::Wall;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{CHUNK, NOBODY, Row, Scratch, World};
use sph_scene::Scene;
use sph_solver::Flow;

use crate::setup::shapes::Drawn;

/// Share of h² ∇C by which a particle moves in one step; 1 does not converge.
const MOBILITY: f64 = 0.4;
/// Largest displacement in one step over the spacing.
const STRIDE: f64 = 0.1;
/// No particle is moved nearer to a wall than this share of the spacing.
const CLEARANCE: f64 = 0.4;
// A particle that stands off by the clearance cannot cross a wall: its side need not be checked.
const _: () = assert!(STRIDE < CLEARANCE);

/// Density sum over γ, and its gradient by the renormalised operator, 1/m.
struct Concentration<const D: usize> {
    value: f64,
    gradient: Vect<D>,
}

/// Relaxes the first particles if the scene has `relax`: moves them down the gradient of their own concentration,
/// δr_a = −β h² [Σ θ V ∇w − ∇γ]/γ, until the largest error is below its tolerance. Walls that scale the kernel have
/// s_a s_b w in the place of w, and ∇ ln s Σ V s_a s_b w in that of −∇γ.
pub fn relax<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    flow: &mut Flow<D>,
) -> Result<Option<Relaxation>, StepError> {
    let (world, walls) = (&mut flow.world, flow.walls.as_deref_mut());
    let (Some(settings), Some(walls)) = (scene.numerics.relax, walls) else {
        return Ok(None);
    };
    let position = world.free.get(fields::POSITION)?;
    let fixed: &dyn Wall<D> = walls;
    let held = position
        .par_iter()
        .map(|x| near_surface(drawn, world, x, fixed));
    let held: Vec<bool> = held.collect();
    // The marks follow the particles through sorting by their identities.
    let identity = world.free.get(fields::IDENTITY)?;
    let mut held_by_identity = vec![false; held.len()];
    for (id, held) in identity.iter().zip(&held) {
        held_by_identity[*id as usize] = *held;
    }
    let mut result: Option<Relaxation> = None;
    let most = settings.steps as usize;
    for step in 0..=most {
        walls.geometry(world)?;
        let held = world.free.get(fields::IDENTITY)?.iter();
        let held: Vec<bool> = held.map(|id| held_by_identity[*id as usize]).collect();
        let all = concentrations(world)?;
        let free = || all.iter().enumerate().filter(|(i, _)| !held[*i]);
        let contacts = &world.walls.contacts;
        let inner = free().filter(|(i, _)| contacts.of_particle(*i).is_empty());
        let inner: Vec<f64> = inner.map(|(_, c)| c.value).collect();
        let mean = match inner.len() {
            0 => 1.0,
            n => inner.iter().sum::<f64>() / n as f64,
        };
        let errors = free().map(|(_, c)| (c.value / mean - 1.0).abs());
        let errors: Vec<f64> = errors.collect();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len().max(1) as f64).sqrt();
        let so_far = result.get_or_insert(Relaxation {
            steps: 0,
            counted: errors.len(),
            largest_before: largest,
            largest,
            rms_before: rms,
            rms,
            volume: 1.0,
        });
        (so_far.steps, so_far.largest, so_far.rms) = (step, largest, rms);
        so_far.volume = 1.0 / mean;
        if step == most || largest < settings.tolerance || errors.is_empty() {
            break;
        }
        advance(world, walls, &all, &held)?;
        world.refresh_lists()?;
    }
    Ok(result)
}

/// True if air is within a support: a place of the fluid's side that belongs to no body.
///
/// Places are tried along the directions of a lattice of side 5, half a support and a whole one away.
fn near_surface<const D: usize>(
    drawn: &Drawn<D>,
    world: &World<D>,
    x: &Vect<D>,
    walls: &dyn Wall<D>,
) -> bool {
    let support = world.kernel.support_radius();
    // A place on a wall is on the edge of a body, too: not air.
    let edge = -1e-6 * support;
    let inside = |x: &Vect<D>| drawn.regions.iter().any(|r| r.depth(&(*x).into()) > edge);
    (0..5_usize.pow(D as u32)).any(|n| {
        let offset = Vect::<D>::from_fn(|k, _| (n / 5_usize.pow(k as u32) % 5) as f64 - 2.0);
        let Some(direction) = offset.try_normalize(0.5) else {
            return false;
        };
        [0.5, 1.0].iter().any(|part| {
            let place = world.domain.wrapped(x + direction * (support * part));
            !inside(&place) && walls.contains(&place)
        })
    })
}

fn advance<const D: usize>(
    world: &mut World<D>,
    walls: &dyn Wall<D>,
    all: &[Concentration<D>],
    held: &[bool],
) -> Result<(), StepError> {
    let spacing = world.spacing;
    let h2 = world.kernel.smoothing_length().powi(2);
    let mut position = world.free.take(fields::POSITION)?;
    // Without contacts no wall is within the support, which is farther than a stride and the clearance.
    let found = world.free.get(fields::RENORMALISATION).is_ok();
    let (stride, clearance) = (STRIDE * spacing, CLEARANCE * spacing);
    let reaches = world.kernel.support_radius() > stride + clearance;
    let far = |i: usize| found && reaches && world.walls.contacts.of_particle(i).is_empty();
    for (i, ((x, c), held)) in position.iter_mut().zip(all).zip(held).enumerate() {
        if *held {
            continue;
        }
        let mut by = c.gradient * (-MOBILITY * h2);
        if by.norm() > stride {
            by *= stride / by.norm();
        }
        let to = *x + by;
        if far(i) || walls.clearance(&to, clearance).is_none() {
            *x = to;
        }
    }
    Ok(world.free.put(fields::POSITION, position)?)
}

fn concentrations<const D: usize>(world: &World<D>) -> Result<Vec<Concentration<D>>, StepError> {
    let position = world.free.get(fields::POSITION)?;
    let gamma = world.sum_renormalisation();
    let scale = world.free.get(fields::SCALE).ok();
    let slope = world.free.get(fields::SCALE_SLOPE).ok();
    let points = &world.walls.points;
    let whole = world.spacing.powi(D as i32);
    let kernel = &*world.kernel;
    let domain = Some(&world.domain).filter(|domain| domain.periodic.contains(&true));
    let of = |(row, values): &mut (Scratch<D>, Vec<f64>), i: usize| {
        let x = &position[i];
        let own = scale.map_or(1.0, |s| s[i]);
        let mut sum = own * own * kernel.value_at_zero();
        let mut gradient = Vect::<D>::zeros();
        let mut add = |row: Row<'_, D>, values: &mut Vec<f64>, share: &dyn Fn(u32) -> f64| {
            values.resize(row.index.len(), 0.0);
            kernel.value(row.distance2, values);
            for (k, (j, w)) in row.index.iter().zip(values.iter()).enumerate() {
                let share = share(*j);
                sum += share * w;
                gradient += row.separation[k] * (share * row.factor[k]);
            }
        };
        let candidates = world.lists.free.candidates(i);
        row.fill(x, position, candidates, i as u32, domain, kernel);
        add(row.row(), values, &|j| {
            scale.map_or(1.0, |s| own * s[j as usize])
        });
        if points.in_sums() {
            let candidates = world.lists.wall.candidates(i);
            row.fill(x, &points.position, candidates, NOBODY, domain, kernel);
            add(row.row(), values, &|v| points.share[v as usize]);
        }
        let contacts = world.walls.contacts.of_particle(i).iter();
        // The part of the walls in the gradient: −∇γ, or ∇ ln s times the sum.
        let wall = match slope {
            Some(slope) => slope[i] * -(whole * sum),
            None => contacts.fold(Vect::zeros(), |sum: Vect<D>, c| sum + c.gradient),
        };
        let inverse = gamma.map_or(1.0, |g| 1.0 / g[i]);
        Concentration {
            value: whole * sum * inverse,
            gradient: (gradient * whole - wall) * inverse,
        }
    };
    let rows = (0..position.len()).into_par_iter().with_min_len(CHUNK);
    Ok(rows
        .map_init(|| (Scratch::default(), Vec::new()), of)
        .collect())
}

/// Results of a relaxation; errors are |Σ θ V w / γ − 1| with the volume V that a particle ends up with.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Relaxation {
    /// Steps taken.
    pub steps: usize,
    /// Particles farther than a support from any free surface; the others stay where they are
    /// and are not counted.
    pub counted: usize,
    /// Largest error before.
    pub largest_before: f64,
    /// Largest error after.
    pub largest: f64,
    /// Root mean square of the error before.
    pub rms_before: f64,
    /// Root mean square of the error after.
    pub rms: f64,
    /// Volume of a particle over that of a cell of the lattice: the fluid's volume per particle, from the mean of Σ V w
    /// over the particles that see neither a wall nor a surface.
    pub volume: f64,
}

//! How evenly particles are spread, and where they end: free surfaces and interfaces.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

use sph_neighbours::{Around, Values, walk, walk_some};

/// What the neighbourhood of a particle says of its arrangement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evenness<const D: usize> {
    /// ΣθVw/γ: 1 in the bulk.
    pub filling: f64,
    /// Gradient of the concentration, 1/m: into the fluid at a surface.
    pub gradient: Vect<D>,
    /// The same with the term against clumping, 1/m.
    pub push: Vect<D>,
    /// Unit normal of the interface between phases, where the other phase is near.
    pub interface: Option<Vect<D>>,
}

/// Least h |∇c| of another phase's colour at an interface: the first row has 0.7, the third 0.04.
const AT_INTERFACE: f64 = 0.1;

/// All particles' [`Evenness`].
pub(crate) fn evenness<const D: usize>(
    world: &World<D>,
    tensile: f64,
    exponent: i32,
) -> Result<Vec<Evenness<D>>, StepError> {
    let volume = world.free.get(fields::VOLUME)?;
    let phase = world.free.get(fields::PHASE).ok();
    let points = &world.walls.points;
    let own = world.kernel.value_at_zero();
    let between = 1.0 / world.kernel.at(world.spacing).0;
    let least = AT_INTERFACE / world.kernel.smoothing_length();
    // A power with a known exponent is two products.
    let power = move |ratio: f64| match exponent {
        4 => (ratio * ratio) * (ratio * ratio),
        n => ratio.powi(n),
    };
    walk(world, Values::Both, |around: &Around<'_, D>| {
        let (rows, i) = (&around.rows, around.rows.particle);
        let mut filling = volume[i] * own;
        let mut gradient = Vect::<D>::zeros();
        let mut push = Vect::<D>::zeros();
        let mut colour = Vect::<D>::zeros();
        let free = rows.free.index.iter().zip(around.free);
        for (k, (&j, w)) in free.enumerate() {
            let v = volume[j as usize];
            let slope = rows.free.separation[k] * (v * rows.free.factor[k]);
            filling += v * w;
            gradient += slope;
            push += slope * (tensile * power(w * between));
            if phase.is_some_and(|p| p[i] != p[j as usize]) {
                colour += slope;
            }
        }
        for (k, (&v, w)) in rows.wall.index.iter().zip(around.wall).enumerate() {
            let part = points.share[v as usize] * points.volume[v as usize];
            filling += part * w;
            gradient += rows.wall.separation[k] * (part * rows.wall.factor[k]);
        }
        for contact in rows.contacts {
            gradient -= contact.gradient;
        }
        let inverse = rows.inverse_renormalisation;
        Evenness {
            filling: filling * inverse,
            gradient: gradient * inverse,
            push: (gradient + push) * inverse,
            interface: colour.try_normalize(least),
        }
    })
}

/// What a particle near a free surface may not do.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Held<const D: usize> {
    /// Far from surfaces: nothing.
    No,
    /// Leave its distance from a surface with this normal.
    Along(Vect<D>),
    /// Move at all.
    Still,
}

impl<const D: usize> Held<D> {
    /// What is left of a shift.
    pub fn held(&self, shift: Vect<D>) -> Vect<D> {
        match self {
            Held::No => shift,
            Held::Along(normal) => shift - normal * normal.dot(&shift),
            Held::Still => Vect::zeros(),
        }
    }
}

/// Least length of the mean of the unit normals nearby; below it there is no single normal.
const AGREE: f64 = 0.7;

/// How particles near free surfaces are held; `None` where no support is less full than `surface`.
pub(crate) fn held_normals<const D: usize>(
    world: &World<D>,
    all: &[Evenness<D>],
    surface: f64,
) -> Result<Option<Vec<Held<D>>>, StepError> {
    let at_surface = |e: &Evenness<D>| e.filling < surface;
    if !all.par_iter().with_min_len(4096).any(at_surface) {
        return Ok(None);
    }
    let normal = |e: &Evenness<D>| e.gradient.try_normalize(0.0).unwrap_or_else(Vect::zeros);
    let own = world.kernel.value_at_zero();
    let near_any = |i: usize| {
        let near = |j: &u32| at_surface(&all[*j as usize]);
        at_surface(&all[i]) || world.lists.free.row(i).iter().any(near)
    };
    let near: Vec<bool> = (0..all.len())
        .into_par_iter()
        .with_min_len(1024)
        .map(near_any)
        .collect();
    let held = walk_some(
        world,
        Values::Both,
        |i| near[i],
        |around: &Around<'_, D>| {
            let i = around.rows.particle;
            let (mut sum, mut weight) = (Vect::<D>::zeros(), 0.0);
            let mut add = |k: usize, w: f64| {
                if at_surface(&all[k]) {
                    sum += normal(&all[k]) * w;
                    weight += w;
                }
            };
            add(i, own);
            let free = around.rows.free.index.iter().zip(around.free);
            free.for_each(|(&j, w)| add(j as usize, *w));
            match (weight > 0.0, sum.norm() >= AGREE * weight) {
                (false, _) => Held::No,
                (true, true) => Held::Along(sum.normalize()),
                (true, false) => Held::Still,
            }
        },
    )?;
    Ok(Some(
        held.into_iter().map(|h| h.unwrap_or(Held::No)).collect(),
    ))
}

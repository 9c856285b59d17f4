//! Concentration of particles and its ends: free surfaces and interfaces.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{
    Around, Contact, ContactRow, Lane, LanePair, Neighbourhood, Particles, Values, World,
    add_scaled, lattice_sum, pair_sum, unlike, walk_in_lanes, walk_some,
};

/// Measures of the arrangement of a particle's neighbourhood.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evenness<const D: usize> {
    /// The concentration C = ΣθVw/γ: 1 in the bulk.
    pub filling: f64,
    /// ∇C = (ΣθV∇w − C Σ∇γ)/γ, 1/m: into the fluid at a surface, and 0 for an even
    /// arrangement of any concentration beside a wall.
    pub gradient: Vect<D>,
    /// The same with the term against clumping, 1/m.
    pub push: Vect<D>,
    /// Unit normal of the interface between phases, where the other phase is near.
    pub interface: Option<Vect<D>>,
}

/// Least h |∇c| of another phase's colour at an interface: the first row has 0.7, the third 0.04.
const AT_INTERFACE: f64 = 0.1;

/// All particles' [`Evenness`], into a buffer.
pub(crate) fn evenness<const D: usize>(
    world: &World<D>,
    tensile: f64,
    exponent: i32,
    all: &mut Vec<Evenness<D>>,
) -> Result<(), StepError> {
    let points = &world.walls.points;
    let kernel = &*world.kernel;
    let sum = FreeSums {
        volume: world.free.get(fields::VOLUME)?,
        phase: world.free.get(fields::PHASE).ok(),
        tensile,
        exponent,
        between: 1.0 / kernel.at(world.spacing).0,
    };
    let power = |ratio: f64| power(ratio, exponent);
    let (volume, between, own) = (sum.volume, sum.between, kernel.value_at_zero());
    let mirrored = !points.in_density();
    let least = AT_INTERFACE / kernel.smoothing_length();
    // An image stands for the row of images of a lattice, which pushes as much and the more for those aside.
    let row = match mirrored {
        true => row_of_images(world, power),
        false => 0.0,
    };
    let mirrored_weight = |w| row * tensile * power(w * between);
    let nothing = Evenness {
        filling: 0.0,
        gradient: Vect::zeros(),
        push: Vect::zeros(),
        interface: None,
    };
    all.resize(volume.len(), nothing);
    type Sums<const D: usize> = (f64, [f64; D], [f64; D], [f64; D]);
    let measures = |(filling, gradient, push, colour): Sums<D>, rows: &Neighbourhood<'_, D>| {
        let i = rows.particle;
        let mut filling = volume[i] * own + filling;
        let (mut gradient, mut push) = (Vect::from(gradient), Vect::from(push));
        for (v, pair) in rows.wall.pairs() {
            let w = kernel.at(pair.distance2.sqrt()).0;
            let part = points.share[v] * points.volume[v];
            filling += part * w;
            gradient += pair.separation * (part * pair.factor);
            if part > 0.0 {
                // However little of it is fluid, a particle is not to come nearer to a point than to another.
                let whole = points.volume[v] * pair.factor;
                push += pair.separation * (whole * tensile * power(w * between));
            }
        }
        let inverse = rows.inverse_renormalisation;
        let concentration = filling * inverse;
        for contact in rows.contacts {
            gradient -= contact.gradient * concentration;
        }
        if mirrored {
            push += images(world, rows.contacts, mirrored_weight) * volume[i];
        }
        Evenness {
            filling: concentration,
            gradient: gradient * inverse,
            push: (gradient + push) * inverse,
            interface: Vect::from(colour).try_normalize(least),
        }
    };
    walk_in_lanes(world, &sum, |_| true, all, measures)
}

/// ratioⁿ by products.
#[inline(always)]
fn power<L: Lane>(ratio: L, exponent: i32) -> L {
    let square = ratio * ratio;
    match exponent {
        4 => square * square,
        n => (1..n).fold(ratio, |power, _| power * ratio),
    }
}

struct FreeSums<'a> {
    volume: &'a [f64],
    phase: Option<&'a [u32]>,
    tensile: f64,
    exponent: i32,
    /// 1/w(δr), m^d.
    between: f64,
}

#[pair_sum]
impl<const D: usize> FreeSums<'_> {
    const VALUES: bool = true;

    fn own<L: Lane>(&self, all: Particles) -> L {
        all.phases(self.phase)
    }
    /// The filling, its gradient, the push, and ΣV∇w over other phases.
    fn pair<L: Lane>(
        &self,
        phase: &L,
        j: usize,
        pair: &LanePair<D, L>,
        (filling, gradient, push, colour): &mut (L, [L; D], [L; D], [L; D]),
    ) {
        let volume = L::splat(self.volume[j]);
        let weight = volume * pair.factor;
        let near = power(pair.value * L::splat(self.between), self.exponent);
        let pairing = weight * (L::splat(self.tensile) * near);
        *filling += volume * pair.value;
        add_scaled(gradient, &pair.separation, weight);
        add_scaled(push, &pair.separation, pairing);
        if let Some(phases) = self.phase {
            let other = unlike(*phase, phases[j]).where_positive(weight, L::splat(0.0));
            add_scaled(colour, &pair.separation, other);
        }
    }
}

/// Σ F y (w/w(δr))ⁿ over the half of a lattice behind a plane midway between rows, over its largest term.
fn row_of_images<const D: usize>(world: &World<D>, power: impl Fn(f64) -> f64) -> f64 {
    let (between, factor) = world.kernel.at(world.spacing);
    let sum = lattice_sum(world, |pair| {
        let height = pair.separation[D - 1];
        let w = world.kernel.at(pair.separation.norm()).0;
        height.max(0.0) * pair.factor * power(w / between)
    });
    sum / (world.spacing * factor)
}

/// Elements whose normals differ by less than 45° are one wall.
const ONE_WALL: f64 = 0.7;

/// Σ weight(w) ∇w over the images of a particle behind the walls around it: one behind each wall, at twice the distance.
fn images<const D: usize>(
    world: &World<D>,
    contacts: ContactRow<'_, D>,
    weight: impl Fn(f64) -> f64,
) -> Vect<D> {
    let normal = |c: &Contact<D>| world.walls.elements.normal[c.element as usize];
    let mut sum = Vect::zeros();
    for contact in contacts {
        let apart = 2.0 * contact.distance.max(0.0);
        let (w, factor) = world.kernel.at(apart);
        let weight = weight(w);
        if weight < FAINT {
            continue;
        }
        // The elements of a wall share its image.
        let own = normal(&contact);
        let one_wall = contacts.iter().filter(|c| normal(c).dot(&own) > ONE_WALL);
        let all: f64 = one_wall.map(|c| c.gradient.norm()).sum();
        let share = contact.gradient.norm() / all;
        sum += own * (share * weight * apart * factor);
    }
    sum
}

/// Least weight of an image that counts.
const FAINT: f64 = 1e-4;

/// Limits of shifts near a free surface.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ShiftLimit<const D: usize> {
    /// Far from surfaces: nothing.
    No,
    /// Leave its distance from a surface with this normal.
    Along(Vect<D>),
    /// Move at all.
    Still,
}

impl<const D: usize> ShiftLimit<D> {
    /// The admissible part of a shift.
    pub fn held(&self, shift: Vect<D>) -> Vect<D> {
        match self {
            ShiftLimit::No => shift,
            ShiftLimit::Along(normal) => shift - normal * normal.dot(&shift),
            ShiftLimit::Still => Vect::zeros(),
        }
    }
}

/// Least length of the mean of the unit normals nearby; below it there is no single normal.
const AGREE: f64 = 0.7;

/// Normals of particles held near free surfaces; `None` where no support is less full than `surface`.
pub(crate) fn held_normals<const D: usize>(
    world: &World<D>,
    all: &[Evenness<D>],
    surface: f64,
) -> Result<Option<Vec<ShiftLimit<D>>>, StepError> {
    let at_surface = |e: &Evenness<D>| e.filling < surface;
    if !all.par_iter().with_min_len(4096).any(at_surface) {
        return Ok(None);
    }
    let normal = |e: &Evenness<D>| e.gradient.try_normalize(0.0).unwrap_or_else(Vect::zeros);
    let own = world.kernel.value_at_zero();
    let near_any = |i: usize| {
        let near = |j: &u32| at_surface(&all[*j as usize]);
        at_surface(&all[i]) || world.lists.free.candidates(i).iter().any(near)
    };
    let each = (0..all.len()).into_par_iter().with_min_len(1024);
    let near: Vec<bool> = each.map(near_any).collect();
    let limit = |around: &Around<'_, D>| {
        let (mut sum, mut weight) = (Vect::<D>::zeros(), 0.0);
        let mut add = |k: usize, w: f64| {
            if at_surface(&all[k]) {
                sum += normal(&all[k]) * w;
                weight += w;
            }
        };
        add(around.rows.particle, own);
        let free = around.rows.free.index.iter().zip(around.free);
        free.for_each(|(&j, w)| add(j as usize, *w));
        match (weight > 0.0, sum.norm() >= AGREE * weight) {
            (false, _) => ShiftLimit::No,
            (true, true) => ShiftLimit::Along(sum.normalize()),
            (true, false) => ShiftLimit::Still,
        }
    };
    let held = walk_some(world, Values::Both, |i| near[i], limit)?.into_iter();
    Ok(Some(held.map(|h| h.unwrap_or(ShiftLimit::No)).collect()))
}

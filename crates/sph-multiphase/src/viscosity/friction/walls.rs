//! Friction at walls: the slip past the nearest element, and the correction of the sum.

use sph_core::Vect;
use sph_neighbours::{Contact, Neighbourhood, Pair, Particles};

use super::{BoundFriction, OwnValues, PairFriction};

/// κ is left at 1 where |∇γ| δr is below this: opposite walls, or the edge of the support.
const FAINT: f64 = 1e-3;
/// Elements whose normals differ by less than 45° are one smooth wall.
const ONE_WALL: f64 = 0.7;
/// Least distance from a wall over the spacing, for stability.
const LEAST_DISTANCE: f64 = 0.5;
/// Bounds of κ.
const BOUNDS: [f64; 2] = [0.0, 4.0];

impl<const D: usize, F: PairFriction<D>> BoundFriction<'_, D, F> {
    #[inline(always)]
    pub(super) fn is_open(&self, element: u32) -> bool {
        !self.open.is_empty()
            && self
                .open
                .contains(&self.walls.elements.wall[element as usize])
    }

    /// Normal and distance of the element with the largest mean kernel, the nearest one.
    #[inline(always)]
    pub(super) fn nearest(&self, i: usize) -> Option<Contact<D>> {
        if !(self.rubs && self.corrected) {
            return None;
        }
        let mean = |c: &Contact<D>| {
            let measure = self.walls.elements.measure[c.element as usize];
            c.gradient.norm_squared() / (measure * measure)
        };
        let mut nearest = None;
        let mut largest = 0.0;
        for contact in self.walls.contacts.of_particle(i) {
            let mean = mean(&contact);
            if mean > largest && !self.is_open(contact.element) {
                largest = mean;
                nearest = Some(contact);
            }
        }
        nearest
    }

    /// Friction per tangential velocity at an element, before κ: 2 η |∇γ_as|/δr; 2 τ_w/u_t |∇γ_as| of a wall function.
    #[inline(always)]
    pub(super) fn weight(&self, here: &OwnValues<D>, contact: &Contact<D>) -> f64 {
        let s = contact.element as usize;
        // A phase that the wall function is not for has none, and the condition of the wall.
        if self.walls.elements.wall_function.get(s) == Some(&true) && here.wall_friction > 0.0 {
            return 2.0 * here.wall_friction * contact.gradient.norm();
        }
        let slip = self.walls.elements.slip.get(s).copied().unwrap_or(0.0);
        let distance = self.distance(here, contact, &self.walls.elements.normal[s]) + slip;
        // κ holds whatever the pair formula makes of volumes and strength.
        let factor = match here.nearest {
            Some(_) => 1.0,
            None => self.friction.at_element(here.volume, contact.volume),
        };
        let friction_factor = self.walls.elements.friction_factor[s];
        2.0 * factor * friction_factor * here.viscosity.eta * contact.gradient.norm() / distance
    }

    /// Share of a wall point's friction that counts.
    #[inline(always)]
    pub(super) fn rubbing(&self, v: usize, pair: &Pair<D>) -> f64 {
        let mut rubbing = self.walls.points.share[v] * self.walls.points.friction_factor[v];
        if let Some((slip, normal)) = self.walls.points.slip.get(v) {
            // At the wall the fluid goes with the share λ/(d + λ) of the velocity at d.
            let distance = pair.separation.dot(normal).max(self.spacing);
            rubbing *= distance / (distance + slip);
        }
        rubbing
    }

    /// κ from Σ θ ½ t·f(t) r, to which the walls are added, and G = Σ ∇γ_as.
    #[inline(always)]
    pub(super) fn correction(
        &self,
        here: &OwnValues<D>,
        mut sum: Vect<D>,
        rows: &Neighbourhood<'_, D>,
    ) -> f64 {
        if here.nearest.is_none() {
            return 1.0;
        }
        for (v, pair) in rows.wall.pairs() {
            let there = self.walls.points.volume[v];
            let shear = self.friction.shear(here.volume, there, &here.along, &pair);
            sum += pair.separation * (self.walls.points.share[v] * shear);
        }
        let closed = rows.contacts.iter().filter(|c| !self.is_open(c.element));
        let gradient = closed.fold(Vect::<D>::zeros(), |sum, c| sum + c.gradient);
        let squared = gradient.norm_squared();
        match squared * self.spacing * self.spacing > FAINT * FAINT {
            true => (sum.dot(&gradient) / squared).clamp(BOUNDS[0], BOUNDS[1]),
            false => 1.0,
        }
    }

    /// Over which the velocity falls to that of an element.
    #[inline(always)]
    fn distance(&self, here: &OwnValues<D>, contact: &Contact<D>, normal: &Vect<D>) -> f64 {
        let Some((nearest, distance)) = &here.nearest else {
            return contact.distance.max(self.spacing);
        };
        let cosine = normal.dot(nearest);
        let distance = match cosine > ONE_WALL {
            true => distance / cosine,
            false => contact.distance,
        };
        distance.max(LEAST_DISTANCE * self.spacing)
    }

    /// Unit vector along the slip past the nearest wall, where it is needed.
    #[inline(always)]
    pub(super) fn slip(&self, i: usize, nearest: Option<&Contact<D>>) -> Vect<D> {
        let Some(nearest) = nearest.filter(|_| F::DIRECTIONAL) else {
            return Vect::zeros();
        };
        let slip = self.velocity[i] - self.walls.elements.velocity_at(nearest);
        let normal = &self.walls.elements.normal[nearest.element as usize];
        let slip = slip - normal * slip.dot(normal);
        slip.try_normalize(0.0).unwrap_or_else(Vect::zeros)
    }

    #[inline(always)]
    pub(super) fn own_values(&self, i: usize) -> OwnValues<D> {
        let nearest = self.nearest(i);
        OwnValues {
            velocity: self.velocity[i],
            viscosity: self.viscosity.own(Particles::one(i)),
            volume: self.volume[i],
            specific_volume: self.volume[i] / self.mass[i],
            wall_friction: self.wall_friction.map_or(0.0, |all| all[i]),
            along: self.slip(i, nearest.as_ref()),
            nearest: nearest.map(|c| (self.walls.elements.normal[c.element as usize], c.distance)),
        }
    }
}

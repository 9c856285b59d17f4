//! Means of the fluid in front of open faces, and the values of their laws.

use rayon::prelude::*;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::World;

use crate::faces::{Faces, as_share};
use crate::row::{AdjacentFluid, Row};
use crate::{FaceElement, FluidMean, Moment};

/// Least Σ V w of the fluid before an element, of the ½ of a filled half space, for a mean that means something.
const WET: f64 = 0.15;

/// Share of the volume before a full face from which on an element is full: particles that are not on a lattice are more or
/// fewer.
const FULL: f64 = 0.8;

/// Elements that one thread takes at least.
const BATCH: usize = 16;

impl<const D: usize> Faces<D> {
    /// Measures the fluid in front of all elements, and evaluates the laws.
    pub fn look(&mut self, world: &World<D>) -> Result<(), StepError> {
        let columns = Columns::new(world)?;
        let mut looked = std::mem::take(&mut self.looked);
        looked.resize_with(self.elements.len(), || self.nothing(0));
        let all = looked.par_iter_mut().enumerate().with_min_len(BATCH);
        all.for_each_init(Scratch::default, |room, (k, seen)| {
            self.means_before(world, &columns, k, room, seen);
        });
        let looked = self.agreed(world, looked)?;
        for (k, seen) in looked.iter().enumerate() {
            self.inside[k] = self.arriving(k, seen);
            self.lacking[k] = as_share(seen.lacks);
        }
        self.looked = looked;
        for f in 0..self.faces.len() {
            let face = &self.faces[f];
            let own = face.elements.clone();
            let moment = Moment {
                places: &self.places[own.clone()],
                inside: &self.inside[own.clone()],
                time: world.time,
                gravity: world.gravity,
            };
            let outside = face.law.outside(&moment);
            self.asked[f] = face.law.asked(moment.places, world.time);
            self.outside[own.clone()].copy_from_slice(&outside);
            let Some(asked) = self.asked[f] else { continue };
            for k in own.clone() {
                let expansion = self.expansion(k);
                self.outside[k].velocity *= expansion;
            }
            if asked < 0.0 {
                self.draw_air(own);
            }
        }
        let elements = 0..self.elements.len();
        let pressures: Vec<_> = elements.map(|k| self.reflected(k)).collect();
        for (outside, pressure) in self.outside.iter_mut().zip(pressures) {
            outside.pressure = pressure;
        }
        Ok(())
    }

    /// The mean in front of an element, as it arrives at the face.
    ///
    /// A mean that stands a distance d before the face sees a wave d/c too early. It is delayed by this time,
    /// y' = (x − y) c/d, with the end of the step. Velocities are those of half a step ago, as all are kicked once in a
    /// step, and are delayed by as much less.
    fn arriving(&self, k: usize, seen: &AdjacentFluid<D>) -> FluidMean<D> {
        let mut inside = seen.inside;
        let dt = self.memory.dt;
        if inside.wet && dt > 0.0 {
            let late = seen.reach * inside.density / inside.impedance;
            let share = |late: f64| dt / (dt + late.max(0.0));
            let (pressure, velocity) = &self.memory.arrived[k];
            inside.pressure = pressure + (inside.pressure - pressure) * share(late);
            inside.velocity = velocity + (inside.velocity - velocity) * share(late - 0.5 * dt);
        }
        inside
    }

    /// ρ₀/ρ before an element: laws request volumes of a fluid that does not compress, and its mass is to pass.
    fn expansion(&self, k: usize) -> f64 {
        let (inside, q) = (&self.inside[k], self.phase(k));
        match inside.wet {
            true => self.laws[q].reference().density / self.density_at(inside.pressure, q),
            false => 1.0,
        }
    }

    /// The pressure at an element: that of the law, or where the velocity is imposed of the characteristic that leaves the fluid.
    fn reflected(&self, k: usize) -> f64 {
        let (inside, outside) = (&self.inside[k], &self.outside[k]);
        if !outside.imposed {
            return outside.pressure;
        }
        if !inside.wet {
            return 0.0;
        }
        let normal = &self.places[k].normal;
        let (mut whole, mut mean) = (0.0, 0.0);
        let around = self.smooth[k].iter().map(|(j, w)| (*j as usize, w));
        for (j, w) in around.filter(|(j, _)| self.inside[*j].wet) {
            whole += w;
            mean += w * self.outside[j].velocity.dot(normal);
        }
        inside.pressure + inside.impedance * (mean / whole - inside.velocity.dot(normal))
    }

    /// The means of all [elements](sph_neighbours::OwnedElements), each where it counts.
    fn agreed(
        &self,
        world: &World<D>,
        looked: Vec<AdjacentFluid<D>>,
    ) -> Result<Vec<AdjacentFluid<D>>, StepError> {
        let owned = world.owned_elements()?;
        let looks = |k: usize| {
            let candidates = || world.lists.of_points.candidates(k);
            owned.has_around(&self.places[k].centre, candidates)
        };
        world.agreed(looked, looks, |k| self.nothing(k))
    }

    pub(crate) fn nothing(&self, k: usize) -> AdjacentFluid<D> {
        let mut nothing = AdjacentFluid::new(self.whole.len());
        if self.memory.dt > 0.0 {
            let mean = self.memory.mean[k];
            (nothing.inside.mean_pressure, nothing.inside.mean) = mean;
        }
        nothing
    }

    fn means_before(
        &self,
        world: &World<D>,
        columns: &Columns<'_, D>,
        k: usize,
        room: &mut Scratch<D>,
        seen: &mut AdjacentFluid<D>,
    ) {
        let place = &self.places[k];
        let candidates = world.lists.of_points.candidates(k);
        room.fill(world, columns.position, place, candidates);
        let mix = &mut seen.mix;
        mix.clear();
        mix.resize(self.whole.len(), 0.0);
        let sums = &mut room.sums;
        sums.clear();
        let nothing = Sums {
            pressure: 0.0,
            density: 0.0,
            velocity: Vect::zeros(),
        };
        sums.resize(self.whole.len(), nothing);
        let (mut filling, mut reach) = (0.0, 0.0);
        let mut row = Row::default();
        for ((j, apart), w) in room.near.iter().zip(&room.value) {
            let j = *j;
            let vw = columns.volume[j] * w;
            let phase = columns.phase.map_or(0, |p| p[j] as usize);
            let over = columns.pressure[j] - self.backgrounds[phase];
            filling += vw;
            reach -= vw * apart.dot(&place.normal);
            mix[phase] += vw;
            let velocity = &columns.velocity[j];
            let of_phase = &mut sums[phase];
            of_phase.pressure += vw * (over + columns.density[j] * world.gravity.dot(apart));
            of_phase.velocity += velocity * vw;
            of_phase.density += vw * columns.density[j];
            let weights = [vw, columns.volume[j]];
            row.add(&place.normal, apart, self.spacing, weights, velocity);
        }
        // Sound of one phase does not carry the pressure of another beside it, which may be a thousand times as heavy.
        let q = self.before_all(k, mix);
        let (of_phase, filled) = (sums[q], mix[q]);
        let (mut p, mut u, mut z, mut rho) = (0.0, Vect::zeros(), 0.0, 0.0);
        if filled > 0.0 {
            mix.iter_mut().for_each(|m| *m /= filling);
            (p, u) = (of_phase.pressure / filled, of_phase.velocity / filled);
            rho = of_phase.density / filled;
            z = of_phase.density * self.laws[q].sound_speed(rho) / filled;
            reach = (reach / filling).max(0.0);
        }
        let remembered = (self.memory.dt > 0.0).then(|| self.memory.mean[k]);
        let (mean_pressure, mean) = remembered.unwrap_or((p, u));
        seen.inside = FluidMean {
            wet: filling >= WET,
            pressure: p,
            filled: (row.volume / (FULL * self.full[k].volume)).min(1.0),
            velocity: u,
            impedance: if z > 0.0 { z } else { 1.0 },
            density: rho,
            mean,
            mean_pressure,
        };
        seen.reach = reach;
        let nearest = room.distance2.iter().copied().fold(f64::INFINITY, f64::min);
        seen.nearest = nearest.sqrt();
        seen.lacks = (self.full[k].weight - row.weights[0]) / self.full[k].at_port;
        seen.row = row.velocity(self.spacing).unwrap_or(u);
    }
}

struct Columns<'a, const D: usize> {
    position: &'a [Vect<D>],
    velocity: &'a [Vect<D>],
    pressure: &'a [f64],
    density: &'a [f64],
    volume: &'a [f64],
    phase: Option<&'a [u32]>,
}

impl<'a, const D: usize> Columns<'a, D> {
    fn new(world: &'a World<D>) -> Result<Self, StepError> {
        let free = &world.free;
        Ok(Columns {
            position: free.get(fields::POSITION)?,
            velocity: free.get(fields::VELOCITY)?,
            pressure: free.get(fields::PRESSURE)?,
            density: free.get(fields::DENSITY)?,
            volume: free.get(fields::VOLUME)?,
            phase: free.get(fields::PHASE).ok(),
        })
    }
}

/// Sums over the particles of a phase before an element, each with V w.
#[derive(Clone, Copy)]
struct Sums<const D: usize> {
    pressure: f64,
    density: f64,
    velocity: Vect<D>,
}

#[derive(Default)]
struct Scratch<const D: usize> {
    /// Particles within the support of an element's centre, and the ways from them to it, m.
    near: Vec<(usize, Vect<D>)>,
    /// Squares of their distances, m².
    distance2: Vec<f64>,
    /// w, 1/m^d.
    value: Vec<f64>,
    /// By phase.
    sums: Vec<Sums<D>>,
}

impl<const D: usize> Scratch<D> {
    /// Finds the particles before an element; the kernel is evaluated once for all of them.
    fn fill(
        &mut self,
        world: &World<D>,
        position: &[Vect<D>],
        place: &FaceElement<D>,
        candidates: &[u32],
    ) {
        self.near.clear();
        self.distance2.clear();
        let limit = world.kernel.support_radius().powi(2);
        for &j in candidates {
            let j = j as usize;
            let apart = world.domain.nearest_image(place.centre - position[j]);
            let r2 = apart.norm_squared();
            if r2 < limit {
                self.near.push((j, apart));
                self.distance2.push(r2);
            }
        }
        self.value.resize(self.near.len(), 0.0);
        world.kernel.value(&self.distance2, &mut self.value);
    }
}

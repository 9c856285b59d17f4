//! Particles that have passed a face, and new ones at a face.

use sph_contribution::Newborn;
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{Words, World};

use crate::faces::{CLOSED, Faces, LATE};

/// A particle is born when a port has this share of its mass: its half row has come in by then.
const RIPE: f64 = 0.5;

/// Least distance of a new particle to others, over the spacing: where a velocity is imposed, which pushes its mass in,
/// and where the face yields and its inflow follows the free volume. Ours: from 0.85 on a channel behind a velocity
/// loses its profile (0.66 % with 0.9, 0.33 % with 0.8 and less), and below 0.9 still water stirs itself.
const NEAREST: [f64; 2] = [0.8, 0.9];

/// Least distance of a new particle from the face, over the spacing: on the fluid's side under any rounding.
const IN_FRONT: f64 = 1e-6;

#[derive(Default)]
pub(crate) struct Exits<const D: usize> {
    /// Particles here, each with the number of its face.
    pub here: Vec<(u32, usize)>,
    /// Positions of all, those at home elsewhere among them, in the order of identities.
    pub places: Vec<Vect<D>>,
}

#[derive(Clone, Copy)]
struct LeavingParticle<const D: usize> {
    identity: u64,
    ports: [usize; 2],
    /// Share of its mass that the second port gets.
    part: f64,
    phase: usize,
    mass: f64,
    place: Vect<D>,
}

impl<const D: usize> Words for LeavingParticle<D> {
    fn write(&self, to: &mut Vec<u64>) {
        let [first, second] = self.ports.map(|port| port as u64);
        to.extend([self.identity, first, second, self.phase as u64]);
        to.extend([self.part, self.mass].map(f64::to_bits));
        to.extend(self.place.iter().map(|x| x.to_bits()));
    }

    fn read(from: &[u64]) -> Self {
        let real = |k: usize| f64::from_bits(from[k]);
        LeavingParticle {
            identity: from[0],
            ports: [from[1] as usize, from[2] as usize],
            phase: from[3] as usize,
            part: real(4),
            mass: real(5),
            place: Vect::from_fn(|k, _| real(6 + k)),
        }
    }
}

/// Share of a particle's mass that the second of two ports gets, by the ways from them to it.
fn second_share<const D: usize>([apart, second]: [Vect<D>; 2]) -> f64 {
    let between = apart - second;
    let part = (apart.dot(&between) / between.norm_squared()).clamp(0.0, 1.0);
    if part.is_finite() { part } else { 0.0 }
}

impl<const D: usize> Faces<D> {
    /// Advances the running means.
    pub fn remember(&mut self, dt: f64) {
        let begins = self.memory.dt == 0.0;
        for (k, (pressure, velocity)) in self.memory.mean.iter_mut().enumerate() {
            let law = &self.faces[self.face_of[k]].law;
            if let Some(memory) = law.memory() {
                let part = match begins {
                    true => 1.0,
                    false => 1.0 - (-dt / memory).exp(),
                };
                *pressure += (self.inside[k].pressure - *pressure) * part;
                *velocity += (self.inside[k].velocity - *velocity) * part;
            }
        }
        for k in 0..self.elements.len() {
            let part = match begins || !self.inside[k].wet {
                true => 1.0,
                false => 1.0 - (-dt / self.slowly(k)).exp(),
            };
            let passes = self.through(k).dot(&self.places[k].normal);
            let (slow, current) = (&mut self.memory.slow[k], &mut self.memory.current[k]);
            *slow += (self.outside[k].pressure - *slow) * part;
            *current += (passes - *current) * part;
        }
        for (arrived, inside) in self.memory.arrived.iter_mut().zip(&self.inside) {
            *arrived = (inside.pressure, inside.velocity);
        }
        self.memory.dt = dt;
    }

    /// Particles behind an open face, if some particle has waited long enough to leave or to be born; their mass goes to the ports.
    pub fn leaving(&mut self, world: &World<D>) -> Result<Exits<D>, StepError> {
        let behind = self.passed_particles(world)?;
        let late = (0..self.elements.len()).filter_map(|k| self.ripeness(k));
        let depths = behind.iter().map(|(_, depth, _)| depth / self.spacing);
        let mut late = [late.chain(depths).fold(0.0, f64::max)];
        world.largest(&mut late)?;
        self.due = late[0] >= LATE;
        if !self.due {
            return Ok(Exits::default());
        }
        let phases = self.whole.len();
        // In the order of identities; copies of others' particles are counted where they are at home.
        let owned = world.owned();
        let own = behind.iter().filter(|(p, ..)| owned.has(*p as usize));
        let mut all = world.of_all(own.map(|(.., b)| *b).collect())?;
        all.sort_unstable_by_key(|b| b.identity);
        for b in &all {
            self.memory.mass[b.ports[0] * phases + b.phase] += (1.0 - b.part) * b.mass;
            self.memory.mass[b.ports[1] * phases + b.phase] += b.part * b.mass;
            let face = self.face_of[b.ports[0]];
            self.memory.totals[face * phases + b.phase].died.add(b.mass);
        }
        let here = behind.iter();
        let here = here.map(|(p, _, b)| (*p, self.face_of[b.ports[0]]));
        Ok(Exits {
            here: here.collect(),
            places: all.iter().map(|b| b.place).collect(),
        })
    }

    /// Particles behind an open face, each with its distance from it, m.
    fn passed_particles(
        &self,
        world: &World<D>,
    ) -> Result<Vec<(u32, f64, LeavingParticle<D>)>, StepError> {
        let (position, identity) = world.free.all((fields::POSITION, fields::IDENTITY))?;
        let mass = world.free.get(fields::MASS)?;
        let phase = world.free.get(fields::PHASE).ok();
        let mut all = Vec::new();
        for &p in &world.walls.contacts.particles {
            // Distances are those of before the move, which is shorter than δr.
            let mut contacts = world.walls.contacts.of_particle(p as usize).iter();
            if !contacts.any(|c| c.distance < self.spacing) {
                continue;
            }
            let x = &position[p as usize];
            let Some(ports) = self.nearest_ports(world, p as usize, x) else {
                continue;
            };
            let (first, apart) = ports[0];
            let normal = self.places[first].normal;
            let height = apart.dot(&normal);
            if height >= 0.0 || (apart - normal * height).norm() > self.spacing {
                continue;
            }
            let leaving = LeavingParticle {
                identity: u64::from(identity[p as usize]),
                ports: ports.map(|(port, _)| port),
                part: second_share(ports.map(|(_, way)| way)),
                phase: phase.map_or(0, |q| q[p as usize] as usize),
                mass: mass[p as usize],
                place: *x,
            };
            all.push((p, -height, leaving));
        }
        Ok(all)
    }

    /// The nearest open element that a particle sees and the next nearest one of its face (the same, if there is no other),
    /// with the ways from their centres to it.
    fn nearest_ports(
        &self,
        world: &World<D>,
        p: usize,
        x: &Vect<D>,
    ) -> Option<[(usize, Vect<D>); 2]> {
        let way = |k: usize| world.domain.nearest_image(x - self.places[k].centre);
        let open = || {
            let contacts = world.walls.contacts.of_particle(p).iter();
            let open = contacts.map(|c| self.open[c.element as usize]);
            open.filter(|k| *k != CLOSED).map(|k| k as usize)
        };
        let nearer = |a: &(usize, Vect<D>), b: &(usize, Vect<D>)| {
            let [a, b] = [a, b].map(|(_, way)| way.norm_squared());
            a.total_cmp(&b)
        };
        let first = open().map(|k| (k, way(k))).min_by(nearer)?;
        let of_it = |k: &usize| *k != first.0 && self.face_of[*k] == self.face_of[first.0];
        let second = open().filter(of_it).map(|k| (k, way(k))).min_by(nearer);
        Some([first, second.unwrap_or(first)])
    }

    /// Distance of a new particle before the face, over the spacing, at a port with inflow, if it is due: the port has
    /// the mass for it, and the nearest particle has gone far enough.
    ///
    /// A particle born too near to others is too dense for the space it has, which the density does not show (it does
    /// not jump):
    /// under gravity it would sink, and stir still water.
    fn ripeness(&self, k: usize) -> Option<f64> {
        if self.through(k).dot(&self.places[k].normal) <= 0.0 {
            return None;
        }
        let q = self.phase(k);
        // What is in the port beyond the half is already in front of it.
        let late = self.memory.mass[k * self.whole.len() + q] / self.whole[q] - RIPE;
        let [pushed, let_in] = NEAREST;
        let least = match self.outside[k].imposed {
            true => pushed,
            false => let_in,
        };
        let room = self.looked[k].nearest / self.spacing - least;
        (late >= 0.0 && room >= 0.0).then_some(late.min(room))
    }

    /// Particles that ports have the mass for, where it is time.
    pub fn due_particles(&mut self) -> Vec<Newborn<D>> {
        if !self.due {
            return Vec::new();
        }
        let phases = self.whole.len();
        let mut all = Vec::new();
        for k in 0..self.elements.len() {
            let Some(late) = self.ripeness(k) else {
                continue;
            };
            let (place, velocity) = (self.places[k], self.through(k));
            let q = self.phase(k);
            let whole = self.whole[q];
            self.memory.mass[k * phases + q] -= whole;
            let face = self.face_of[k];
            self.memory.totals[face * phases + q].born.add(whole);
            let ahead = late.clamp(IN_FRONT, 1.0) * self.spacing;
            all.push(Newborn {
                position: place.centre + place.normal * ahead,
                velocity,
                density: self.density(k, q),
                mass: whole,
                phase: q as u32,
                body: self.faces[face].body.clone(),
                values: self.faces[face].values.clone(),
            });
        }
        all
    }
}

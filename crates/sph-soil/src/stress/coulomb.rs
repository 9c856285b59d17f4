//! Grains that slide on a wall.

use rayon::prelude::*;
use sph_contribution::{StepHook, StepMoment, StepPhase};
use sph_core::{Access, Field, Scalar, StepError, Symmetric, Vect, fields};
use sph_neighbours::{Contact, Interaction, WallForce, WallPart, World, wall_parts};

/// Coulomb's friction on walls that have a coefficient μ: the wall pulls at the soil with μ times what
/// the soil presses on it, against the sliding, and at most with what stops it within the step.
///
/// The load of a particle on a wall (the part of [`wall_forces`](sph_neighbours::wall_forces) that is its own, exact in sum) is shared
/// among the elements by |∇γ_as|, and the load of an element, N_s, is taken back from the particles before
/// it: F_as = μ N_s V_a|∇γ_as| / Σ_b V_b|∇γ_bs|. So the sum of all F is μ times the force on the wall. Where the pressure between
/// the grains is another than that of the equation of state, N_s counts for p'_s/p_s, with the means of both
/// pressures over those particles, less the normal elastic stress.
///
/// The source's own form, f_a = μ p'_a |Σ∇γ_as|/γ_a, delivers a share of μN that depends on where the
/// rows stand: 0.37 in two dimensions with h = 2 δr and the first at δr, 0.23 in three with 1.3 δr.
///
/// It acts on velocities after every kick, so that soil at rest stays there exactly. Phases of constant viscosity and no
/// elasticity (water) slip freely.
///
/// Source: Ghaïtanellis 2017, Eq. 4.115–4.123 (`literal`); the force of elements is ours.
pub struct CoulombFriction {
    /// Marks of phases that rub, in the order of their numbers.
    pub(crate) rubs: Vec<bool>,
    /// The pressure that makes friction, Pa.
    pub(crate) pressure: Field<Scalar>,
    /// Loads of the elements, of the state before the last kick.
    pub(crate) pressed: Vec<f64>,
}

impl CoulombFriction {
    /// Loads of particles on walls at the state of the last evaluation; called before a kick.
    fn pressed<const D: usize>(
        &self,
        world: &World<D>,
        terms: &[&dyn Interaction<D>],
    ) -> Result<Vec<f64>, StepError> {
        let elements = &world.walls.elements;
        if elements.coulomb.iter().all(|c| c.literal) {
            return Ok(vec![0.0; elements.centre.len()]);
        }
        let soil = self.soil(world)?;
        let rubbed = |c: &Contact<D>| {
            let coulomb = elements.coulomb[c.element as usize];
            coulomb.coefficient > 0.0 && !coulomb.literal
        };
        let own = |i: usize| world.walls.contacts.of_particle(i).iter();
        let slides = |i: usize| soil.rubs(i) && own(i).any(|c| rubbed(&c));
        Ok(soil.pressed(&wall_parts(world, terms, slides)?))
    }

    /// Brakes all particles at walls over a kick of `dt`, with what the elements get of
    /// [`Self::pressed`]; called after the kick. Returns the forces on the walls.
    fn apply<const D: usize>(
        &self,
        world: &mut World<D>,
        pressed: &[f64],
        dt: f64,
    ) -> Result<Vec<WallForce<D>>, StepError> {
        let soil = self.soil(world)?;
        let contacts = &world.walls.contacts;
        let particles = contacts.particles.par_iter().with_min_len(512);
        let pulls: Vec<Pull<D>> = particles
            .map(|&i| soil.pull(i as usize, pressed, dt))
            .collect();
        let velocity = world.free.get_mut(fields::VELOCITY)?;
        for (&particle, pull) in contacts.particles.iter().zip(&pulls) {
            velocity[particle as usize] += pull.change;
        }
        wall_forces(world, &pulls, dt)
    }

    fn soil<'a, const D: usize>(&'a self, world: &'a World<D>) -> Result<Soil<'a, D>, StepError> {
        let differs = self.pressure != fields::PRESSURE;
        Ok(Soil {
            phase: world.free.get(fields::PHASE).ok(),
            rubs: &self.rubs,
            velocity: world.free.get(fields::VELOCITY)?,
            pressure: world.free.get(fields::PRESSURE)?,
            effective: world.free.all(differs.then_some(self.pressure))?,
            stress: world.free.get(fields::CARRIED_STRESS).ok(),
            volume: world.free.get(fields::VOLUME)?,
            mass: world.free.get(fields::MASS)?,
            gamma: world.free.get(fields::RENORMALISATION).ok(),
            world,
        })
    }
}

impl<const D: usize> StepHook<D> for CoulombFriction {
    fn name(&self) -> String {
        "friction on walls".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both(fields::POSITION)
            .here((self.pressure, fields::PRESSURE, fields::VOLUME))
            .here(fields::MASS)
            .where_there((fields::PHASE, fields::CARRIED_STRESS))
            .writes(fields::VELOCITY)
            // What a particle presses on a wall holds sums over its neighbours, and an element sums that up.
            .rings(2)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::BeforeKick, StepPhase::AfterKick]
    }
    fn run(&mut self, phase: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        if phase == StepPhase::AfterKick {
            let pressed = std::mem::take(&mut self.pressed);
            let forces = self.apply(moment.world, &pressed, moment.dt)?;
            moment.push_walls(forces);
            return Ok(());
        }
        let forces: Vec<_> = moment.forces.iter().collect();
        self.pressed = self.pressed(moment.world, &forces)?;
        Ok(())
    }
}

struct Pull<const D: usize> {
    /// Change of the velocity, m/s.
    change: Vect<D>,
    /// Σ |∇γ_as| of the elements with friction, 1/m.
    gradient: f64,
}

/// Forces on every wall in a kick of `dt`, in the order of their numbers.
fn wall_forces<const D: usize>(
    world: &World<D>,
    pulls: &[Pull<D>],
    dt: f64,
) -> Result<Vec<WallForce<D>>, StepError> {
    let (elements, contacts) = (&world.walls.elements, &world.walls.contacts);
    let (position, mass) = world.free.all((fields::POSITION, fields::MASS))?;
    let owned = world.owned();
    let rubs = |s: usize, wall: usize| {
        elements.wall[s] as usize == wall && elements.coulomb[s].coefficient > 0.0
    };
    let on = |wall: usize| {
        if !(0..elements.coulomb.len()).any(|s| rubs(s, wall)) {
            return Ok(WallForce::zero());
        }
        let part = |k: usize| {
            let (i, pull) = (contacts.particles[k] as usize, &pulls[k]);
            let own = contacts.of_particle(i).iter();
            let rubbed = own.filter(|c| rubs(c.element as usize, wall));
            let gradient: f64 = rubbed.map(|c| c.gradient.norm()).sum();
            if gradient == 0.0 || !owned.has(i) {
                return None;
            }
            let force = -pull.change * (mass[i] * gradient / (pull.gradient * dt));
            Some(WallForce::parts(&position[i], &force))
        };
        Ok(WallForce::from_sums(world.sums_of(pulls.len(), &part)?))
    };
    (0..world.walls.names.len()).map(on).collect()
}

/// Sums over the particles before an element, or before a corner of elements.
#[derive(Clone, Copy, Default)]
struct ElementSums {
    /// Their forces on it, N.
    force: f64,
    /// Σ V_a|∇γ_as|.
    weight: f64,
    /// Σ V_a|∇γ_as| of the normal traction with the pressure between the grains, and with the whole.
    tractions: [f64; 2],
}

struct Soil<'a, const D: usize> {
    phase: Option<&'a [u32]>,
    rubs: &'a [bool],
    velocity: &'a [Vect<D>],
    pressure: &'a [f64],
    effective: Option<&'a [f64]>,
    stress: Option<&'a [Symmetric]>,
    volume: &'a [f64],
    mass: &'a [f64],
    gamma: Option<&'a [f64]>,
    world: &'a World<D>,
}

impl<const D: usize> Soil<'_, D> {
    fn rubs(&self, i: usize) -> bool {
        self.rubs[self.phase.map_or(0, |p| p[i] as usize)]
    }

    /// N_s over Σ V_a|∇γ_as| of every element and corner, N/m^(d−1).
    fn pressed(&self, parts: &[WallPart<D>]) -> Vec<f64> {
        let elements = &self.world.walls.elements;
        let contacts = &self.world.walls.contacts;
        let corners = match self.world.walls.at_corners {
            true => self.world.walls.points.position.len(),
            false => 0,
        };
        let mut before = vec![ElementSums::default(); elements.centre.len() + corners];
        for part in parts {
            let i = part.particle as usize;
            let own = contacts.of_particle(i);
            let on_wall = |c: &Contact<D>| elements.wall[c.element as usize] == part.wall;
            let all: f64 = own.iter().filter(on_wall).map(|c| c.gradient.norm()).sum();
            for contact in own.iter().filter(on_wall) {
                let normal = &elements.normal[contact.element as usize];
                let gradient = contact.gradient.norm();
                for (place, share) in elements.places(&contact) {
                    let weight = self.volume[i] * gradient * share;
                    let sums = &mut before[place];
                    sums.force -= part.force.dot(normal) * gradient / all * share;
                    sums.weight += weight;
                    if let Some(effective) = self.effective {
                        let stress = self.stress.map(|t| t[i].apply(normal).dot(normal));
                        let elastic = stress.unwrap_or(0.0);
                        sums.tractions[0] += weight * (effective[i] - elastic);
                        sums.tractions[1] += weight * (self.pressure[i] - elastic);
                    }
                }
            }
        }
        before.iter().map(|b| b.pressed(self.effective)).collect()
    }

    fn pull(&self, i: usize, pressed: &[f64], dt: f64) -> Pull<D> {
        let mut pull = Pull {
            change: Vect::zeros(),
            gradient: 0.0,
        };
        if !self.rubs(i) {
            return pull;
        }
        let elements = &self.world.walls.elements;
        let (mut along, mut strength) = (Vect::<D>::zeros(), 0.0);
        for contact in self.world.walls.contacts.of_particle(i) {
            let s = contact.element as usize;
            let coulomb = elements.coulomb[s];
            if coulomb.coefficient == 0.0 {
                continue;
            }
            let gradient = contact.gradient.norm();
            let weight = self.volume[i] * gradient;
            pull.gradient += gradient;
            along += self.sliding(i, &contact) * gradient;
            let normal = match coulomb.literal {
                true => {
                    let gamma = self.gamma.map_or(1.0, |g| g[i]);
                    self.effective.unwrap_or(self.pressure)[i].max(0.0) / gamma
                }
                false => {
                    let places = elements.places(&contact).into_iter();
                    places.map(|(place, share)| pressed[place] * share).sum()
                }
            };
            strength += coulomb.coefficient * normal * weight;
        }
        let sliding = along.norm() / pull.gradient.max(f64::MIN_POSITIVE);
        if sliding > 0.0 {
            let most = strength * dt / self.mass[i];
            pull.change = -along.normalize() * most.min(sliding);
        }
        pull
    }

    /// Velocity along an element, relative to it.
    fn sliding(&self, i: usize, contact: &Contact<D>) -> Vect<D> {
        let elements = &self.world.walls.elements;
        let relative = self.velocity[i] - elements.velocity_at(contact);
        let normal = &elements.normal[contact.element as usize];
        relative - normal * relative.dot(normal)
    }
}

impl ElementSums {
    /// N_s over the weights; only what presses makes friction.
    fn pressed(&self, effective: Option<&[f64]>) -> f64 {
        let [between, whole] = self.tractions;
        let share = match effective {
            None => 1.0,
            Some(_) if whole > 0.0 => (between / whole).clamp(0.0, 1.0),
            Some(_) => 0.0,
        };
        match self.weight > 0.0 {
            true => self.force.max(0.0) * share / self.weight,
            false => 0.0,
        }
    }
}

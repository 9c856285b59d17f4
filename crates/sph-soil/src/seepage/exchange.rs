//! The net of flow between particles; mass and momentum that seepage moves along it.

use sph_contribution::{Refusal, Setting};
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{Rows, Surroundings, World};

/// Phases that seep, each with the soil it seeps through.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Phase {
    /// Number of the phase with the pores.
    pub soil: u32,
    /// Number of the phase in them.
    pub water: u32,
    /// ρ_w, kg/m³.
    pub density: f64,
    /// c of the water, m/s.
    pub sound_speed: f64,
}

impl Phase {
    /// The water of this name in the pores of a soil; its refusals are at the key `water`.
    pub fn new<const D: usize>(
        setting: &Setting<'_, D>,
        kind: &'static str,
        soil: usize,
        name: &str,
    ) -> Result<Self, Refusal> {
        let water = setting.phase_number(kind, "water", name)?;
        if water == soil {
            let why = format!("`{name}` is the soil: name the phase in its pores");
            return Err(Refusal::at_key(kind, "water", why));
        }
        let reference = setting.laws[water].reference();
        Ok(Phase {
            soil: soil as u32,
            water: water as u32,
            density: reference.density,
            sound_speed: reference.sound_speed,
        })
    }
}

/// One way of the water, from a particle to a neighbour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link<const D: usize> {
    pub to: u32,
    /// Flux per drop of the potential, m^d/(Pa s).
    pub conductance: f64,
    /// Drop of the pressure at which nothing flows, Pa: weight and acceleration of the water.
    pub weight: f64,
    /// The same with the flux that there is, Pa.
    pub drop: f64,
    /// V_b |F_ab|, 1/m².
    pub share: f64,
    /// r_ab, m.
    pub separation: Vect<D>,
    /// Share λ of the way that is in the soil.
    pub within: f64,
    /// Volume that goes from the particle to the neighbour, m^d/s.
    pub flux: f64,
}

/// The particles that take part, in ascending order, and their links.
pub(crate) struct Net<const D: usize> {
    pub particles: Vec<u32>,
    pub links: Vec<Vec<Link<D>>>,
}

/// Places of some of `count` particles in their list.
pub(crate) fn places(particles: impl Iterator<Item = u32>, count: usize) -> Vec<u32> {
    let mut place = vec![u32::MAX; count];
    for (k, i) in (0..).zip(particles) {
        place[i as usize] = k;
    }
    place
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    /// χ.
    pub evening: f64,
    /// Share of its size that a water particle may give or take.
    pub limit: f64,
    /// Remedies for runs in which one gives or takes more.
    pub remedy: &'static str,
}

/// Share of its size by which a water particle must differ before it evens out.
const EVEN: f64 = 0.005;

pub(crate) struct Gains<const D: usize> {
    /// kg.
    pub mass: Vec<f64>,
    /// kg m/s.
    pub momentum: Vec<Vect<D>>,
}

impl<const D: usize> Gains<D> {
    /// None, of so many particles.
    pub fn none(particles: usize) -> Self {
        Gains {
            mass: vec![0.0; particles],
            momentum: vec![Vect::zeros(); particles],
        }
    }

    /// m' = m + gain and u' = (m u + gain)/m'. The density follows the mass, ρ' = ρ m'/m, and K with it.
    pub fn apply(&self, world: &mut World<D>) -> Result<(), StepError> {
        let free = &mut world.free;
        let mut mass = free.take(fields::MASS)?;
        let mut velocity = free.take(fields::VELOCITY)?;
        let mut offset = free.take(fields::DENSITY_CONSTANT)?;
        for i in 0..mass.len() {
            let gain = self.mass[i];
            if gain == 0.0 {
                continue;
            }
            let ratio = (mass[i] + gain) / mass[i];
            velocity[i] = (velocity[i] * mass[i] + self.momentum[i]) / (mass[i] + gain);
            mass[i] += gain;
            offset[i] *= ratio;
        }
        free.put(fields::MASS, mass)?;
        free.put(fields::VELOCITY, velocity)?;
        Ok(free.put(fields::DENSITY_CONSTANT, offset)?)
    }
}

impl Exchange {
    /// Hands ρ_wΔt Q_ab over from a to b, with the velocity of the giver.
    pub fn hand_over<const D: usize>(
        &self,
        world: &mut World<D>,
        phase: &Phase,
        net: &Net<D>,
        dt: f64,
    ) -> Result<(), StepError> {
        let velocity = world.free.get(fields::VELOCITY)?;
        let mut gains = Gains::none(velocity.len());
        for (&particle, links) in net.particles.iter().zip(&net.links) {
            let i = particle as usize;
            for link in links {
                let given = phase.density * dt * link.flux;
                let giver = if given > 0.0 { i } else { link.to as usize };
                gains.mass[i] -= given;
                gains.momentum[i] -= velocity[giver] * given;
            }
        }
        gains.apply(world)?;
        self.guard(world, phase)
    }

    /// Lets the sizes of water particles that seepage made unequal diffuse with χ c h.
    ///
    /// Mass is handed over as by seepage: the pressure makes room for it.
    pub fn even_out<const D: usize>(
        &self,
        world: &mut World<D>,
        phase: &Phase,
        dt: f64,
    ) -> Result<(), StepError> {
        let (number, mass) = world.free.all((fields::PHASE, fields::MASS))?;
        let whole = phase.density * world.spacing.powi(D as i32);
        let water = |i: usize| number[i] == phase.water;
        let uneven = |i: usize| (mass[i] / whole - 1.0).abs() > EVEN;
        let touched: Vec<usize> = (0..mass.len()).filter(|&i| water(i) && uneven(i)).collect();
        if touched.is_empty() || self.evening == 0.0 {
            return Ok(());
        }
        let (volume, velocity) = world.free.all((fields::VOLUME, fields::VELOCITY))?;
        let strength = self.evening * phase.sound_speed * world.kernel.smoothing_length() * dt;
        let mut gains = Gains::none(mass.len());
        let surroundings = Surroundings::new(world)?;
        let mut rows = Rows::default();
        for a in touched {
            let free = surroundings.neighbourhood(a, &mut rows).free;
            for (k, &b) in free.index.iter().enumerate() {
                let b = b as usize;
                // A pair of two that are uneven is met twice.
                if !water(b) || (b < a && uneven(b)) {
                    continue;
                }
                let mean = 0.5 * (volume[a] + volume[b]);
                let given = -2.0 * strength * mean * free.factor[k] * (mass[a] - mass[b]);
                let giver = if given > 0.0 { a } else { b };
                let momentum = velocity[giver] * given;
                gains.mass[a] -= given;
                gains.mass[b] += given;
                gains.momentum[a] -= momentum;
                gains.momentum[b] += momentum;
            }
        }
        gains.apply(world)
    }

    /// The water particle whose size differs most from that at the start, with its size over that.
    pub fn most_uneven<const D: usize>(
        world: &World<D>,
        phase: &Phase,
    ) -> Result<Option<(usize, f64)>, StepError> {
        let (number, mass) = world.free.all((fields::PHASE, fields::MASS))?;
        let whole = phase.density * world.spacing.powi(D as i32);
        // Sizes of copies are known to the owners.
        let owned = world.owned();
        let water = (0..mass.len()).filter(|&i| number[i] == phase.water && owned.has(i));
        let sizes = water.map(|i| (i, mass[i] / whole));
        // A size that is not a number is the largest.
        Ok(sizes.max_by(|(_, a), (_, b)| (a - 1.0).abs().total_cmp(&(b - 1.0).abs())))
    }

    /// Refuses water particles that have given or taken too much.
    pub fn guard<const D: usize>(&self, world: &World<D>, phase: &Phase) -> Result<(), StepError> {
        let Some((i, size)) = Self::most_uneven(world, phase)? else {
            return Ok(());
        };
        if (size - 1.0).abs() <= self.limit {
            return Ok(());
        }
        let reason = format!(
            "as the soil beside it has given or taken more than {} of its water: {}",
            self.limit, self.remedy
        );
        Err(world.bad_value("size", i, size, reason))
    }
}

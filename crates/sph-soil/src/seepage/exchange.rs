//! Mass and momentum that seepage moves between particles.

use sph_core::{StepError, Vect, fields};
use sph_neighbours::{Rows, Surroundings, World};

use crate::seepage::net::{Net, Phase};

/// Exchange between particles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    /// χ.
    pub evening: f64,
    /// Share of its size that a water particle may give or take.
    pub limit: f64,
}

/// Share of its size by which a water particle must differ before it evens out.
const EVEN: f64 = 0.005;

/// Gains of particles.
struct Gains<const D: usize> {
    mass: Vec<f64>,
    momentum: Vec<Vect<D>>,
}

impl<const D: usize> Gains<D> {
    fn none(particles: usize) -> Self {
        Gains {
            mass: vec![0.0; particles],
            momentum: vec![Vect::zeros(); particles],
        }
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
        apply(world, &gains)?;
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
        let number = world.free.get(fields::PHASE)?;
        let mass = world.free.get(fields::MASS)?;
        let whole = phase.density * world.spacing.powi(D as i32);
        let water = |i: usize| number[i] == phase.water;
        let uneven = |i: usize| (mass[i] / whole - 1.0).abs() > EVEN;
        let touched: Vec<usize> = (0..mass.len()).filter(|&i| water(i) && uneven(i)).collect();
        if touched.is_empty() || self.evening == 0.0 {
            return Ok(());
        }
        let volume = world.free.get(fields::VOLUME)?;
        let velocity = world.free.get(fields::VELOCITY)?;
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
        apply(world, &gains)
    }

    /// Refuses water particles that have given or taken too much.
    fn guard<const D: usize>(&self, world: &World<D>, phase: &Phase) -> Result<(), StepError> {
        let number = world.free.get(fields::PHASE)?;
        let mass = world.free.get(fields::MASS)?;
        let whole = phase.density * world.spacing.powi(D as i32);
        let size = |i: usize| mass[i] / whole;
        // Not `> limit`: a size that is not a number must be seen.
        let fair = |i: usize| (size(i) - 1.0).abs() <= self.limit;
        let mut all = 0..mass.len();
        // What copies of others' particles have, their owners know.
        let owned = world.owned();
        let Some(i) = all.find(|&i| number[i] == phase.water && owned.has(i) && !fair(i)) else {
            return Ok(());
        };
        let position = world.free.get(fields::POSITION)?[i];
        Err(StepError::Bad {
            quantity: "size",
            particle: world.free.get(fields::IDENTITY)?[i],
            position: position.iter().copied().collect(),
            value: size(i),
            reason: format!(
                "as seepage has given or taken more than {} of its water: raise \
                 `evening` or `size_limit` of [seepage], or take a finer spacing",
                self.limit
            ),
        })
    }
}

/// m' = m + gain and u' = (m u + gain)/m'. The density follows the mass, ρ' = ρ m'/m, and K with it.
fn apply<const D: usize>(world: &mut World<D>, gains: &Gains<D>) -> Result<(), StepError> {
    let free = &mut world.free;
    let mut mass = free.take(fields::MASS)?;
    let mut velocity = free.take(fields::VELOCITY)?;
    let mut offset = free.take(fields::DENSITY_CONSTANT)?;
    for i in 0..mass.len() {
        let gain = gains.mass[i];
        if gain == 0.0 {
            continue;
        }
        let ratio = (mass[i] + gain) / mass[i];
        velocity[i] = (velocity[i] * mass[i] + gains.momentum[i]) / (mass[i] + gain);
        mass[i] += gain;
        offset[i] *= ratio;
    }
    free.put(fields::MASS, mass)?;
    free.put(fields::VELOCITY, velocity)?;
    Ok(free.put(fields::DENSITY_CONSTANT, offset)?)
}

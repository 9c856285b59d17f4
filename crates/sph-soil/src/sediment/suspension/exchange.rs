//! Grains that leave a bed for the water, and come back.

use sph_core::bed::{Bed, horizontal};
use sph_core::{StepError, fields};
use sph_neighbours::World;

use crate::sediment::bed_shear::{WET, contacts};
use crate::sediment::{Grains, HinderedSettling, PickUp};

/// κ of the law of the wall.
const KARMAN: f64 = 0.41;

pub(super) struct BedExchange {
    pub law: Box<dyn PickUp>,
    pub grains: Grains,
    pub settling: HinderedSettling,
    /// Height a over the bed at which grains leave it, m.
    pub height: f64,
    /// Critical Shields number of a flat bed.
    pub critical: f64,
    /// Viscosity of the eddies over the diffusivity of the grains.
    pub schmidt: f64,
    /// 1 − n of the bed.
    pub solid: f64,
    /// Reference density of the fluid, kg/m³.
    pub density: f64,
}

/// Largest exchange between a particle and a place of the bed in a step, volumes of grains.
struct Pass {
    particle: usize,
    place: usize,
    lifted: f64,
    settled: f64,
}

impl BedExchange {
    /// Moves grains between a bed and the particles that touch it, for a step of `dt` seconds.
    ///
    /// Between the height a and a particle at the height z grains settle and mix in the shear of the wall: of the rate E at
    /// which the flow lifts them, E (a/z)^Z arrives with Z = σw/(κu*), and the particle's own grains settle past a. A particle
    /// stands for the heights of its extent, and (z/a)^Z is the mean over them.
    /// A place gives no more than lies over its rock, and a particle takes no more than packed grains.
    pub fn step<const D: usize>(
        &self,
        world: &World<D>,
        bed: &mut Bed,
        concentration: &mut [f64],
        dt: f64,
    ) -> Result<(), StepError> {
        let mut all = self.passes(world, bed, concentration, dt)?;
        let volume = world.free.get(fields::MASS)?;
        let volume = |i: usize| volume[i] / self.density;
        for own in all.chunk_by_mut(|a, b| a.particle == b.particle) {
            let i = own[0].particle;
            let (held, room) = (concentration[i], self.settling.packing - concentration[i]);
            let settled: f64 = own.iter().map(|pass| pass.settled).sum();
            let lifted: f64 = own.iter().map(|pass| pass.lifted).sum();
            let share = |wish: f64, most: f64| if wish > most { most / wish } else { 1.0 };
            let settling = share(settled, held.max(0.0) * volume(i));
            let lifting = share(lifted, room.max(0.0) * volume(i));
            for pass in own {
                pass.settled *= settling;
                pass.lifted *= lifting;
            }
        }
        let lifted: Vec<_> = all.iter().map(|pass| (pass.place, pass.lifted)).collect();
        let lifted = world.sums_by_place(&lifted, bed.grid.len())?;
        // No place gives more than lies over the rock when bed load has moved.
        let share = |place: usize| {
            let depth = bed.level(place) + dt * bed.rate[place] - bed.rock;
            let stock = depth.max(0.0) * self.solid * bed.grid.area(place);
            match !bed.held[place] && lifted[place] > stock {
                true => stock / lifted[place],
                false => 1.0,
            }
        };
        let shares: Vec<f64> = (0..bed.grid.len()).map(share).collect();
        for pass in &mut all {
            pass.lifted *= shares[pass.place];
            concentration[pass.particle] += (pass.lifted - pass.settled) / volume(pass.particle);
        }
        let passes = all.iter();
        let net = passes.map(|pass| (pass.place, pass.settled - pass.lifted));
        let changes = world.sums_by_place(&net.collect::<Vec<_>>(), bed.grid.len())?;
        for (place, change) in changes.iter().enumerate() {
            bed.lifted -= change;
            match bed.held[place] {
                true => bed.fed -= change,
                false => bed.rate[place] += change / (self.solid * bed.grid.area(place) * dt),
            }
        }
        Ok(())
    }

    /// Grains that the flow would lift and that settle, by particle and place.
    fn passes<const D: usize>(
        &self,
        world: &World<D>,
        bed: &Bed,
        concentration: &[f64],
        dt: f64,
    ) -> Result<Vec<Pass>, StepError> {
        let volume = world.free.get(fields::VOLUME)?;
        let elements = &world.walls.elements;
        let rates: Vec<[f64; 2]> = (0..bed.grid.len()).map(|k| self.rate(bed, k)).collect();
        // Particles and places, with the part of the bed, seen from above, that is the particle's, and its height over it.
        let mut parts: Vec<(usize, usize, f64, f64)> = Vec::new();
        for (i, contact) in contacts(world, bed) {
            let centre = elements.centre[contact.element as usize];
            let part = volume[i] * contact.gradient.norm();
            for (place, share) in bed.grid.around(horizontal(&centre.into())) {
                if share > 0.0 && !bed.covered[place] {
                    parts.push((i, place, part * share, contact.distance));
                }
            }
        }
        let weights = parts.iter().map(|(_, place, part, _)| (*place, *part));
        let weights = world.sums_by_place(&weights.collect::<Vec<_>>(), bed.grid.len())?;
        let filled = parts.into_iter().map(|(particle, place, part, distance)| {
            let area = bed.grid.area(place);
            let own = dt * area * part / weights[place].max(WET * 0.5 * area);
            let [rate, rouse] = rates[place];
            // A particle behind the line of an element is at its height.
            let (middle, half) = (
                distance.max(0.0),
                0.5 * volume[particle].powf(1.0 / D as f64),
            );
            let lower = (middle - half).max(0.0) / self.height;
            let upper = (middle + half) / self.height;
            let arriving = 1.0 / mean_resistance(lower, upper, rouse);
            Pass {
                particle,
                place,
                lifted: own * rate * arriving,
                settled: own * self.settling.demand(concentration[particle].max(0.0)),
            }
        });
        Ok(filled.collect())
    }

    /// The rate at which the flow lifts grains off a place, m/s, and Z there.
    fn rate(&self, bed: &Bed, place: usize) -> [f64; 2] {
        let [x, y] = bed.shear[place];
        let friction_velocity = x.hypot(y).sqrt();
        let speed = self.settling.speed;
        let excess = bed.shields(place) - bed.critical[place];
        let rate = self.law.rate(excess, self.critical, &self.grains, speed);
        // On a slope at its repose grains are loose without shear, too.
        match rate > 0.0 && friction_velocity > 0.0 {
            true => [rate, self.schmidt * speed / (KARMAN * friction_velocity)],
            false => [0.0; 2],
        }
    }
}

/// The mean of (z/a)^Z, where it is above 1, over the heights from `lower` to `upper`, heights over a.
fn mean_resistance(lower: f64, upper: f64, rouse: f64) -> f64 {
    // A difference of powers, one of which overflows where the shear is weak, would be no number.
    let (least, most, power) = (lower.max(1.0), upper.max(1.0), 1.0 + rouse);
    let over = most.powf(power) * (1.0 - (least / most).powf(power)) / power;
    (upper.min(1.0) - lower.min(1.0) + over) / (upper - lower)
}

#[cfg(test)]
mod tests {
    use super::mean_resistance;

    /// The mean is that of many heights, and infinite, not unknown, where grains rise no more.
    #[test]
    fn resistance_is_the_mean_over_the_extent() {
        for (lower, upper, rouse) in [(0.0, 10.0, 1.1), (3.0, 4.0, 2.9), (0.2, 0.9, 1.0)] {
            let height = |k: i32| lower + (upper - lower) * (f64::from(k) + 0.5) / 1e5;
            let all = (0..100_000).map(|k| height(k).max(1.0).powf(rouse));
            let mean = all.sum::<f64>() / 1e5;
            let found = mean_resistance(lower, upper, rouse);
            assert!((found / mean - 1.0).abs() < 1e-8, "{found} {mean}");
        }
        assert_eq!(mean_resistance(5.0, 15.0, 1e4), f64::INFINITY);
    }
}

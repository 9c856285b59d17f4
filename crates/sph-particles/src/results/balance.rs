//! Global sums over the free particles, in a fixed order for any number of threads.

use rayon::prelude::*;
use sph_core::{FieldError, Vect, fields};
use sph_solver::Flow;

/// Mach number from which densities move by ½ Ma² = 2 % and more: worth a word at the end of a run.
pub(crate) const FAST: f64 = 0.2;
/// Mach number from which densities change by Ma² ≈ 10 % and more: the run warns.
pub(crate) const COMPRESSIBLE: f64 = 0.3;
/// Mach number from which pressure cannot reach the fluid ahead: a weakly compressible law has no meaning.
pub(crate) const SUPERSONIC: f64 = 1.0;

const BATCH: usize = 4096;

/// Mass, momentum, energies and extrema.
#[derive(Clone, Copy, Debug)]
pub struct Balance<const D: usize> {
    /// Σ m, kg.
    pub mass: f64,
    /// Σ m u, kg m/s.
    pub momentum: Vect<D>,
    /// Σ m |u|, kg m/s.
    pub momentum_scale: f64,
    /// Σ ½ m u², J.
    pub kinetic: f64,
    /// −Σ m g·r, J.
    pub potential: f64,
    /// Σ m ∫p/ρ² dρ, and Σ V τ:τ/4𝒢 of elastic stresses, J.
    pub internal: f64,
    /// Σ m c² with the speeds of sound at rest, J.
    pub acoustic: f64,
    /// Largest |u|, m/s.
    pub fastest: f64,
    /// Largest |u| over the speed of sound of its phase, 1.
    pub mach: f64,
    /// Mass that is faster than [`FAST`], [`COMPRESSIBLE`] and [`SUPERSONIC`] of its sound, kg.
    pub faster: [f64; 3],
    /// Least and largest density over reference density.
    pub density_range: [f64; 2],
}

impl<const D: usize> Balance<D> {
    pub fn zero() -> Self {
        Balance {
            mass: 0.0,
            momentum: Vect::zeros(),
            momentum_scale: 0.0,
            kinetic: 0.0,
            potential: 0.0,
            internal: 0.0,
            acoustic: 0.0,
            fastest: 0.0,
            mach: 0.0,
            faster: [0.0; 3],
            density_range: [f64::INFINITY, f64::NEG_INFINITY],
        }
    }

    fn and(self, o: Self) -> Self {
        let ([least, largest], [low, high]) = (self.density_range, o.density_range);
        Balance {
            mass: self.mass + o.mass,
            momentum: self.momentum + o.momentum,
            momentum_scale: self.momentum_scale + o.momentum_scale,
            kinetic: self.kinetic + o.kinetic,
            potential: self.potential + o.potential,
            internal: self.internal + o.internal,
            acoustic: self.acoustic + o.acoustic,
            fastest: self.fastest.max(o.fastest),
            mach: self.mach.max(o.mach),
            faster: std::array::from_fn(|k| self.faster[k] + o.faster[k]),
            density_range: [least.min(low), largest.max(high)],
        }
    }

    /// Name, unit and value of its columns in the series, besides those of the momentum.
    pub fn columns(&self) -> [(&'static str, &'static str, f64); 6] {
        let [least, largest] = self.density_range;
        [
            ("kinetic_energy", "J", self.kinetic),
            ("potential_energy", "J", self.potential),
            ("internal_energy", "J", self.internal),
            ("largest_speed", "m/s", self.fastest),
            ("least_density_ratio", "1", least),
            ("largest_density_ratio", "1", largest),
        ]
    }

    /// Kinetic, potential and internal energy together, J.
    pub fn energy(&self) -> f64 {
        self.kinetic + self.potential + self.internal
    }

    /// The sums of a flow.
    pub fn from_flow(flow: &Flow<D>) -> Result<Self, FieldError> {
        let free = &flow.world.free;
        let mass = free.get(fields::MASS)?;
        let velocity = free.get(fields::VELOCITY)?;
        let position = free.get(fields::POSITION)?;
        let density = free.get(fields::DENSITY)?;
        let phase = free.get(fields::PHASE).ok();
        let gravity = flow.world.steady_gravity;
        let laws = &flow.laws;
        let stored = flow.stored.iter().filter_map(|s| s.energy(&flow.world));
        let stored: Vec<_> = stored.collect();
        let strained = |i: usize| stored.iter().map(|energy| energy(i)).sum::<f64>();
        let one = |i: usize| {
            let (m, u) = (mass[i], velocity[i]);
            let phase = phase.map_or(0, |p| p[i] as usize);
            let law = &laws[phase];
            let speed = u.norm();
            let mach = speed / law.reference().sound_speed;
            let ratio = density[i] / law.reference().density;
            Balance {
                mass: m,
                momentum: u * m,
                momentum_scale: m * speed,
                kinetic: 0.5 * m * speed * speed,
                potential: -m * gravity.dot(&position[i]),
                internal: m * law.internal_energy(density[i]) + strained(i),
                acoustic: m * law.reference().sound_speed.powi(2),
                fastest: speed,
                mach,
                faster: [FAST, COMPRESSIBLE, SUPERSONIC]
                    .map(|most| if mach > most { m } else { 0.0 }),
                density_range: [ratio; 2],
            }
        };
        let batch = |b: usize| {
            let range = b * BATCH..((b + 1) * BATCH).min(mass.len());
            range.map(one).fold(Self::zero(), Self::and)
        };
        let batches = (0..mass.len().div_ceil(BATCH)).into_par_iter();
        let parts: Vec<Self> = batches.map(batch).collect();
        Ok(parts.into_iter().fold(Self::zero(), Self::and))
    }
}

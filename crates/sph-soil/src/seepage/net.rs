//! The net of flow between particles, with its ways.

use sph_core::Vect;

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

/// One way of the water, from a particle to a neighbour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link<const D: usize> {
    /// The neighbour.
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

impl<const D: usize> Net<D> {
    /// Place of every particle in the net.
    pub fn slots(&self, particles: usize) -> Vec<u32> {
        let mut slot = vec![u32::MAX; particles];
        for (k, &i) in self.particles.iter().enumerate() {
            slot[i as usize] = k as u32;
        }
        slot
    }
}

//! Particles that come in while a flow runs.

use std::sync::Arc;

use sph_core::Vect;

/// A particle that comes into the flow at the end of a step.
///
/// Its density is that of the equation of state's pressure there; the quantity that a formulation integrates follows
/// from it. Densities that are sums get its mass at once: let a particle in with little of it, or where no particle is
/// near.
#[derive(Clone, Debug)]
pub struct Newborn<const D: usize> {
    /// Position, m.
    pub position: Vect<D>,
    /// Velocity, m/s.
    pub velocity: Vect<D>,
    /// Density, kg/m³.
    pub density: f64,
    /// Mass, kg (per metre of depth in two dimensions).
    pub mass: f64,
    /// Number of its phase.
    pub phase: u32,
    /// Its origin, for columns that [begin](crate::Birth) with it.
    pub body: Arc<str>,
    /// Values of columns that contributions bring along, by the names of the columns; the others begin with the values
    /// of the columns.
    pub values: Arc<[(String, f64)]>,
}

//! The fluid in front of an element of an open face.

use sph_core::Vect;

use crate::FluidMean;

/// The fluid in front of an element.
pub(crate) struct AdjacentFluid<const D: usize> {
    pub inside: FluidMean<D>,
    /// Distance of that mean before the face, m.
    pub reach: f64,
    pub row: Vect<D>,
    pub mix: Vec<f64>,
    pub lacks: f64,
    /// Distance of the nearest particle, m.
    pub nearest: f64,
}

//! The fluid in front of an element of an open face.

use sph_core::Vect;
use sph_neighbours::Words;

use crate::FluidMean;

/// The fluid in front of an element, the same for all owners, so that all let the same pass.
#[derive(Clone)]
pub(crate) struct AdjacentFluid<const D: usize> {
    pub inside: FluidMean<D>,
    /// Distance of that mean before the face, m.
    pub reach: f64,
    /// Velocity of the row of particles, m/s.
    pub row: Vect<D>,
    /// Shares of the phases.
    pub mix: Vec<f64>,
    /// The missing part of the row, over the weight of a row on the face: φ − ½ with a row at φ δr.
    pub lacks: f64,
    /// Distance of the nearest particle to the centre, m.
    pub nearest: f64,
}

impl<const D: usize> AdjacentFluid<D> {
    /// That where no particle is near.
    pub fn new(phases: usize) -> Self {
        AdjacentFluid {
            inside: FluidMean::nothing(),
            reach: 0.0,
            row: Vect::zeros(),
            mix: vec![0.0; phases],
            lacks: 0.0,
            nearest: f64::INFINITY,
        }
    }

    /// Calls a function with every number.
    fn each(&mut self, mut visit: impl FnMut(&mut f64)) {
        let inside = &mut self.inside;
        visit(&mut inside.pressure);
        visit(&mut inside.impedance);
        visit(&mut inside.density);
        visit(&mut inside.mean_pressure);
        visit(&mut inside.filled);
        visit(&mut self.reach);
        visit(&mut self.lacks);
        visit(&mut self.nearest);
        let vectors = [&mut inside.velocity, &mut inside.mean, &mut self.row];
        let vectors = vectors.into_iter().flat_map(|v| v.iter_mut());
        vectors.chain(&mut self.mix).for_each(visit);
    }
}

impl<const D: usize> Words for AdjacentFluid<D> {
    fn write(&self, to: &mut Vec<u64>) {
        to.extend([u64::from(self.inside.wet), self.mix.len() as u64]);
        self.clone().each(|x| to.push(x.to_bits()));
    }

    fn read(from: &[u64]) -> Self {
        let mut seen = AdjacentFluid::new(from[1] as usize);
        seen.inside.wet = from[0] != 0;
        let mut numbers = from[2..].iter();
        seen.each(|x| *x = numbers.next().map_or(0.0, |bits| f64::from_bits(*bits)));
        seen
    }
}

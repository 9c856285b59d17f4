//! The fluid in front of faces, the same for all owners, so that all let the same pass.

use sph_core::{StepError, Vect};
use sph_neighbours::{Words, World};

use crate::FluidMean;
use crate::adjacent_fluid::AdjacentFluid;
use crate::faces::Faces;

impl<const D: usize> Words for AdjacentFluid<D> {
    fn write(&self, to: &mut Vec<u64>) {
        let inside = &self.inside;
        to.push(u64::from(inside.wet));
        let scalars = [
            inside.pressure,
            inside.impedance,
            inside.density,
            inside.mean_pressure,
            self.reach,
            inside.filled,
            self.lacks,
            self.nearest,
        ];
        let vectors = [&inside.velocity, &inside.mean, &self.row];
        let numbers = scalars
            .into_iter()
            .chain(vectors.into_iter().flat_map(|v| v.iter().copied()));
        to.extend(numbers.chain(self.mix.iter().copied()).map(f64::to_bits));
    }

    fn read(from: &[u64]) -> Self {
        let real = |k: usize| f64::from_bits(from[k]);
        let vector = |n: usize| Vect::from_fn(|k, _| real(9 + n * D + k));
        AdjacentFluid {
            inside: FluidMean {
                wet: from[0] != 0,
                pressure: real(1),
                impedance: real(2),
                density: real(3),
                mean_pressure: real(4),
                filled: real(6),
                velocity: vector(0),
                mean: vector(1),
            },
            reach: real(5),
            lacks: real(7),
            nearest: real(8),
            row: vector(2),
            mix: (9 + 3 * D..from.len()).map(real).collect(),
        }
    }
}

impl<const D: usize> Faces<D> {
    /// The means of all [elements](sph_neighbours::OwnedElements), each where it counts.
    pub(crate) fn agreed(
        &self,
        world: &World<D>,
        looked: Vec<AdjacentFluid<D>>,
    ) -> Result<Vec<AdjacentFluid<D>>, StepError> {
        let owned = world.owned_elements()?;
        let looks = |k: usize| {
            let candidates = || world.lists.of_points.candidates(k);
            owned.has_around(&self.places[k].centre, candidates)
        };
        world.agreed(looked, looks, |k| self.nothing(k))
    }

    /// The mean where no particle is near.
    pub(crate) fn nothing(&self, k: usize) -> AdjacentFluid<D> {
        let (mean_pressure, mean) = match self.memory.dt > 0.0 {
            true => self.memory.mean[k],
            false => (0.0, Vect::zeros()),
        };
        AdjacentFluid {
            inside: FluidMean {
                mean,
                mean_pressure,
                ..FluidMean::nothing()
            },
            reach: 0.0,
            lacks: 0.0,
            nearest: f64::INFINITY,
            row: Vect::zeros(),
            mix: vec![0.0; self.whole.len()],
        }
    }
}

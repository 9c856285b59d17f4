//! The rates that an integrator keeps within a step.

use rayon::prelude::*;
use sph_core::{Evolved, FieldError, Store, Vect, fields};
use sph_neighbours::World;
use sph_neighbours::decomposition::{PartError, Parts};

/// Rates of all particles, in the order of the kept state.
#[derive(Default)]
pub struct KeptRates<const D: usize> {
    acceleration: Vec<Vect<D>>,
    /// One column per evolved scalar.
    scalars: Vec<Vec<f64>>,
}

impl<const D: usize> KeptRates<D> {
    /// Copies the present rates, in the order of the kept state.
    pub(crate) fn keep(&mut self, free: &Store<D>, evolved: &[Evolved]) -> Result<(), FieldError> {
        free.get(fields::ACCELERATION)?
            .clone_into(&mut self.acceleration);
        self.scalars.resize_with(evolved.len(), Vec::new);
        for (evolved, column) in evolved.iter().zip(&mut self.scalars) {
            free.get(evolved.rate)?.clone_into(column);
        }
        Ok(())
    }

    /// Rates become the mean of the present and the kept ones; `places` are those of the particles in the kept state.
    pub(crate) fn average(
        &self,
        free: &mut Store<D>,
        evolved: &[Evolved],
        places: Option<&[u32]>,
    ) -> Result<(), FieldError> {
        let at = |i: usize| places.map_or(i, |places| places[i] as usize);
        let accelerations = free.get_mut(fields::ACCELERATION)?.par_iter_mut();
        let accelerations = accelerations.enumerate().with_min_len(2048);
        accelerations.for_each(|(i, a)| *a = (*a + self.acceleration[at(i)]) * 0.5);
        for (evolved, column) in evolved.iter().zip(&self.scalars) {
            let rates = free.get_mut(evolved.rate)?.par_iter_mut();
            let rates = rates.enumerate().with_min_len(2048);
            rates.for_each(|(i, r)| *r = (*r + column[at(i)]) * 0.5);
        }
        Ok(())
    }
}

/// All particles of a rank as they were when the state was kept; nothing where one process has all.
#[derive(Default)]
pub struct SavedParticles<const D: usize> {
    free: Option<Store<D>>,
    /// Lists built until then.
    builds: u64,
}

impl<const D: usize> SavedParticles<D> {
    pub(crate) fn keep(&mut self, parts: Option<&Parts<D>>, world: &World<D>) {
        if parts.is_some() {
            self.free = Some(world.free.copied());
            self.builds = world.lists.builds;
        }
    }

    /// The copies in the order of the particles that this rank has now, if some have gone and come since.
    pub(crate) fn follow(
        &mut self,
        parts: Option<&Parts<D>>,
        world: &World<D>,
    ) -> Result<Option<&Store<D>>, PartError> {
        let (Some(parts), Some(free)) = (parts, &mut self.free) else {
            return Ok(None);
        };
        // All ranks build their lists together.
        let builds = world.lists.builds;
        if builds == self.builds {
            return Ok(None);
        }
        parts.follow(free, &world.free)?;
        self.builds = builds;
        Ok(Some(free))
    }
}

#[cfg(test)]
mod tests {
    use sph_core::{Field, Role, Scalar};

    use super::*;

    const SALT: Field<Scalar> = Field::new("salt", "1", "mass fraction");
    const SALT_RATE: Field<Scalar> = Field::new("salt_rate", "1/s", "its rate");

    /// Heun's mean, of each particle with itself, independent of its place when the rates were kept.
    #[test]
    fn rates_are_the_mean_of_both_ends_of_a_step() {
        let evolved = [Evolved {
            value: SALT,
            rate: SALT_RATE,
        }];
        let mut free = Store::<2>::new(3);
        free.add(fields::ACCELERATION, Role::Derived);
        free.add(SALT_RATE, Role::Derived);
        let set = |free: &mut Store<2>, rates: [f64; 3]| {
            *free.get_mut(SALT_RATE).expect("added") = rates.to_vec();
            let vectors = rates.map(|r| Vect::<2>::new(r, -r));
            *free.get_mut(fields::ACCELERATION).expect("added") = vectors.to_vec();
        };
        set(&mut free, [1.0, 2.0, 4.0]);
        let mut kept = KeptRates::default();
        kept.keep(&free, &evolved).expect("columns");
        for (places, mean) in [(None, [3.0, 4.0, 6.0]), (Some([2, 0, 1]), [4.5, 3.5, 5.0])] {
            set(&mut free, [5.0, 6.0, 8.0]);
            let places = places.as_ref().map(|p: &[u32; 3]| &p[..]);
            kept.average(&mut free, &evolved, places).expect("columns");
            assert_eq!(free.get(SALT_RATE).expect("added"), mean);
            let vectors = mean.map(|r| Vect::<2>::new(r, -r));
            assert_eq!(free.get(fields::ACCELERATION).expect("added"), vectors);
        }
    }
}

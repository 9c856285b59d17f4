//! The state and the rates that an integrator keeps within a step.

use rayon::prelude::*;
use sph_core::{Evolved, FieldError, Recall, StepError, Store, Vect, fields};

use super::{Flow, Snapshot};

#[derive(Default)]
pub(crate) struct KeptState<const D: usize> {
    state: Snapshot<D>,
    rates: KeptRates<D>,
    /// All particles of a rank, and the number of lists built until then; nothing where one process has all.
    image: Option<(Store<D>, u64)>,
}

impl<const D: usize> Flow<D> {
    pub(crate) fn keep_within_step(&mut self) -> Result<(), FieldError> {
        let mut kept = std::mem::take(&mut self.kept);
        let world = &self.world;
        let done = kept.state.take(self);
        let done = done.and_then(|()| kept.rates.keep(&world.free, &self.evolved));
        if self.parts.is_some() {
            kept.image = Some((world.free.copied(), world.lists.builds));
        }
        self.kept = kept;
        done
    }

    pub(crate) fn recall_kept(&mut self, what: Recall) -> Result<(), StepError> {
        self.kept_follows()?;
        let kept = std::mem::take(&mut self.kept);
        let done = kept.state.recall(self, what);
        self.kept = kept;
        Ok(done?)
    }

    /// Rates become the mean of the present and the kept ones.
    pub(crate) fn average_with_kept(&mut self) -> Result<(), StepError> {
        self.kept_follows()?;
        let (free, kept) = (&mut self.world.free, &self.kept);
        let places = kept.state.places(free)?;
        Ok(kept.rates.average(free, &self.evolved, places.as_deref())?)
    }

    /// Brings the kept values to the present particles of this rank, if some have gone and come since.
    fn kept_follows(&mut self) -> Result<(), StepError> {
        let (free, now) = (&self.world.free, self.world.lists.builds);
        let KeptState {
            state,
            rates,
            image,
        } = &mut self.kept;
        // All ranks build their lists together.
        if let (Some(parts), Some((image, builds))) = (&self.parts, image)
            && *builds != now
        {
            parts.follow(image, free)?;
            *builds = now;
            state.follow(image)?;
            rates.keep(image, &self.evolved)?;
        }
        Ok(())
    }
}

/// Rates of all particles, in the order of the kept state.
#[derive(Default)]
struct KeptRates<const D: usize> {
    acceleration: Vec<Vect<D>>,
    /// One column per evolved scalar.
    scalars: Vec<Vec<f64>>,
}

impl<const D: usize> KeptRates<D> {
    /// Copies the present rates, in the order of the kept state.
    fn keep(&mut self, free: &Store<D>, evolved: &[Evolved]) -> Result<(), FieldError> {
        free.get(fields::ACCELERATION)?
            .clone_into(&mut self.acceleration);
        self.scalars.resize_with(evolved.len(), Vec::new);
        for (evolved, column) in evolved.iter().zip(&mut self.scalars) {
            free.get(evolved.rate)?.clone_into(column);
        }
        Ok(())
    }

    /// `places` are those of the particles in the kept state.
    fn average(
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

//! Sums over all ranks of a flow, and updates of copies of particles.

use sph_core::{Access, Stage, StepError};

use crate::World;

/// Data written as whole numbers, and read elsewhere.
pub trait Words: Sized {
    /// Writes the numbers behind others.
    fn write(&self, to: &mut Vec<u64>);

    /// Reads the written numbers.
    fn read(from: &[u64]) -> Self;
}

/// An item of a list behind its place there.
impl<T: Words> Words for (usize, T) {
    fn write(&self, to: &mut Vec<u64>) {
        to.push(self.0 as u64);
        self.1.write(to);
    }

    fn read(from: &[u64]) -> Self {
        (from[0] as usize, T::read(&from[1..]))
    }
}

impl<const D: usize> World<D> {
    /// Replaces each value by the largest of all.
    ///
    /// # Errors
    /// If the particles elsewhere are lost; as everywhere below.
    pub fn largest(&self, values: &mut [f64]) -> Result<(), StepError> {
        match &self.communicator {
            Some(link) => Ok(link.agree(false, values)?),
            None => Ok(()),
        }
    }

    /// The items of all, one's own among them.
    pub fn of_all<T: Words>(&self, own: Vec<T>) -> Result<Vec<T>, StepError> {
        let Some(link) = &self.communicator else {
            return Ok(own);
        };
        let mut words = Vec::new();
        for item in &own {
            let length = words.len();
            words.push(0);
            item.write(&mut words);
            words[length] = (words.len() - length - 1) as u64;
        }
        let words = link.gather(&words)?;
        let (mut all, mut rest) = (Vec::new(), &words[..]);
        while let Some((length, behind)) = rest.split_first() {
            let (item, others) = behind.split_at((*length as usize).min(behind.len()));
            all.push(T::read(item));
            rest = others;
        }
        Ok(all)
    }

    /// A list of which each item is known where it is `owned`, and `otherwise` nowhere.
    pub fn agreed<T: Words>(
        &self,
        list: Vec<T>,
        owned: impl Fn(usize) -> bool,
        otherwise: impl Fn(usize) -> T,
    ) -> Result<Vec<T>, StepError> {
        if self.communicator.is_none() {
            return Ok(list);
        }
        let mut all: Vec<T> = (0..list.len()).map(otherwise).collect();
        let known = list.into_iter().enumerate().filter(|(k, _)| owned(*k));
        for (k, item) in self.of_all(known.collect())? {
            if let Some(place) = all.get_mut(k) {
                *place = item;
            }
        }
        Ok(all)
    }

    /// Runs a stage within other work: copies of particles follow their owners at once.
    ///
    /// # Errors
    /// Those of the stage.
    pub fn run(&mut self, stage: &mut dyn Stage<World<D>>) -> Result<(), StepError> {
        stage.run(self)?;
        match self.communicator.is_some() {
            true => self.refresh(&stage.access()),
            false => Ok(()),
        }
    }

    /// Gives copies the sums of work with this access over the neighbours of their owners. The rest is computed for
    /// copies, too.
    pub fn refresh(&mut self, access: &Access) -> Result<(), StepError> {
        let sums = access.sweep && !access.writes.is_empty();
        match self.communicator.as_ref().filter(|_| sums) {
            Some(link) => Ok(link.update_ghosts(&mut self.free, |f| access.writes.contains(f))?),
            None => Ok(()),
        }
    }
}

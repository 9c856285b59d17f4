//! Contacts of all particles with wall elements.

use std::ops::Range;

use rayon::prelude::*;

use crate::{Contact, ContactBlock, ContactRow};

/// The contacts of every free particle, near walls only.
///
/// They stay in the blocks in which tasks find them: putting them one behind the other would move more memory than the
/// sweep that reads them.
#[derive(Clone, Debug, Default)]
pub struct Contacts<const D: usize> {
    /// Particles that have contacts, ascending.
    pub particles: Vec<u32>,
    /// Block and planes of the contacts of every free particle; no plane where it sees no wall.
    places: Vec<(u32, Range<u32>)>,
    blocks: Vec<ContactBlock<D>>,
}

impl<const D: usize> Contacts<D> {
    /// The contacts of a particle.
    #[inline(always)]
    pub fn of_particle(&self, particle: usize) -> ContactRow<'_, D> {
        match self.places.get(particle) {
            Some((block, planes)) if !planes.is_empty() => {
                self.blocks[*block as usize].row(planes.clone())
            }
            _ => ContactRow::NONE,
        }
    }

    /// The contacts of all particles, by particle.
    pub fn all(&self) -> impl Iterator<Item = Contact<D>> {
        let particles = self.particles.iter();
        particles.flat_map(|&p| self.of_particle(p as usize))
    }

    /// True if no particle has any.
    pub fn is_empty(&self) -> bool {
        self.particles.is_empty()
    }

    /// Sets pressures and volumes from those of elements and of the weights of their corners.
    pub(crate) fn set_states(
        &mut self,
        state: impl Fn(u32, Option<[f64; D]>) -> [f64; 2] + Send + Sync,
    ) {
        let blocks = self.blocks.par_iter_mut().with_min_len(16);
        blocks.for_each(|block| block.set_states(&state));
    }

    /// Bytes that all contacts need; buffers may hold more.
    pub fn bytes(&self) -> usize {
        let blocks = self.blocks.iter().map(ContactBlock::bytes).sum::<usize>();
        blocks + size_of_val(&self.places[..]) + 4 * self.particles.len()
    }

    /// Clears the contacts, so that `particles` free ones have none, and hands out the blocks for new ones.
    pub fn take_blocks(&mut self, particles: usize) -> Vec<ContactBlock<D>> {
        self.particles.clear();
        self.places.clear();
        self.places.resize(particles, (0, 0..0));
        std::mem::take(&mut self.blocks)
    }

    /// Takes the blocks back; [`place`](Self::place) gives the place of a particle's contacts.
    pub fn put_blocks(&mut self, blocks: Vec<ContactBlock<D>>) {
        self.blocks = blocks;
    }

    /// The contacts of a particle are on these planes of a block; particles come in ascending order.
    pub fn place(&mut self, particle: u32, block: usize, planes: Range<u32>) {
        if planes.is_empty() {
            return;
        }
        self.particles.push(particle);
        self.places[particle as usize] = (block as u32, planes);
    }
}

#[cfg(test)]
mod tests {
    use sph_core::Vect;

    use super::*;

    #[test]
    fn contacts_are_found_where_they_were_put() {
        let mut contacts = Contacts::<2>::default();
        assert!(contacts.of_particle(0).is_empty());
        assert!(contacts.take_blocks(4).is_empty());
        let block = |planes: &[&[(u32, f64)]]| {
            let mut block = ContactBlock::default();
            for (k, shares) in planes.iter().enumerate() {
                let normal = Vect::<2>::new(0.0, 1.0);
                block.push(normal, k as f64, shares.iter().copied());
            }
            block
        };
        let first = block(&[&[(7, 1.0), (5, 0.0), (8, 2.0)], &[(6, 0.0)], &[(4, 3.0)]]);
        assert_eq!(first.planes(), 2);
        contacts.put_blocks(vec![first, block(&[&[(9, 4.0)]])]);
        contacts.place(0, 0, 0..2);
        contacts.place(1, 0, 2..2);
        contacts.place(3, 1, 0..1);
        assert_eq!(contacts.particles, [0, 3]);
        let elements =
            |k: usize| -> Vec<u32> { contacts.of_particle(k).iter().map(|c| c.element).collect() };
        assert_eq!(
            [0, 1, 2, 3, 4].map(elements),
            [vec![7, 8, 4], vec![], vec![], vec![9], vec![]]
        );
        assert_eq!(contacts.of_particle(0).len(), 3);
        assert_eq!(
            [0, 1, 3].map(|k| contacts.of_particle(k).elements().len()),
            [3, 0, 1]
        );
        let sizes = contacts.all().map(|c| (c.gradient[1], c.distance));
        assert_eq!(
            sizes.collect::<Vec<_>>(),
            [(1.0, 0.0), (2.0, 0.0), (3.0, 2.0), (4.0, 0.0)]
        );
        contacts.set_states(|element, _| [f64::from(element), 2.0]);
        let pressures: Vec<_> = contacts.all().map(|c| c.pressure).collect();
        assert_eq!(pressures, [7.0, 8.0, 4.0, 9.0]);
        let mut one = ContactBlock::default();
        one.push_row(contacts.of_particle(0), |element| element != 8);
        let kept = one.row(0..2).iter().map(|c| (c.element, c.pressure));
        assert_eq!(kept.collect::<Vec<_>>(), [(7, 7.0), (4, 4.0)]);
        contacts.take_blocks(4);
        assert!(contacts.is_empty() && contacts.of_particle(3).is_empty());
    }
}

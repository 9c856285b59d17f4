//! Who touches which wall element.

use std::ops::Range;

use sph_core::Vect;

/// A wall element within the support of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Contact<const D: usize> {
    /// Which element.
    pub element: u32,
    /// Its share of ∇γ at the particle, along the inward normal, 1/m.
    pub gradient: Vect<D>,
    /// Distance of the particle from the element's plane, m; negative behind it.
    pub distance: f64,
}

/// The contacts of every free particle, near walls only.
///
/// They stay in the blocks in which tasks find them: putting them one behind the other would move more memory than the
/// sweep that reads them.
#[derive(Clone, Debug, Default)]
pub struct Contacts<const D: usize> {
    /// Particles that have contacts, ascending.
    pub particles: Vec<u32>,
    /// For every free particle where its contacts are.
    places: Vec<Place>,
    blocks: Vec<Vec<Contact<D>>>,
}

/// A range of a block; empty where a particle sees no wall.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    block: u32,
    from: u32,
    to: u32,
}

impl<const D: usize> Contacts<D> {
    /// The contacts of a particle.
    #[inline(always)]
    pub fn of(&self, particle: usize) -> &[Contact<D>] {
        match self.places.get(particle) {
            Some(place) if place.from < place.to => {
                &self.blocks[place.block as usize][place.from as usize..place.to as usize]
            }
            _ => &[],
        }
    }

    /// The contacts of all particles, by particle.
    pub fn all(&self) -> impl Iterator<Item = &Contact<D>> {
        self.particles.iter().flat_map(|&p| self.of(p as usize))
    }

    /// Whether no particle has any.
    pub fn is_empty(&self) -> bool {
        self.particles.is_empty()
    }

    /// Forgets the contacts, so that `particles` free ones have none, and hands out the blocks for new ones.
    pub fn take_blocks(&mut self, particles: usize) -> Vec<Vec<Contact<D>>> {
        self.particles.clear();
        self.places.clear();
        self.places.resize(particles, Place::default());
        std::mem::take(&mut self.blocks)
    }

    /// Takes the blocks back; [`place`](Self::place) tells whose contacts are where.
    pub fn put_blocks(&mut self, blocks: Vec<Vec<Contact<D>>>) {
        self.blocks = blocks;
    }

    /// The contacts of a particle are this range of a block; particles come in ascending order.
    pub fn place(&mut self, particle: u32, block: usize, range: Range<u32>) {
        if range.is_empty() {
            return;
        }
        self.particles.push(particle);
        self.places[particle as usize] = Place {
            block: block as u32,
            from: range.start,
            to: range.end,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(element: u32) -> Contact<2> {
        Contact {
            element,
            gradient: Vect::zeros(),
            distance: 0.0,
        }
    }

    #[test]
    fn contacts_are_found_where_they_were_put() {
        let mut contacts = Contacts::default();
        assert!(contacts.of(0).is_empty());
        assert!(contacts.take_blocks(4).is_empty());
        contacts.put_blocks(vec![vec![contact(7), contact(8)], vec![contact(9)]]);
        contacts.place(0, 0, 0..2);
        contacts.place(1, 0, 2..2);
        contacts.place(3, 1, 0..1);
        assert_eq!(contacts.particles, [0, 3]);
        let elements =
            |k: usize| -> Vec<u32> { contacts.of(k).iter().map(|c| c.element).collect() };
        assert_eq!(
            [0, 1, 2, 3, 4].map(elements),
            [vec![7, 8], vec![], vec![], vec![9], vec![]]
        );
        assert_eq!(
            contacts.all().map(|c| c.element).collect::<Vec<_>>(),
            [7, 8, 9]
        );
        contacts.take_blocks(4);
        assert!(contacts.is_empty() && contacts.of(3).is_empty());
    }
}

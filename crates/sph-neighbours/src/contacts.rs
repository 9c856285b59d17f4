//! Contacts of particles with wall elements.

use std::ops::Range;

use sph_core::Vect;

/// A wall element within the support of a particle.
#[derive(Clone, Copy, Debug)]
pub struct Contact<const D: usize> {
    /// Number of the element.
    pub element: u32,
    /// Its share of ∇γ at the particle, along the inward normal, 1/m.
    pub gradient: Vect<D>,
    /// Distance of the particle from the element's plane, m; negative behind it.
    pub distance: f64,
}

/// Elements of one plane that a particle sees.
#[derive(Clone, Copy, Debug)]
struct Run<const D: usize> {
    normal: Vect<D>,
    distance: f64,
    from: u32,
    to: u32,
}

/// Contacts of some particles, one behind the other. Common values of the elements of one plane are stored once.
#[derive(Clone, Debug, Default)]
pub struct ContactBlock<const D: usize> {
    runs: Vec<Run<D>>,
    elements: Vec<u32>,
    /// |∇γ_as|, 1/m.
    weights: Vec<f64>,
}

impl<const D: usize> ContactBlock<D> {
    /// Clears all.
    pub fn clear(&mut self) {
        self.runs.clear();
        self.elements.clear();
        self.weights.clear();
    }

    /// Planes so far: those of one particle are a range.
    pub fn planes(&self) -> u32 {
        self.runs.len() as u32
    }

    /// Drops all planes but the first ones.
    pub fn truncate(&mut self, planes: u32) {
        self.runs.truncate(planes as usize);
        let end = self.runs.last().map_or(0, |run| run.to as usize);
        self.elements.truncate(end);
        self.weights.truncate(end);
    }

    /// Adds those elements of a plane whose share of ∇γ is not 0: the inward unit normal, the distance of the particle from
    /// the plane, m, and |∇γ_as| of each element, 1/m.
    #[inline(always)]
    pub fn push(
        &mut self,
        normal: Vect<D>,
        distance: f64,
        shares: impl ExactSizeIterator<Item = (u32, f64)>,
    ) {
        let from = self.elements.len();
        let most = from + shares.len();
        self.elements.resize(most, 0);
        self.weights.resize(most, 0.0);
        // Without a branch for those that are left out.
        let (elements, weights) = (&mut self.elements[..], &mut self.weights[..]);
        let mut to = from;
        for (element, weight) in shares {
            elements[to] = element;
            weights[to] = weight;
            to += usize::from(weight != 0.0);
        }
        self.elements.truncate(to);
        self.weights.truncate(to);
        if from < to {
            self.runs.push(Run {
                normal,
                distance,
                from: from as u32,
                to: to as u32,
            });
        }
    }

    /// The contacts on a range of planes.
    #[inline(always)]
    pub fn row(&self, planes: Range<u32>) -> ContactRow<'_, D> {
        ContactRow {
            runs: &self.runs[planes.start as usize..planes.end as usize],
            elements: &self.elements,
            weights: &self.weights,
        }
    }

    /// Adds those of a row whose elements count.
    pub fn push_row(&mut self, row: ContactRow<'_, D>, counts: impl Fn(u32) -> bool) {
        for run in row.runs {
            let range = run.from as usize..run.to as usize;
            let all = row.elements[range.clone()].iter().zip(&row.weights[range]);
            let share = |(&element, &weight): (&u32, &f64)| match counts(element) {
                true => (element, weight),
                false => (element, 0.0),
            };
            self.push(run.normal, run.distance, all.map(share));
        }
    }

    /// Bytes that its contacts need; buffers may hold more.
    pub fn bytes(&self) -> usize {
        let one = size_of::<u32>() * self.elements.len();
        one + size_of::<f64>() * self.weights.len() + size_of::<Run<D>>() * self.runs.len()
    }
}

/// The contacts of one particle.
#[derive(Clone, Copy, Debug)]
pub struct ContactRow<'a, const D: usize> {
    runs: &'a [Run<D>],
    elements: &'a [u32],
    weights: &'a [f64],
}

impl<'a, const D: usize> ContactRow<'a, D> {
    /// Of a particle that sees no wall.
    pub const NONE: Self = ContactRow {
        runs: &[],
        elements: &[],
        weights: &[],
    };

    /// Their number.
    pub fn len(&self) -> usize {
        self.runs
            .iter()
            .map(|run| (run.to - run.from) as usize)
            .sum()
    }

    /// True if there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Their elements: those of one particle follow each other.
    pub fn elements(&self) -> &'a [u32] {
        let ends = self.runs.first().zip(self.runs.last());
        ends.map_or(&[], |(first, last)| {
            &self.elements[first.from as usize..last.to as usize]
        })
    }

    /// Distances of the particle from the planes of the elements, m.
    pub fn distances(&self) -> impl Iterator<Item = f64> + 'a {
        self.runs.iter().map(|run| run.distance)
    }

    /// One after the other.
    #[inline(always)]
    pub fn iter(&self) -> ContactIter<'a, D> {
        ContactIter {
            row: *self,
            normal: Vect::zeros(),
            distance: 0.0,
            next: 0,
            end: 0,
        }
    }
}

impl<'a, const D: usize> IntoIterator for ContactRow<'a, D> {
    type Item = Contact<D>;
    type IntoIter = ContactIter<'a, D>;

    #[inline(always)]
    fn into_iter(self) -> ContactIter<'a, D> {
        self.iter()
    }
}

/// Goes over a [`ContactRow`].
#[derive(Clone, Debug)]
pub struct ContactIter<'a, const D: usize> {
    /// The rest of it without the present plane.
    row: ContactRow<'a, D>,
    normal: Vect<D>,
    distance: f64,
    next: usize,
    end: usize,
}

impl<const D: usize> Iterator for ContactIter<'_, D> {
    type Item = Contact<D>;

    #[inline(always)]
    fn next(&mut self) -> Option<Contact<D>> {
        if self.next == self.end {
            let (run, rest) = self.row.runs.split_first()?;
            self.row.runs = rest;
            (self.normal, self.distance) = (run.normal, run.distance);
            (self.next, self.end) = (run.from as usize, run.to as usize);
        }
        let k = self.next;
        self.next += 1;
        Some(Contact {
            element: self.row.elements[k],
            gradient: self.normal * self.row.weights[k],
            distance: self.distance,
        })
    }
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
    places: Vec<ContactRange>,
    blocks: Vec<ContactBlock<D>>,
}

/// Planes of a block; none where a particle sees no wall.
#[derive(Clone, Copy, Debug, Default)]
struct ContactRange {
    block: u32,
    from: u32,
    to: u32,
}

impl<const D: usize> Contacts<D> {
    /// The contacts of a particle.
    #[inline(always)]
    pub fn of_particle(&self, particle: usize) -> ContactRow<'_, D> {
        match self.places.get(particle) {
            Some(place) if place.from < place.to => {
                self.blocks[place.block as usize].row(place.from..place.to)
            }
            _ => ContactRow::NONE,
        }
    }

    /// The contacts of all particles, by particle.
    pub fn all(&self) -> impl Iterator<Item = Contact<D>> {
        self.particles
            .iter()
            .flat_map(|&p| self.of_particle(p as usize))
    }

    /// True if no particle has any.
    pub fn is_empty(&self) -> bool {
        self.particles.is_empty()
    }

    /// Bytes that all contacts need; buffers may hold more.
    pub fn bytes(&self) -> usize {
        let blocks = self.blocks.iter().map(ContactBlock::bytes).sum::<usize>();
        blocks + size_of::<ContactRange>() * self.places.len() + 4 * self.particles.len()
    }

    /// Clears the contacts, so that `particles` free ones have none, and hands out the blocks for new ones.
    pub fn take_blocks(&mut self, particles: usize) -> Vec<ContactBlock<D>> {
        self.particles.clear();
        self.places.clear();
        self.places.resize(particles, ContactRange::default());
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
        self.places[particle as usize] = ContactRange {
            block: block as u32,
            from: planes.start,
            to: planes.end,
        };
    }
}

#[cfg(test)]
mod tests {
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
        let sizes: Vec<_> = contacts
            .all()
            .map(|c| (c.gradient[1], c.distance))
            .collect();
        assert_eq!(sizes, [(1.0, 0.0), (2.0, 0.0), (3.0, 2.0), (4.0, 0.0)]);
        contacts.take_blocks(4);
        assert!(contacts.is_empty() && contacts.of_particle(3).is_empty());
    }
}

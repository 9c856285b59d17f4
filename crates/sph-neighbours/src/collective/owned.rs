//! Particles and elements of walls that count in sums over all.

use sph_core::{FieldError, Vect, fields};

use crate::World;

/// Particles, or rows of theirs, that count: all but the copies of those that are at home elsewhere.
#[derive(Clone, Debug)]
pub struct Owned(Option<Vec<bool>>);

impl Owned {
    /// True if there are no copies.
    pub fn all(&self) -> bool {
        self.0.is_none()
    }

    /// True if a particle counts.
    #[inline]
    pub fn has(&self, particle: usize) -> bool {
        self.0.as_ref().is_none_or(|own| own[particle])
    }

    /// The same of rows, each of a particle.
    pub fn of_rows(&self, particles: &[u32]) -> Self {
        let rows = |own: &Vec<bool>| particles.iter().map(|p| own[*p as usize]).collect();
        Owned(self.0.as_ref().map(rows))
    }

    pub(crate) fn marks(&self) -> Option<&[bool]> {
        self.0.as_deref()
    }
}

impl<const D: usize> World<D> {
    /// The particles that count in sums over all.
    pub fn owned(&self) -> Owned {
        Owned(self.communicator.as_ref().map(|link| link.own(&self.free)))
    }

    /// Particles whose sums over neighbours are not needed, because their owner sends them; `None` if all are needed.
    pub fn idle(&self) -> Option<Vec<bool>> {
        let link = self.communicator.as_ref().filter(|link| link.rings == 1)?;
        Some(link.own(&self.free).iter().map(|own| !own).collect())
    }

    /// The elements of walls that count in sums over all.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn owned_elements(&self) -> Result<OwnedElements<'_, D>, FieldError> {
        let owned = self.owned();
        let looked = match owned.all() {
            true => None,
            false => Some(self.free.all((fields::IDENTITY, fields::POSITION))?),
        };
        Ok(OwnedElements {
            world: self,
            owned,
            looked,
        })
    }
}

/// Elements of walls that count: where there are copies, those whose mean over the fluid has the particle of the lowest
/// number at home here. All others in the mean are then here too, or copies of them.
pub struct OwnedElements<'a, const D: usize> {
    world: &'a World<D>,
    owned: Owned,
    /// Numbers and places of the particles, where there are copies.
    looked: Option<(&'a [u32], &'a [Vect<D>])>,
}

impl<const D: usize> OwnedElements<'_, D> {
    /// True if an element counts; where there are copies, none without a particle within a support.
    pub fn has(&self, element: usize) -> bool {
        let (walls, lists) = (&self.world.walls, &self.world.lists);
        if self.looked.is_none() {
            return true;
        }
        if !walls.at_corners {
            let candidates = lists.of_elements.candidates(element);
            return self.has_first([(&walls.elements.centre[element], candidates)]);
        }
        let (list, place) = (lists.of_corners(&walls.points), &walls.points.position);
        let corner = |c: u32| (&place[c as usize], list.candidates(c as usize));
        self.has_first(walls.elements.corners[element].map(corner))
    }

    /// The same of a place on a wall, with all particles that may be within a support of it.
    pub fn has_around<'c>(&self, place: &Vect<D>, candidates: impl FnOnce() -> &'c [u32]) -> bool {
        self.looked.is_none() || self.has_first([(place, candidates())])
    }

    /// True if the particle of the lowest number within a support of any of some places is at home here.
    fn has_first<const N: usize>(&self, places: [(&Vect<D>, &[u32]); N]) -> bool {
        let (world, Some((identity, position))) = (self.world, self.looked) else {
            return true;
        };
        let support = world.kernel.support_radius().powi(2);
        let all = places.iter().flat_map(|(place, candidates)| {
            let near = move |j: &usize| {
                (world.domain.nearest_image(position[*j] - *place)).norm_squared() < support
            };
            candidates.iter().map(|j| *j as usize).filter(near)
        });
        all.min_by_key(|j| identity[*j])
            .is_some_and(|j| self.owned.has(j))
    }
}

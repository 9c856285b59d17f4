//! Contacts of a few particles with wall elements.

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
    /// Weights of the element's corners at the place of the contact, ∫ x w dS/∫ w dS over what the particle sees of a
    /// face; none at the element's centre.
    pub corners: Option<[f64; D]>,
    /// Pressure there, Pa.
    pub pressure: f64,
    /// Volume of a whole particle there, m^d.
    pub volume: f64,
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
    weights: Vec<f64>,
    /// Weights of corners, 0 at the centre of an element; none in the plane.
    corners: Vec<[f64; D]>,
    /// Pressure, Pa, and volume of a whole particle, m^d.
    states: Vec<[f64; 2]>,
}

impl<const D: usize> ContactBlock<D> {
    /// Clears all.
    pub fn clear(&mut self) {
        self.runs.clear();
        self.resize(0);
    }

    #[inline(always)]
    fn resize(&mut self, contacts: usize) {
        self.elements.resize(contacts, 0);
        self.weights.resize(contacts, 0.0);
        self.states.resize(contacts, [0.0; 2]);
        if D == 3 {
            self.corners.resize(contacts, [0.0; D]);
        }
    }

    /// Planes so far: those of one particle are a range.
    pub fn planes(&self) -> u32 {
        self.runs.len() as u32
    }

    /// Drops all planes but the first ones.
    pub fn truncate(&mut self, planes: u32) {
        self.runs.truncate(planes as usize);
        self.resize(self.runs.last().map_or(0, |run| run.to as usize));
    }

    /// Adds one contact for all that the particle sees of a face: the inward unit normal, the distance of the particle from
    /// the plane, m, |∇γ_as| of the face, 1/m, the element at the mean place, and the weights of its corners there.
    #[inline(always)]
    pub fn push_face(
        &mut self,
        normal: Vect<D>,
        distance: f64,
        weight: f64,
        (element, corners): (u32, [f64; D]),
    ) {
        if weight == 0.0 {
            return;
        }
        self.push(normal, distance, std::iter::once((element, weight)));
        if let Some(last) = self.corners.last_mut() {
            *last = corners;
        }
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
        self.resize(from + shares.len());
        // Without a branch for those that are left out.
        let (elements, weights) = (&mut self.elements[..], &mut self.weights[..]);
        let mut to = from;
        for (element, weight) in shares {
            elements[to] = element;
            weights[to] = weight;
            to += usize::from(weight != 0.0);
        }
        self.resize(to);
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
            of: Some(self),
        }
    }

    /// Adds those of a row whose elements count.
    pub fn push_row(&mut self, row: ContactRow<'_, D>, counts: impl Fn(u32) -> bool) {
        let Some(of) = row.of else { return };
        for run in row.runs {
            let all = run.from as usize..run.to as usize;
            for k in all.filter(|k| counts(of.elements[*k])) {
                let corners = of.corners.get(k).copied().unwrap_or([0.0; D]);
                let at = (of.elements[k], corners);
                self.push_face(run.normal, run.distance, of.weights[k], at);
                if let Some(last) = self.states.last_mut() {
                    *last = of.states[k];
                }
            }
        }
    }

    /// Sets pressures and volumes from those of elements and of the weights of their corners.
    pub(crate) fn set_states(&mut self, state: &impl Fn(u32, Option<[f64; D]>) -> [f64; 2]) {
        for (k, (own, element)) in self.states.iter_mut().zip(&self.elements).enumerate() {
            *own = state(*element, weighted(self.corners.get(k)));
        }
    }

    /// Bytes that its contacts need; buffers may hold more.
    pub fn bytes(&self) -> usize {
        let one = size_of::<u32>() + size_of::<f64>() + size_of::<[f64; 2]>();
        one * self.elements.len()
            + size_of::<[f64; D]>() * self.corners.len()
            + size_of::<Run<D>>() * self.runs.len()
    }
}

#[inline(always)]
fn weighted<const D: usize>(corners: Option<&[f64; D]>) -> Option<[f64; D]> {
    corners.copied().filter(|of| *of != [0.0; D])
}

/// The contacts of one particle.
#[derive(Clone, Copy, Debug)]
pub struct ContactRow<'a, const D: usize> {
    runs: &'a [Run<D>],
    /// None without any run.
    of: Option<&'a ContactBlock<D>>,
}

impl<'a, const D: usize> ContactRow<'a, D> {
    /// Of a particle that sees no wall.
    pub const NONE: Self = ContactRow {
        runs: &[],
        of: None,
    };

    /// Their number.
    pub fn len(&self) -> usize {
        (self.runs.iter().map(|run| run.to - run.from)).sum::<u32>() as usize
    }

    /// True if there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Their elements: those of one particle follow each other.
    pub fn elements(&self) -> &'a [u32] {
        let ends = self.runs.first().zip(self.runs.last());
        ends.zip(self.of).map_or(&[], |((first, last), of)| {
            &of.elements[first.from as usize..last.to as usize]
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
        let (k, of) = (self.next, self.row.of?);
        self.next += 1;
        let [pressure, volume] = of.states.get(k).copied().unwrap_or_default();
        Some(Contact {
            element: of.elements[k],
            gradient: self.normal * of.weights[k],
            distance: self.distance,
            corners: weighted(of.corners.get(k)),
            pressure,
            volume,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_is_one_contact_with_the_state_at_its_place() {
        let mut block = ContactBlock::<3>::default();
        let up = Vect::<3>::z();
        block.push(up, 0.5, [(4, 1.0), (5, 2.0)].into_iter());
        block.push_face(up, 0.5, 3.0, (6, [0.5, 0.3, 0.2]));
        block.push_face(up, 0.5, 0.0, (7, [1.0, 0.0, 0.0]));
        let state = |element: u32, corners: Option<[f64; 3]>| {
            let at = corners.map_or(0.0, |c| c[0] + 10.0 * c[1] + 100.0 * c[2]);
            [f64::from(element) + at, 1.0]
        };
        block.set_states(&state);
        let all = block.row(0..2).iter().map(|c| (c.gradient[2], c.pressure));
        assert_eq!(
            all.collect::<Vec<_>>(),
            [(1.0, 4.0), (2.0, 5.0), (3.0, 29.5)]
        );
    }
}

//! Sums over whole faces of triangles.

use sph_core::Vect;
use sph_neighbours::ContactBlock;

use crate::geometry::shells::ShellSums;
use crate::geometry::walls::faces::Corner;
use crate::integrals::spatial::{Foot, Weights};
use crate::{GammaSum, NearElement, Renormalisation3d, Walls};

impl Walls<3> {
    /// The triangles of a row, sorted by image and triangle, by face and image.
    pub(crate) fn faces<'a>(
        &'a self,
        mut row: &'a [NearElement<3>],
    ) -> impl Iterator<Item = &'a [NearElement<3>]> + 'a {
        std::iter::from_fn(move || {
            let first = row.first()?;
            let face = self.mesh.elements[first.index()].face;
            let end = self.planes.faces[face].end;
            let same = |n: &NearElement<3>| n.image == first.image && n.element < end;
            let (part, rest) = row.split_at(first_other(row, same));
            row = rest;
            Some(part)
        })
    }

    /// A corner of an image of a face relative to a point, m: bitwise that of
    /// [`Mesh::corners_from`](crate::Mesh::corners_from).
    #[inline(always)]
    pub(crate) fn seen(&self, corner: &Corner, image: [i8; 3], point: &Vect<3>) -> Vect<3> {
        let from = corner.position - point;
        if corner.image == [0; 3] && image == [0; 3] {
            return from;
        }
        let shift = |k: usize| corner.image[k] + i32::from(image[k]);
        from + Vect::from(self.mesh.domain.shift([shift(0), shift(1), shift(2)]))
    }

    /// A point as the image of a wall sees it, m.
    fn unshifted(&self, point: &Vect<3>, image: [i8; 3]) -> [f64; 3] {
        match image {
            [0, 0, 0] => (*point).into(),
            _ => (point - Vect::from(self.mesh.domain.shift(image.map(i32::from)))).into(),
        }
    }

    /// A row with all triangles within a distance of a point, m, of the faces of which it has one.
    pub(crate) fn expanded(
        &self,
        point: &Vect<3>,
        row: &[NearElement<3>],
        distance: f64,
    ) -> Vec<NearElement<3>> {
        let (mut all, mut found) = (Vec::new(), Vec::new());
        for part in self.faces(row) {
            let face = &self.planes.faces[self.mesh.elements[part[0].index()].face];
            let Some(map) = &face.map else {
                all.extend_from_slice(part);
                continue;
            };
            let image = part[0].image;
            let foot = face.plane.foot(self.unshifted(point, image));
            map.within(foot, distance, &mut found);
            all.extend(found.iter().map(|&element| NearElement { element, image }));
        }
        all
    }

    /// Adds the integrals of the faces of a row to γ of a point, and pushes their contacts but for those of `hidden`
    /// shells.
    pub(crate) fn see(
        &self,
        integrals: &Renormalisation3d,
        (point, row): (&Vect<3>, &[NearElement<3>]),
        weights: &mut Weights,
        contacts: &mut ContactBlock<3>,
        (sides, hidden): (&mut ShellSums, &[u32]),
    ) -> GammaSum<3> {
        let radius = integrals.kernel_radius();
        let mut sum = GammaSum::<3>::default();
        for part in self.faces(row) {
            let image = part[0].image;
            let first = &self.mesh.elements[part[0].index()];
            let normal = Vect::from(first.normal);
            let corner = Corner::new(&self.mesh, first.nodes[0], first.images[0]);
            let height = -self.seen(&corner, image, point).dot(&normal);
            if height.abs() >= radius {
                continue;
            }
            let face = &self.planes.faces[first.face];
            let foot = Foot {
                place: face.plane.foot(self.unshifted(point, image)),
                height,
                reach: (radius * radius - height * height).sqrt(),
            };
            let map = face.map.as_ref();
            let seen = match map {
                Some(map) => map.is_within(foot.place, foot.reach),
                None => {
                    let triangles = part.iter().map(|near| near.element);
                    weights.find(triangles, &self.planes.circles, &foot)
                }
            };
            if !seen {
                continue;
            }
            let edges = face.edges.iter().map(|[start, end]| {
                let start = self.seen(start, image, point).into();
                [start, self.seen(end, image, point).into()]
            });
            let whole = integrals.polygon(height, first.normal, edges);
            sum.add(&whole, first.normal);
            let shell = self.shells.shell_of(part[0].index());
            sides.add(shell, whole.gamma);
            // At the end of the support rounding may have any sign, and a mean place needs a weight.
            let unseen = whole.kernel == 0.0 || map.is_some() && whole.kernel < 0.0;
            if unseen || hidden.contains(&shell) {
                continue;
            }
            if let Some(map) = map {
                let at = face.plane.part(whole.moment);
                // Where next to nothing of the face is seen, rounding may lead out of reach.
                let scale = 1.0 / whole.kernel.max(at[0].hypot(at[1]) / foot.reach);
                let place = [0, 1].map(|k| foot.place[k] + at[k] * scale);
                contacts.push_face(normal, height, whole.kernel, map.find(place));
                continue;
            }
            weights.weigh(integrals, &self.planes.patches, &foot);
            let (elements, weights) = weights.all();
            let mut total = 0.0;
            for weight in weights {
                total += weight;
            }
            let scale = whole.kernel / total;
            let share = |(&element, &weight): (&u32, &f64)| match weight > 0.0 {
                true => (element, weight * scale),
                false => (element, 0.0),
            };
            contacts.push(normal, height, elements.iter().zip(weights).map(share));
        }
        sum
    }
}

/// Index of the first entry of a row that is unlike the entries before it. Steps of a fixed size are foreseen by the
/// processor, those of a bisection are not.
#[inline(always)]
fn first_other<T>(row: &[T], same: impl Fn(&T) -> bool) -> usize {
    const STEP: usize = 16;
    let mut from = 1;
    while row.get(from + STEP).is_some_and(&same) {
        from += STEP;
    }
    let others = row[from..].iter().position(|n| !same(n));
    others.map_or(row.len(), |k| from + k)
}

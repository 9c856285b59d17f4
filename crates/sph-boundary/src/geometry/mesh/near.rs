//! Elements of a mesh near one or many points.

use sph_core::{BoxTree, nearest_place};

use super::elements::Mesh;
use super::tree::{ElementTree, NearElement, NearRows, ROUNDING, Sphere};
use crate::geometry::vector::{add, bounds, dot, norm, sub, widened};

/// Diagonal of the box around points that are served together, over the radius.
const TOGETHER: f64 = 0.75;

#[derive(Default)]
struct Candidates<const D: usize> {
    /// By image and element.
    found: Vec<NearElement<D>>,
    spheres: Vec<Sphere<D>>,
    /// Image and element as one number, and the place among the entries.
    keys: Vec<(u64, u32)>,
}

impl<const D: usize> ElementTree<D> {
    /// Of the present position of the walls, for queries up to the radius `reach`, m.
    ///
    /// With periodic directions, points in the box or within `reach` of it are served.
    pub fn build(mesh: &Mesh<D>, reach: f64) -> Self {
        let (mut entries, mut spheres) = (Vec::new(), Vec::new());
        let domain = &mesh.domain;
        let (mut margin, mut radii) = ([0.0; D], Vec::with_capacity(mesh.elements.len()));
        for (e, element) in mesh.elements.iter().enumerate() {
            let arms = mesh.corners(e).map(|corner| sub(corner, element.centre));
            for (k, margin) in margin.iter_mut().enumerate() {
                *margin = arms.iter().fold(*margin, |m: f64, arm| m.max(arm[k].abs()));
            }
            let radius = arms.into_iter().map(norm).fold(0.0, f64::max);
            // Rounding loses nothing.
            radii.push(radius * (1.0 + ROUNDING));
        }
        let reached = |k: usize| 2.0 * reach + margin[k] * (1.0 + ROUNDING);
        let margin: [f64; D] = std::array::from_fn(reached);
        let box_ = [sub(domain.lower, margin), add(domain.upper, margin)];
        for (e, element) in mesh.elements.iter().enumerate() {
            for image in domain.images_within(box_, [element.centre; 2]) {
                if let Some(near) = NearElement::new(e, image) {
                    entries.push(near);
                    spheres.push(Sphere {
                        centre: add(element.centre, domain.shift(image)),
                        radius: radii[e],
                    });
                }
            }
        }
        let boxes = spheres.iter().map(|s| widened([s.centre; 2], s.radius));
        ElementTree {
            reach,
            tree: BoxTree::new(boxes.collect()),
            entries,
            spheres,
        }
    }

    /// Images of elements nearer than `radius` to a point, ascending by element, then image;
    /// `radius` at most the reach of the tree.
    pub fn near<'a>(
        &'a self,
        mesh: &'a Mesh<D>,
        point: [f64; D],
        radius: f64,
    ) -> impl Iterator<Item = NearElement<D>> + 'a {
        debug_assert!(radius <= self.reach, "query beyond the reach of the tree");
        let mut found = Vec::new();
        self.tree.each(widened([point; 2], radius), |place| {
            let Some(distance2) = self.spheres[place].within(point, radius) else {
                return;
            };
            let near = self.entries[place];
            // The mean of the corners is in the element.
            let surely = distance2 < radius * radius * (1.0 - ROUNDING);
            if surely || {
                let (offset, _) = nearest_place([0.0; D], &mesh.corners_from(point, near));
                dot(offset, offset) < radius * radius
            } {
                found.push(near);
            }
        });
        found.sort_unstable();
        found.into_iter()
    }

    /// Appends for every point the images of elements that may be nearer than `radius`, because the spheres around them
    /// are, by image and element; `radius` at most the reach of the tree.
    ///
    /// The tree is searched once, and what it finds is sorted once, for neighbouring points that follow one another; each
    /// takes what is in its own reach.
    pub fn rows(&self, points: &[[f64; D]], radius: f64, rows: &mut NearRows<D>) {
        debug_assert!(radius <= self.reach, "query beyond the reach of the tree");
        let mut candidates = Candidates::default();
        let mut rest = points;
        while !rest.is_empty() {
            let (group, after) = rest.split_at(count_within(rest, TOGETHER * radius));
            rest = after;
            self.gather(group, radius, &mut candidates);
            for point in group {
                candidates.add_reached(*point, radius, rows);
            }
        }
    }

    /// All that a point of the group may have, by image and element.
    fn gather(&self, group: &[[f64; D]], radius: f64, candidates: &mut Candidates<D>) {
        let around = bounds(group.iter().copied());
        candidates.keys.clear();
        self.tree
            .each(widened(around, radius * (1.0 + ROUNDING)), |place| {
                let key = key(&self.entries[place]);
                candidates.keys.push((key, place as u32));
            });
        candidates.keys.sort_unstable();
        let places = || candidates.keys.iter().map(|(_, place)| *place as usize);
        candidates.found.clear();
        let found = places().map(|place| self.entries[place]);
        candidates.found.extend(found);
        candidates.spheres.clear();
        let spheres = places().map(|place| self.spheres[place]);
        candidates.spheres.extend(spheres);
    }
}

impl<const D: usize> Candidates<D> {
    fn add_reached(&self, point: [f64; D], radius: f64, rows: &mut NearRows<D>) {
        let (elements, mut n) = (&mut rows.elements, 0);
        let from = elements.len();
        elements.extend_from_slice(&self.found);
        let slots = &mut elements[from..];
        for (near, sphere) in self.found.iter().zip(&self.spheres) {
            slots[n] = *near;
            n += usize::from(sphere.within(point, radius).is_some());
        }
        elements.truncate(from + n);
        rows.counts.push(n as u32);
    }
}

/// Number of points from the first on that lie in a box of at most this diagonal, m.
fn count_within<const D: usize>(points: &[[f64; D]], diagonal: f64) -> usize {
    let (mut lower, mut upper) = (points[0], points[0]);
    let apart = |point: &[f64; D]| {
        lower = std::array::from_fn(|k| lower[k].min(point[k]));
        upper = std::array::from_fn(|k| upper[k].max(point[k]));
        let across = sub(upper, lower);
        dot(across, across) > diagonal * diagonal
    };
    let rest = &points[1..];
    1 + rest.iter().position(apart).unwrap_or(rest.len())
}

/// Ascending by image, then element.
fn key<const D: usize>(near: &NearElement<D>) -> u64 {
    let place = |periods: i8| u64::from((i16::from(periods) + 128) as u16);
    let images = near.image.into_iter();
    let image = images.fold(0, |all, periods| (all << 8) | place(periods));
    (image << 32) | u64::from(near.element)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_ascend_by_image_and_element() {
        let near = |element, image| NearElement { element, image };
        let ascending = [
            near(9, [-127, 4, 0]),
            near(0, [-1, 127, 127]),
            near(u32::MAX, [0, -1, 0]),
            near(3, [0, 0, -1]),
            near(2, [0, 0, 0]),
            near(3, [0, 0, 0]),
            near(0, [127, 0, 0]),
        ];
        assert!(ascending.map(|n| key(&n)).is_sorted());
        assert!(ascending.map(|n| (n.image, n.element)).is_sorted());
    }

    #[test]
    fn points_go_together_while_their_box_is_small() {
        let points = [0.0, 0.4, -0.3, 0.8, 0.9].map(|x| [x, 0.1, 0.0]);
        assert_eq!(count_within(&points, 0.75), 3);
        assert_eq!(count_within(&points[3..], 0.75), 2);
        assert_eq!(count_within(&points, 0.0), 1);
    }
}

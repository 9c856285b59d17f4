//! Elements of a mesh near a point.

use super::closest::nearest_to_origin;
use super::elements::Mesh;
use super::grid::{Grid, ROUNDING, Sphere};
use super::near_element::NearElement;
use crate::geometry::vector::{add, dot, norm, sub};

impl<const D: usize> Grid<D> {
    /// Lists for the present position of the walls and queries up to the radius `reach`, m.
    ///
    /// With periodic directions, points in the box or within `reach` of it are served.
    pub fn build(mesh: &Mesh<D>, reach: f64) -> Self {
        let mut images = Vec::with_capacity(mesh.elements.len());
        let domain = &mesh.domain;
        let (mut margin, mut radii) = ([0.0; D], Vec::with_capacity(mesh.elements.len()));
        for (e, element) in mesh.elements.iter().enumerate() {
            let arms = mesh.corners(e).map(|corner| sub(corner, element.centre));
            let reached = |k: usize| {
                arms.iter()
                    .fold(margin[k], |m: f64, arm| m.max(arm[k].abs()))
            };
            margin = std::array::from_fn(reached);
            let radius = arms.into_iter().map(norm).fold(0.0, f64::max);
            // Rounding loses nothing.
            radii.push(radius * (1.0 + ROUNDING));
        }
        let reached = |k: usize| 2.0 * reach + margin[k] * (1.0 + ROUNDING);
        let margin: [f64; D] = std::array::from_fn(reached);
        let box_ = [sub(domain.lower, margin), add(domain.upper, margin)];
        for (e, element) in mesh.elements.iter().enumerate() {
            for image in domain.images_within(box_, [element.centre; 2]) {
                let sphere = Sphere {
                    centre: add(element.centre, domain.shift(image)),
                    radius: radii[e],
                };
                images.extend(NearElement::new(e, image).map(|near| (near, sphere)));
            }
        }
        Self::new(&images, reach)
    }

    /// Images of elements nearer than `radius` to a point, ascending by element, then image;
    /// `radius` at most the reach of the grid.
    pub fn near<'a>(
        &'a self,
        mesh: &'a Mesh<D>,
        point: [f64; D],
        radius: f64,
    ) -> impl Iterator<Item = NearElement<D>> + 'a {
        debug_assert!(radius <= self.reach, "query beyond the reach of the grid");
        let mut found = Vec::new();
        self.visit(point, radius, |place, distance2| {
            let near = self.entries[place];
            // The mean of the corners is in the element.
            let surely = distance2 < radius * radius * (1.0 - ROUNDING);
            if surely || {
                let (offset, _) = nearest_to_origin(&mesh.corners_from(point, near));
                dot(offset, offset) < radius * radius
            } {
                found.push(near);
            }
        });
        found.sort_unstable();
        found.into_iter()
    }
}

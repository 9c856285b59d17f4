//! On which side of the walls a point is.

use sph_core::{BoxTree, Feature, nearest_place};

use super::closest::angle;
use super::elements::{Mesh, Simplices};
use super::tree::{ElementTree, NearElement, Rays, Sides, flattened};
use crate::geometry::vector::{bounds, dot, norm, widened};

/// Crossings of the ray closer to each other than this part of the wall's extent are one place.
pub(crate) const SAME_HEIGHT: f64 = 1e-12;
/// Places whose distances differ by less than this part are equally near.
pub(crate) const SAME_DISTANCE: f64 = 1e-9;
/// Spacings within which the nearest wall decides if there are free edges.
const FRONT: f64 = 4.0;
/// Part of the spacing that rounding may move the rim of an element.
const RIM: f64 = 1e-9;
/// Walls that wind around a place by more than this enclose it, though they have openings.
const ENCLOSED: f64 = 0.5;

impl<const D: usize> Mesh<D>
where
    Self: Simplices<D>,
{
    /// True if a point is in the fluid, as the walls see it.
    ///
    /// A ray goes from the point along an axis that is not periodic (the last one if it may choose). Among the
    /// crossings at one height opposite ones cancel, as do the faces of a plate of zero thickness or
    /// of two blocks that touch; the first height where one is left decides by the side that faces the point. For a ray
    /// without a crossing the wall that reaches furthest along it decides; if all axes are periodic, it goes on
    /// along the next axis until it meets a wall. Without walls every point is in the fluid.
    ///
    /// Walls with free edges in space have a front: if there are any, the element nearest to the point decides
    /// where one is within four spacings. Farther away, and at walls with free ends, their winding number decides where it
    /// is more than ½: the walls enclose the point but for their openings. A point on a wall within rounding may be given either answer.
    ///
    /// The first call after a motion sorts the elements; then the cost is that of those that the ray may meet.
    pub fn contains(&self, point: [f64; D]) -> bool {
        let sides = self.sides();
        if let Some(tree) = &sides.front
            && let Some(front) = self.in_front(tree, self.domain.wrapped(point))
        {
            return front;
        }
        let mut from = self.domain.wrapped(point);
        if let Some(enclosed) = self.wound(sides, from).filter(|w| w.abs() > ENCLOSED) {
            return enclosed > 0.0;
        }
        for rays in &sides.rays {
            if let Some(fluid) = self.faced(rays, from) {
                return fluid;
            }
            // A line that meets nothing is all on one side.
            from[rays.along] = sides.target[rays.along];
        }
        sides.beyond
    }

    /// Winding number of walls with free ends or edges around a point, positive where they face it, in the plane Σ
    /// α/2π, α the angle in which the point sees an edge. None of walls that are closed, of lines in a periodic box, or
    /// of surfaces that repeat themselves in two directions.
    pub fn enclosed(&self, point: [f64; D]) -> Option<f64> {
        self.wound(self.sides(), point)
    }

    /// The axes that a ray may take, and the decision where there are none.
    fn sides(&self) -> &Sides<D> {
        self.sides.get_or_init(|| {
            let open = (0..D).rev().find(|k| !self.domain.periodic[*k]);
            let first = self.elements.first();
            let axes = match (open, first) {
                (Some(k), _) => vec![k],
                (None, None) => Vec::new(),
                (None, Some(element)) => {
                    let mut axes: Vec<usize> = (0..D).collect();
                    let facing = |k: &usize| element.normal[*k].abs();
                    axes.sort_by(|a, b| facing(a).total_cmp(&facing(b)));
                    axes
                }
            };
            let has_front = !self.free_edges.is_empty();
            let mut sides = Sides {
                target: first.map_or([0.0; D], |element| element.centre),
                rays: axes.iter().map(|k| self.rays(*k)).collect(),
                beyond: open.is_none_or(|k| self.is_fluid_beyond(k)),
                front: has_front.then(|| ElementTree::build(self, FRONT * self.spacing)),
                lines: Vec::new(),
                winding: None,
            };
            self.wind(&mut sides);
            sides
        })
    }

    fn rays(&self, along: usize) -> Rays<D> {
        let flat = |x: [f64; D]| flattened(x, along);
        let rim = RIM * self.spacing;
        let around = widened([self.domain.lower, self.domain.upper], rim).map(flat);
        let (mut entries, mut boxes) = (Vec::new(), Vec::new());
        for e in 0..self.elements.len() {
            let own = bounds(self.corners(e).map(flat));
            for image in self.domain.images_within(around, own) {
                let shift = self.domain.shift(image);
                let moved = own.map(|x| std::array::from_fn(|k| x[k] + shift[k]));
                if let Some(near) = NearElement::new(e, image) {
                    entries.push(near);
                    boxes.push(moved);
                }
            }
        }
        Rays {
            along,
            entries,
            tree: BoxTree::new(boxes),
        }
    }

    /// True if the first wall that a ray meets faces the point; none if it meets nothing.
    fn faced(&self, rays: &Rays<D>, point: [f64; D]) -> Option<bool> {
        let mut crossings = self.crossings(rays, point);
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (furthest, _) = crossings.last()?;
        let scale = furthest.abs() + point[rays.along].abs();
        let mut rest = crossings.as_slice();
        while let Some(&(height, _)) = rest.first() {
            let count = rest.partition_point(|(h, _)| *h <= height + SAME_HEIGHT * scale);
            let net: i32 = rest[..count].iter().map(|(_, facing)| facing).sum();
            if net != 0 {
                return Some(net > 0);
            }
            rest = &rest[count..];
        }
        None
    }

    fn crossings(&self, rays: &Rays<D>, point: [f64; D]) -> Vec<(f64, i32)> {
        let (along, mut crossings) = (rays.along, Vec::new());
        let around = widened([flattened(point, along); 2], RIM * self.spacing);
        rays.tree.each(around, |n| {
            let near = rays.entries[n];
            let corners = self.corners_from(point, near);
            let normal = self.elements[near.index()].normal;
            let Some((mut height, facing)) = Self::crossing(corners, normal, along) else {
                return;
            };
            if self.domain.periodic[along] {
                height = height.rem_euclid(self.domain.periods()[along]);
            }
            if height > 0.0 {
                crossings.push((height, facing));
            }
        });
        crossings
    }

    /// True if the nearest element has the point in front of it; none if all are far.
    ///
    /// At an edge or a node the mean normal decides, weighted with the angle of each element
    /// there: Bærentzen and Aanæs, IEEE Trans. Vis. Comput. Graph. 11 (2005) 243.
    fn in_front(&self, tree: &ElementTree<D>, point: [f64; D]) -> Option<bool> {
        let radius = FRONT * self.spacing;
        let mut nearest = f64::INFINITY;
        let mut front = 0.0;
        for near in tree.near(self, point, radius) {
            let corners = self.corners_from(point, near);
            let (offset, feature) = nearest_place([0.0; D], &corners);
            let distance = norm(offset);
            if distance > nearest * (1.0 + SAME_DISTANCE) {
                continue;
            }
            if distance < nearest * (1.0 - SAME_DISTANCE) {
                (nearest, front) = (distance, 0.0);
            }
            let weight = match feature {
                Feature::Face => std::f64::consts::TAU,
                Feature::Edge(_) => std::f64::consts::PI,
                Feature::Corner(k) => angle(&corners, k as usize),
            };
            front -= weight * dot(offset, self.elements[near.index()].normal);
        }
        nearest.is_finite().then_some(front >= 0.0)
    }
}

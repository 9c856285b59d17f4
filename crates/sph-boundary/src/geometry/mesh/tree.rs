//! Elements sorted by their places, and data that give the sides of a mesh.

use sph_core::{BoxTree, Winding};

use crate::geometry::vector::{dot, sub};

/// An element and the whole periods to add to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NearElement<const D: usize> {
    /// Index of the element.
    pub element: u32,
    /// Whole periods.
    pub image: [i8; D],
}

/// Elements near several points, each point's behind those of the one before.
#[derive(Clone, Debug, Default)]
pub struct NearRows<const D: usize> {
    /// Number of elements of every point.
    pub counts: Vec<u32>,
    /// All of them.
    pub elements: Vec<NearElement<D>>,
}

impl<const D: usize> NearElement<D> {
    /// Of an image that a byte can count; others are of a wall drawn far outside the box.
    pub(crate) fn new(element: usize, image: [i32; D]) -> Option<Self> {
        let image = image.map(i8::try_from);
        let counted = image.iter().all(Result::is_ok);
        counted.then(|| NearElement {
            element: element as u32,
            image: image.map(Result::unwrap_or_default),
        })
    }

    /// Index of the element.
    pub fn index(self) -> usize {
        self.element as usize
    }
}

/// Rounding of a squared distance, relative.
pub(super) const ROUNDING: f64 = 1e-9;

/// The search for the elements near a place.
///
/// Every image of an element that comes near the box is there once. A query costs the logarithm of their number, and
/// the number that it finds.
#[derive(Clone, Debug)]
pub struct ElementTree<const D: usize> {
    /// Largest radius of a query, m.
    pub(super) reach: f64,
    pub(super) entries: Vec<NearElement<D>>,
    /// Around every entry.
    pub(super) spheres: Vec<Sphere<D>>,
    /// Of the boxes around the spheres.
    pub(super) tree: BoxTree<D>,
}

/// The sphere about the mean of an element's corners in which it is, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sphere<const D: usize> {
    pub(super) centre: [f64; D],
    pub(super) radius: f64,
}

impl<const D: usize> Sphere<D> {
    /// Squared distance of the centre from a point, m², if the sphere is nearer than `radius`.
    #[inline(always)]
    pub(super) fn within(&self, point: [f64; D], radius: f64) -> Option<f64> {
        let offset = sub(self.centre, point);
        let (distance2, limit) = (dot(offset, offset), radius + self.radius);
        (distance2 < limit * limit).then_some(distance2)
    }
}

/// Data of a mesh for the side of a point, at the present position.
#[derive(Clone, Debug)]
pub struct Sides<const D: usize> {
    /// Along one axis; if all are periodic, along each, and the last one goes through an element.
    pub(super) rays: Vec<Rays<D>>,
    /// The centre of that element, m.
    pub(super) target: [f64; D],
    /// True if the fluid lies beyond all walls.
    pub(super) beyond: bool,
    /// The search for the nearest wall, where there are free edges.
    pub(super) front: Option<ElementTree<D>>,
    /// Of the plane, where walls end freely: first and last node of every straight edge.
    pub(crate) lines: Vec<[usize; 2]>,
    /// Of space, where walls end freely: how they wind around a place; of the other sign, since normals point into the
    /// fluid.
    pub(crate) winding: Option<Winding>,
}

/// Elements and their images over the box, seen along an axis.
#[derive(Clone, Debug)]
pub(crate) struct Rays<const D: usize> {
    pub along: usize,
    pub entries: Vec<NearElement<D>>,
    /// Of their boxes, flat across the axis.
    pub tree: BoxTree<D>,
}

/// A place without its coordinate along an axis.
pub(super) fn flattened<const D: usize>(mut x: [f64; D], along: usize) -> [f64; D] {
    x[along] = 0.0;
    x
}

//! Data that give the sides of a mesh.

use sph_core::{BoxTree, Corners, Winding};

use super::grid::Grid;
use super::near_element::NearElement;
use crate::geometry::vector::widened;

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
    pub(super) front: Option<Grid<D>>,
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
    entries: Vec<NearElement<D>>,
    /// Of their boxes, flat across the axis.
    tree: BoxTree<D>,
    rim: f64,
}

impl<const D: usize> Rays<D> {
    /// Of elements with their boxes flat across the axis, and the largest shift of their rims by rounding, m.
    pub fn new(along: usize, images: Vec<(NearElement<D>, Corners<D>)>, rim: f64) -> Self {
        let (entries, boxes): (Vec<_>, Vec<_>) = images.into_iter().unzip();
        Rays {
            along,
            entries,
            tree: BoxTree::new(boxes),
            rim,
        }
    }

    pub fn each(&self, point: [f64; D], mut found: impl FnMut(NearElement<D>)) {
        let at = flattened(point, self.along);
        let around = widened([at; 2], self.rim);
        self.tree.each(around, |n| found(self.entries[n]));
    }
}

/// A place without its coordinate along an axis.
pub(super) fn flattened<const D: usize>(mut x: [f64; D], along: usize) -> [f64; D] {
    x[along] = 0.0;
    x
}

//! Data that give the sides of a mesh.

use sph_core::{BoxTree, Winding};

use super::grid::Grid;
use super::near_element::NearElement;

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
    pub entries: Vec<NearElement<D>>,
    /// Of their boxes, flat across the axis.
    pub tree: BoxTree<D>,
}

/// A place without its coordinate along an axis.
pub(super) fn flattened<const D: usize>(mut x: [f64; D], along: usize) -> [f64; D] {
    x[along] = 0.0;
    x
}

//! Elements that rays along an axis may meet.

use sph_core::{BoxTree, Corners};

use super::near_element::NearElement;
use crate::geometry::vector::widened;

/// Elements and their images over the box, seen along an axis.
#[derive(Clone, Debug)]
pub(crate) struct Rays<const D: usize> {
    /// The axis.
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

    /// Calls `found` with the elements that a ray from the point may meet.
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

//! Elements that rays along an axis may meet.

use sph_core::BoxTree;

use super::elements::{Mesh, NearElement};
use crate::geometry::vector::{bounds, widened};

/// Part of the spacing that rounding may move the rim of an element.
const RIM: f64 = 1e-9;

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
    pub fn new(mesh: &Mesh<D>, along: usize) -> Self {
        let flat = |x: [f64; D]| flattened(x, along);
        let (domain, rim) = (mesh.domain(), RIM * mesh.spacing());
        let around = widened([domain.lower, domain.upper], rim).map(flat);
        let (mut entries, mut boxes) = (Vec::new(), Vec::new());
        for e in 0..mesh.elements().len() {
            let own = bounds(mesh.corners(e).map(flat));
            for image in domain.images_within(around, own) {
                if let Some(near) = NearElement::of(e, image) {
                    let shift = domain.shift(image);
                    entries.push(near);
                    boxes.push(own.map(|x| std::array::from_fn(|k| x[k] + shift[k])));
                }
            }
        }
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

fn flattened<const D: usize>(mut x: [f64; D], along: usize) -> [f64; D] {
    x[along] = 0.0;
    x
}

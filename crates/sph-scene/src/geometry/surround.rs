//! All that is near a wall.

use std::sync::Arc;

use sph_core::{BoxTree, bounds, nearest_place};

/// All places within a distance of a wall, on both of its sides; along a period that the wall spans it has no ends.
#[derive(Clone, Debug)]
pub struct Surround<const D: usize> {
    /// Corners of the segments or triangles of the wall, m.
    elements: Arc<Vec<[[f64; D]; D]>>,
    tree: Arc<BoxTree<D>>,
    distance: f64,
    endless: [bool; D],
}

impl<const D: usize> PartialEq for Surround<D> {
    fn eq(&self, other: &Self) -> bool {
        self.elements == other.elements && self.distance == other.distance
    }
}

impl<const D: usize> Surround<D> {
    /// Places within a distance, m, of segments or triangles, one or more; it has no ends along some axes.
    pub(crate) fn new(elements: Vec<[[f64; D]; D]>, distance: f64, endless: [bool; D]) -> Self {
        let boxes = elements.iter().map(|corners| bounds(*corners)).collect();
        Surround {
            tree: Arc::new(BoxTree::new(boxes)),
            elements: Arc::new(elements),
            distance,
            endless,
        }
    }

    /// Distance of a point from its surface, m, positive inside.
    pub(crate) fn depth(&self, x: &[f64; D]) -> f64 {
        let away = |k: usize| {
            let (place, _) = nearest_place(*x, &self.elements[k]);
            (0..D).map(|axis| (x[axis] - place[axis]).powi(2)).sum()
        };
        let nearest = self.tree.nearest(*x, f64::INFINITY, away);
        self.distance - nearest.map_or(f64::INFINITY, |(square, _)| square.sqrt())
    }

    /// Lower and upper corner of the box around it, m.
    pub(crate) fn bounds(&self) -> ([f64; D], [f64; D]) {
        let [low, high] = bounds(self.elements.iter().flatten().copied());
        let end = |k: usize, at: f64, way: f64| match self.endless[k] {
            true => way * f64::INFINITY,
            false => at + way * self.distance,
        };
        let corner = |at: [f64; D], way| std::array::from_fn(|k| end(k, at[k], way));
        (corner(low, -1.0), corner(high, 1.0))
    }

    /// Distance, m, by which it reaches beyond one around the same wall; none around another wall.
    pub(crate) fn beyond(&self, other: &Self) -> Option<f64> {
        (self.elements == other.elements).then_some(self.distance - other.distance)
    }
}

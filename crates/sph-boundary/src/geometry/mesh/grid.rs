//! Elements sorted by cells, and data that give the sides of a mesh.

use sph_core::{BoxTree, Winding};

use crate::geometry::cells::{index, listed};
use crate::geometry::vector::{bounds, dot, sub};

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

/// Most cells per registered element: a grid over a vast empty box is made coarser.
const CELLS_PER_ENTRY: usize = 8;
/// Size of a cell over the reach.
const PART_OF_REACH: f64 = 0.5;
/// Rounding of a squared distance, relative.
pub(super) const ROUNDING: f64 = 1e-9;

/// A uniform grid whose cells list the elements with their centre in them.
///
/// Every image of an element that comes near the box is listed once, in 40 bytes for a triangle. A query looks at
/// all cells within its radius; one far from all walls finds nothing and costs nothing.
#[derive(Clone, Debug)]
pub struct Grid<const D: usize> {
    /// Largest radius of a query, m.
    pub(super) reach: f64,
    /// Largest radius of a sphere, m.
    widest: f64,
    lower: [f64; D],
    per_cell: f64,
    cells: [usize; D],
    /// Start of every cell's list, and the end of the last one.
    starts: Vec<u32>,
    pub(super) entries: Vec<NearElement<D>>,
    /// Around every entry.
    pub(super) spheres: Vec<Sphere<D>>,
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

impl<const D: usize> Grid<D> {
    /// Of all images of elements; queries reach `reach` far, m.
    pub(super) fn new(images: &[(NearElement<D>, Sphere<D>)], reach: f64) -> Self {
        let [lower, upper] = bounds(images.iter().map(|(_, sphere)| sphere.centre));
        let extent: [f64; D] = std::array::from_fn(|k| (upper[k] - lower[k]).max(0.0));
        let limit = (CELLS_PER_ENTRY * images.len()).max(1) as f64;
        let mut size = (PART_OF_REACH * reach).max(f64::MIN_POSITIVE);
        while extent.iter().map(|x| (x / size).ceil()).product::<f64>() > limit {
            size *= 1.5;
        }
        let cells = extent.map(|width| (width / size) as usize + 1);
        let per_cell = 1.0 / size;
        let cell = |(_, sphere): &(_, Sphere<D>)| {
            let along = |k: usize| {
                let x = (sphere.centre[k] - lower[k]) * per_cell;
                (x as usize).min(cells[k] - 1)
            };
            index(std::array::from_fn(along), cells)
        };
        let of = |n: usize| std::iter::once(cell(&images[n]));
        let (starts, order) = listed(images.len(), cells.iter().product(), of);
        let sorted = order.iter().map(|n| images[*n as usize]);
        let (entries, spheres) = sorted.unzip();
        Self {
            reach,
            widest: images.iter().map(|(_, s)| s.radius).fold(0.0, f64::max),
            lower,
            per_cell,
            cells,
            starts,
            entries,
            spheres,
        }
    }

    /// Calls `found` with the place of every image whose sphere is in reach and its centre's squared distance, m².
    #[inline]
    pub(super) fn visit(&self, point: [f64; D], radius: f64, mut found: impl FnMut(usize, f64)) {
        let Some([first, last]) = self.cells_within(point, radius) else {
            return;
        };
        let mut row = first;
        loop {
            let end = std::array::from_fn(|k| if k == 0 { last[0] } else { row[k] });
            let from = self.starts[index(row, self.cells)] as usize;
            let to = self.starts[index(end, self.cells) + 1] as usize;
            for (place, sphere) in (from..).zip(&self.spheres[from..to]) {
                if let Some(distance2) = sphere.within(point, radius) {
                    found(place, distance2);
                }
            }
            let Some(next) = (1..D).find(|k| row[*k] < last[*k]) else {
                return;
            };
            row[next] += 1;
            row[1..next].copy_from_slice(&first[1..next]);
        }
    }

    /// First and last cell along each axis with centres of spheres that may be in reach.
    fn cells_within(&self, point: [f64; D], radius: f64) -> Option<[[usize; D]; 2]> {
        let mut range = [[0; D]; 2];
        for k in 0..D {
            let at = (point[k] - self.lower[k]) * self.per_cell;
            let around = (radius + self.widest) * self.per_cell;
            let (low, high) = (at - around, at + around);
            if self.entries.is_empty() || high < 0.0 || low >= self.cells[k] as f64 {
                return None;
            }
            range[0][k] = low.max(0.0) as usize;
            range[1][k] = (high as usize).min(self.cells[k] - 1);
        }
        Some(range)
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

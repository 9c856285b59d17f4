//! Elements sorted by the rays that may meet them.

use super::elements::{Mesh, NearElement};
use crate::geometry::cells::{index, listed, product};
use crate::geometry::vector::{bounds, sub};

/// Part of a column that rounding may take at its rims.
const RIM: f64 = 1e-6;

/// Elements that a ray along an axis may meet, by columns.
#[derive(Clone, Debug)]
pub(crate) struct Columns<const D: usize> {
    /// The axis of the ray.
    pub along: usize,
    lower: [f64; D],
    per_cell: f64,
    /// One along the ray.
    columns: [usize; D],
    starts: Vec<u32>,
    entries: Vec<NearElement<D>>,
}

impl<const D: usize> Columns<D> {
    /// Of the elements of a mesh, and of their images that lie over the box.
    pub fn new(mesh: &Mesh<D>, along: usize) -> Self {
        let flat = |mut x: [f64; D]| {
            x[along] = 0.0;
            x
        };
        let domain = mesh.domain();
        let margin = [1e-9 * mesh.spacing(); D];
        let around = [
            sub(domain.lower, margin),
            domain.upper.map(|x| x + margin[0]),
        ]
        .map(flat);
        let (mut images, mut boxes) = (Vec::new(), Vec::new());
        for e in 0..mesh.elements().len() {
            let own = bounds(mesh.corners(e).map(flat));
            for mut image in domain.images_within(around, own) {
                image[along] = 0;
                let Some(near) = NearElement::of(e, image) else {
                    continue;
                };
                images.push(near);
                let shift = domain.shift(image);
                boxes.push(own.map(|x| std::array::from_fn(|k| x[k] + shift[k])));
            }
        }
        let [lower, upper] = bounds(boxes.iter().flatten().copied());
        let extent: [f64; D] = std::array::from_fn(|k| (upper[k] - lower[k]).max(0.0));
        let count = images.len().max(1) as f64;
        let across = || (0..D).filter(|k| *k != along);
        // About two elements to a column, and none in many columns.
        let area: f64 = across().map(|k| extent[k]).product();
        let side = (2.0 * area / count).powf(1.0 / (D - 1) as f64);
        let longest = extent.iter().copied().fold(0.0, f64::max);
        let width =
            |[low, high]: &[[f64; D]; 2]| across().map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let mean = boxes.iter().map(width).sum::<f64>() / count;
        let size = side.max(longest / count).max(mean);
        let per_cell = if size > 0.0 { 1.0 / size } else { 1.0 };
        let columns = extent.map(|width| (width * per_cell) as usize + 1);
        // A little more, so that rounding loses no ray along the rim.
        let place = |k: usize, x: f64, more: f64| {
            let at = (x - lower[k]) * per_cell + more;
            (at.max(0.0) as usize).min(columns[k] - 1) as i64
        };
        let covered = |n: usize| {
            let [low, high]: [[f64; D]; 2] = boxes[n];
            let range = |k: usize| [place(k, low[k], -RIM), place(k, high[k], RIM)];
            product(std::array::from_fn(range))
                .map(move |at| index(at.map(|i| i as usize), columns))
        };
        let (starts, order) = listed(images.len(), columns.iter().product(), covered);
        Columns {
            along,
            lower,
            per_cell,
            columns,
            starts,
            entries: order.iter().map(|n| images[*n as usize]).collect(),
        }
    }

    /// Elements that a ray from the point may meet.
    pub fn column(&self, mut point: [f64; D]) -> &[NearElement<D>] {
        point[self.along] = self.lower[self.along];
        let at: [f64; D] = std::array::from_fn(|k| (point[k] - self.lower[k]) * self.per_cell);
        let column = at.map(|x| x.max(0.0) as usize);
        let within = (0..D).all(|k| at[k] >= -RIM && column[k] < self.columns[k]);
        if !within {
            return &[];
        }
        let column = index(column, self.columns);
        &self.entries[self.starts[column] as usize..self.starts[column + 1] as usize]
    }
}

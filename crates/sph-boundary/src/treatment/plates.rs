//! Walls so thin that the fluid on one side is within reach of that on the other.

use std::collections::HashSet;

use rayon::prelude::*;
use sph_core::Vect;
use sph_core::place_cells::offsets;

use crate::treatment::outline::Outline;
use crate::{Element, ThinWall, WallMesh};

/// Faces whose normals have a cosine below this are the two of a plate; a wedge of more than 8° has a tip, and no thickness.
const OPPOSITE: f64 = -0.99;
/// Places that differ by less than the spacing over this along every axis are nearly the same.
const ALIKE: f64 = 4.0;

impl<const D: usize, M: WallMesh<D>> Outline<D, M> {
    /// The thinnest place of every wall that is too thin, with fluid at `points`; wet places first.
    ///
    /// A place is too thin where another face lies so near behind it that more than a hundredth of the kernel of a particle half a
    /// spacing before it is beyond that face.
    pub fn thin_walls(&self, points: &[Vect<D>]) -> Vec<ThinWall<D>> {
        let cell = |x: &Vect<D>| -> [i64; D] {
            std::array::from_fn(|k| (x[k] / self.spacing).floor() as i64)
        };
        let all = self.mesh.elements();
        let most = self.far_sight - 0.5 * self.spacing;
        // Of elements far smaller than the spacing, one for all that look the same way from nearly the same place.
        let mut looked = HashSet::new();
        let alike = |element: &Element<D>| {
            let place = cell(&(Vect::from(element.centre) * ALIKE));
            let way: [bool; D] = std::array::from_fn(|k| element.normal[k] < 0.0);
            (element.wall, place, way)
        };
        let some: Vec<_> = all.iter().filter(|e| looked.insert(alike(e))).collect();
        let thin = |element: &&Element<D>| Some((self.thickness(element, most)?, **element));
        let mut thin: Vec<(f64, Element<D>)> = some.par_iter().filter_map(thin).collect();
        if thin.is_empty() {
            return Vec::new();
        }
        let filled: HashSet<[i64; D]> = points.iter().map(cell).collect();
        let wet = |x: Vect<D>| {
            let middle = cell(&x);
            let near = |d: [i64; D]| std::array::from_fn(|k| middle[k] + d[k]);
            offsets().any(|d| filled.contains::<[i64; D]>(&near(d)))
        };
        let off = 1.5 * self.spacing;
        let both = |t: f64, e: &Element<D>| {
            let (centre, normal) = (Vect::from(e.centre), Vect::from(e.normal));
            wet(centre + normal * off) && wet(centre - normal * (t + off))
        };
        thin.sort_by(|a, b| a.0.total_cmp(&b.0));
        let all = thin.iter().map(|(t, e)| ThinWall {
            wall: self.mesh.names()[e.wall].clone(),
            place: e.centre.into(),
            thickness: *t,
            least: most,
            spacing: t / (self.far_sight / self.spacing - 0.5),
            wet: both(*t, e),
        });
        let (mut found, dry): (Vec<_>, Vec<_>) = all.partition(|thin| thin.wet);
        found.extend(dry);
        let mut named = HashSet::new();
        found.retain(|thin| named.insert(thin.wall.clone()));
        found
    }

    /// Distance of the nearest opposite face behind an element, if it is below `most`, m.
    fn thickness(&self, element: &Element<D>, most: f64) -> Option<f64> {
        let (centre, normal) = (Vect::from(element.centre), Vect::from(element.normal));
        let way = normal * -most;
        let near = self.mesh.near(&centre, most);
        let behind = near.into_iter().filter_map(|near| {
            let other = &self.mesh.elements()[near.index()];
            let (there, back) = (Vect::from(other.centre), Vect::from(other.normal));
            let faces = back.dot(&normal) < OPPOSITE;
            (faces && self.mesh.is_crossed(near, &centre, &way)).then(|| {
                let apart = self.domain.nearest_image(centre - there);
                apart.dot(&back).abs()
            })
        });
        behind.min_by(f64::total_cmp)
    }
}

//! Triangulated surfaces.

use std::collections::HashMap;

/// A surface of triangles that share their points; right-hand normals point into the fluid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facets {
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// Numbers of the three points of every triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Facets {
    /// The same surface with the fluid on the other side.
    pub fn flipped(mut self) -> Self {
        self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        self
    }

    /// Volume that a closed surface encloses, m³, positive if its normals point outwards.
    pub fn volume(&self) -> f64 {
        let Some(&o) = self.points.first() else {
            return 0.0;
        };
        let sixfold = |t: &[u32; 3]| {
            let [a, b, c] = self.corners(t).map(|x| minus(&x, &o));
            dot(&a, &cross(&b, &c))
        };
        self.triangles.iter().map(sixfold).sum::<f64>() / 6.0
    }

    /// Area, m².
    pub fn area(&self) -> f64 {
        let twice = |t: &[u32; 3]| {
            let [a, b, c] = self.corners(t);
            let normal = cross(&minus(&b, &a), &minus(&c, &a));
            dot(&normal, &normal).sqrt()
        };
        0.5 * self.triangles.iter().map(twice).sum::<f64>()
    }

    fn corners(&self, triangle: &[u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|k| self.points[k as usize])
    }

    /// Edges that are not run along once in either direction: none of a closed surface.
    pub(crate) fn loose_edges(&self) -> usize {
        let mut balance: HashMap<(u32, u32), i32> = HashMap::new();
        for t in &self.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                match a.cmp(&b) {
                    std::cmp::Ordering::Less => *balance.entry((a, b)).or_default() += 1,
                    std::cmp::Ordering::Greater => *balance.entry((b, a)).or_default() -= 1,
                    std::cmp::Ordering::Equal => {}
                }
            }
        }
        balance.values().filter(|n| **n != 0).count()
    }
}

/// Collects triangles and merges points that are equal to the last bit.
#[derive(Default)]
pub(crate) struct Welder {
    facets: Facets,
    known: HashMap<[u64; 3], u32>,
}

impl Welder {
    pub fn point(&mut self, x: [f64; 3]) -> u32 {
        // −0 and 0 are the same place.
        let x = x.map(|c| c + 0.0);
        let points = &mut self.facets.points;
        *self.known.entry(x.map(f64::to_bits)).or_insert_with(|| {
            points.push(x);
            points.len() as u32 - 1
        })
    }

    pub fn triangle(&mut self, corners: [[f64; 3]; 3]) {
        let corners = corners.map(|x| self.point(x));
        self.facets.triangles.push(corners);
    }

    /// A plane convex face.
    pub fn fan(&mut self, corners: &[[f64; 3]]) {
        for k in 2..corners.len() {
            self.triangle([corners[0], corners[k - 1], corners[k]]);
        }
    }

    pub fn finish(self) -> Facets {
        self.facets
    }
}

pub(crate) fn minus(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(crate) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(crate) fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

//! Corners that are one place.

use std::collections::HashMap;

/// A surface of triangles that share their points; as a wall, right-hand normals point into the fluid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facets {
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// Numbers of the three points of every triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// Collects triangles and merges points that are equal to the last bit, or nearly so.
#[derive(Default)]
pub struct Welder {
    facets: Facets,
    known: HashMap<[u64; 3], u32>,
    near: f64,
    /// The first point of every cell that has one.
    cells: HashMap<[i64; 3], u32>,
}

impl Welder {
    /// One that also merges points nearer to each other than `near`, m.
    pub fn within(near: f64) -> Self {
        Welder {
            near,
            ..Self::default()
        }
    }

    /// The number of a point.
    pub fn point(&mut self, x: [f64; 3]) -> u32 {
        // −0 and 0 are the same place.
        let x = x.map(|c| c + 0.0);
        let key = x.map(f64::to_bits);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let number = self.near_duplicate(&x).unwrap_or_else(|| {
            self.facets.points.push(x);
            let number = self.facets.points.len() as u32 - 1;
            if self.near > 0.0 {
                self.cells.entry(self.cell(&x)).or_insert(number);
            }
            number
        });
        self.known.insert(key, number);
        number
    }

    fn cell(&self, x: &[f64; 3]) -> [i64; 3] {
        x.map(|c| (c / (4.0 * self.near)).floor() as i64)
    }

    /// A point that is nearly at this place.
    fn near_duplicate(&self, x: &[f64; 3]) -> Option<u32> {
        if self.near <= 0.0 {
            return None;
        }
        let [low, high] = [-self.near, self.near].map(|d| self.cell(&x.map(|c| c + d)));
        let mut corners =
            (0..8).map(|n| std::array::from_fn(|k| if n >> k & 1 == 0 { low[k] } else { high[k] }));
        corners.find_map(|cell| {
            let number = *self.cells.get::<[i64; 3]>(&cell)?;
            let there = &self.facets.points[number as usize];
            let near = (0..3).all(|k| (there[k] - x[k]).abs() <= self.near);
            near.then_some(number)
        })
    }

    /// Takes a triangle.
    pub fn triangle(&mut self, corners: [[f64; 3]; 3]) {
        let corners = corners.map(|x| self.point(x));
        self.facets.triangles.push(corners);
    }

    /// Takes a plane convex face.
    pub fn fan(&mut self, corners: &[[f64; 3]]) {
        for k in 2..corners.len() {
            self.triangle([corners[0], corners[k - 1], corners[k]]);
        }
    }

    /// The surface.
    pub fn finish(self) -> Facets {
        self.facets
    }
}

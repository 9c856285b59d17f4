//! Triangulated surfaces, their corners that are one place welded.

use std::collections::HashMap;
use std::path::Path;

use crate::surface::stl::{StlFile, parse, read};
use crate::surface::vector::{cross, dot, minus};

/// Corners of a file nearer to each other than this share of its extent are one: single precision has 6·10⁻⁸.
const SAME_CORNER: f64 = 1e-6;

/// A surface of triangles that share their points; as a wall, right-hand normals point into the fluid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facets {
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// Numbers of the three points of every triangle.
    pub triangles: Vec<[u32; 3]>,
}

impl Facets {
    /// The surface in an STL file with its corners welded, in the unit of the file, and the number, from 1, of the
    /// first facet whose normal is not that of its corners' order.
    ///
    /// # Errors
    /// A file that cannot be read, with the name of the file and the number of the facet.
    pub fn read(path: &Path) -> Result<(Self, Option<usize>), String> {
        Self::welded(read(path)?, &path.display().to_string())
    }

    /// The same surface from the bytes of a file; `name` is its name in errors.
    ///
    /// # Errors
    /// If it is damaged, declares more than it holds, or holds no triangles.
    pub fn from_stl(bytes: Vec<u8>, name: &str) -> Result<Self, String> {
        Ok(Self::welded(parse(bytes, name)?, name)?.0)
    }

    /// Facets of which corners are one after welding are lines, and left out.
    fn welded(file: StlFile, name: &str) -> Result<(Self, Option<usize>), String> {
        let [low, high] = bounds(file.triangles.iter().flatten());
        let extent = minus(&high, &low).into_iter().fold(0.0, f64::max);
        let mut welder = Welder::within(SAME_CORNER * extent);
        for corners in file.triangles {
            welder.triangle(corners);
        }
        let mut facets = welder.finish();
        let lines = |[a, b, c]: &[u32; 3]| a == b || b == c || c == a;
        facets.triangles.retain(|t| !lines(t));
        match facets.triangles.is_empty() {
            true => Err(format!("`{name}` holds no facets with an area")),
            false => Ok((facets, file.odd)),
        }
    }

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
        self.areas().sum()
    }

    /// Area of every triangle, m².
    pub(crate) fn areas(&self) -> impl Iterator<Item = f64> {
        self.triangles.iter().map(|t| {
            let [a, b, c] = self.corners(t);
            let normal = cross(&minus(&b, &a), &minus(&c, &a));
            0.5 * dot(&normal, &normal).sqrt()
        })
    }

    /// Lower and upper corner of the box around the points.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        bounds(&self.points)
    }

    /// Places of the corners of a triangle.
    pub fn corners(&self, triangle: &[u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|k| self.points[k as usize])
    }
}

pub(crate) fn bounds<'a>(points: impl IntoIterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    let mut found = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for x in points {
        found[0] = std::array::from_fn(|k| found[0][k].min(x[k]));
        found[1] = std::array::from_fn(|k| found[1][k].max(x[k]));
    }
    found
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

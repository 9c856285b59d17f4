//! Closed walls of planar faces around the fluid.

use sph_boundary::{GammaSum, Renormalisation3d};

use crate::vector::{Vector, cross, dot, edges, minus, plus, unit};

/// Faces as corners counter-clockwise about the inward normal, and that normal.
pub struct Solid(pub Vec<(Vec<Vector>, Vector)>);

impl Solid {
    pub fn new(faces: Vec<Vec<Vector>>) -> Self {
        let with_normal = |face: Vec<Vector>| {
            let area = |sum, [a, b]: [Vector; 2]| plus(sum, 1.0, cross(a, b));
            let normal = unit(edges(&face, face[0]).fold([0.0; 3], area));
            (face, normal)
        };
        Self(faces.into_iter().map(with_normal).collect())
    }

    /// The prism over an outline, counter-clockwise, between two heights.
    pub fn prism(outline: &[[f64; 2]], [bottom, top]: [f64; 2]) -> Vec<Vec<Vector>> {
        let at = |i: usize, z| [outline[i][0], outline[i][1], z];
        let n = outline.len();
        let floor = (0..n).map(|i| at(i, bottom)).collect();
        let lid = (0..n).rev().map(|i| at(i, top)).collect();
        let side = |i: usize| {
            let j = (i + 1) % n;
            vec![at(j, bottom), at(i, bottom), at(i, top), at(j, top)]
        };
        let mut faces: Vec<_> = (0..n).map(side).collect();
        faces.extend([floor, lid]);
        faces
    }

    pub fn box_of([x, y, z]: [[f64; 2]; 3]) -> Vec<Vec<Vector>> {
        let outline = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
        Self::prism(&outline, z)
    }

    /// An L of arms `size`, re-entrant along the z axis: without the quadrant x, y > 0.
    pub fn l_block(size: f64) -> Vec<Vec<Vector>> {
        let s = size;
        let outline = [[-s, -s], [s, -s], [s, 0.0], [0.0, 0.0], [0.0, s], [-s, s]];
        Self::prism(&outline, [-s, s])
    }

    /// A cube with a pyramid cut into its lid, the apex at the origin.
    pub fn notched(half: f64) -> Vec<Vec<Vector>> {
        let mut faces = Self::box_of([[-half, half]; 3]);
        let lid = faces.pop().expect("a lid");
        faces.extend((0..4).map(|i| vec![lid[i], lid[(i + 1) % 4], [0.0; 3]]));
        faces
    }

    pub fn mapped(faces: Vec<Vec<Vector>>, mut to: impl FnMut(Vector) -> Vector) -> Self {
        let face = |face: Vec<Vector>| face.into_iter().map(&mut to).collect();
        Self::new(faces.into_iter().map(face).collect())
    }

    /// With every face as one polygon.
    pub fn at(&self, of: &Renormalisation3d, point: Vector) -> GammaSum<3> {
        let mut sum = GammaSum::<3>::default();
        for (face, n) in &self.0 {
            let height = dot(minus(point, face[0]), *n);
            sum.add(&of.polygon(height, *n, edges(face, point)), *n);
        }
        sum
    }

    /// With every face, all being convex, as a fan of triangles.
    pub fn at_by_triangles(&self, of: &Renormalisation3d, point: Vector) -> GammaSum<3> {
        let mut sum = GammaSum::<3>::default();
        for (face, n) in &self.0 {
            for i in 1..face.len() - 1 {
                let t = [face[0], face[i], face[i + 1]].map(|c| minus(c, point));
                sum.add(&of.triangle(t, *n), *n);
            }
        }
        sum
    }
}

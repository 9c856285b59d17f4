//! The planar faces of walls in space.

use sph_core::Vect;

use crate::geometry::plane::Plane;
use crate::integrals::spatial::{Circle, Patch};
use crate::{FaceEdge, Mesh};

/// The faces as planes, and the triangles in them.
#[derive(Debug, Default)]
pub(crate) struct Planes {
    pub planes: Vec<Plane>,
    /// By face: one more than its last triangle.
    pub ends: Vec<u32>,
    /// By face: its edges, with the corners at hand.
    pub edges: Vec<Vec<[Corner; 2]>>,
    /// By triangle: its face.
    pub faces: Vec<u32>,
    /// By triangle.
    pub patches: Vec<Patch>,
    /// By triangle.
    pub circles: Vec<Circle>,
}

/// A corner of a face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    /// Of its node, m.
    pub position: Vect<3>,
    /// Whole periods to add.
    pub image: [i32; 3],
}

impl Corner {
    pub fn new(mesh: &Mesh<3>, node: usize, image: [i32; 3]) -> Self {
        let position = mesh.nodes[node].position.into();
        Corner { position, image }
    }
}

impl Planes {
    /// For the present position of the walls.
    pub fn new(mesh: &Mesh<3>) -> Self {
        let mut all = Self::default();
        for face in &mesh.faces {
            let corner = |e: &FaceEdge, k: usize| Corner::new(mesh, e.nodes[k], e.images[k]);
            let edges = face.edges.iter().map(|e| [corner(e, 0), corner(e, 1)]);
            all.edges.push(edges.collect());
        }
        // Triangles are stored face by face.
        for (t, triangle) in mesh.elements.iter().enumerate() {
            let corners = mesh.corners(t);
            if all.planes.len() <= triangle.face {
                let plane = Plane::new(corners[0], triangle.normal);
                all.planes.resize(triangle.face + 1, plane);
                all.ends.resize(triangle.face + 1, t as u32);
            }
            all.ends[triangle.face] = t as u32 + 1;
            let plane = &all.planes[triangle.face];
            let (patch, circle) = Patch::new(plane, corners, triangle.measure);
            all.patches.push(patch);
            all.circles.push(circle);
            all.faces.push(triangle.face as u32);
        }
        all
    }
}

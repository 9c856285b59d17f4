//! The planar faces of walls in space.

use sph_core::Vect;

use crate::geometry::plane::Plane;
use crate::geometry::walls::face_map::{FaceMap, plane_of};
use crate::integrals::spatial::{Circle, Patch};
use crate::{FaceEdge, Mesh};

/// The faces as planes, and the triangles in them.
#[derive(Debug, Default)]
pub(crate) struct Planes {
    /// By face: its plane, with coordinates that move with the first triangle.
    pub planes: Vec<Plane>,
    /// By face: one more than its last triangle.
    pub ends: Vec<u32>,
    /// By face: its edges, with the corners at hand.
    pub edges: Vec<Vec<[Corner; 2]>>,
    /// By triangle: its face.
    pub faces: Vec<u32>,
    /// By face: the search for the triangle at a place, where all that a particle sees of the face is one contact; none
    /// where each triangle is one.
    pub maps: Vec<Option<FaceMap>>,
    /// By triangle; none where every face is one contact.
    pub patches: Vec<Patch>,
    /// The same.
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
    /// Of walls where they are drawn; each triangle is a contact on walls that are `cut`: fluid passes them, or their
    /// shape changes.
    pub fn new(mesh: &Mesh<3>, cut: impl Fn(usize) -> bool) -> Self {
        let mut all = Self::default();
        // Triangles are stored face by face.
        for (t, triangle) in mesh.elements.iter().enumerate() {
            all.ends.resize(triangle.face + 1, t as u32);
            all.ends[triangle.face] = t as u32 + 1;
            all.faces.push(triangle.face as u32);
        }
        let mut first = 0;
        for &end in &all.ends {
            let end = end as usize;
            let whole = first < end && !cut(mesh.elements[first].wall);
            all.maps.push(whole.then(|| FaceMap::new(mesh, first, end)));
            first = end;
        }
        all.follow(mesh);
        all
    }

    /// Follows walls that have moved.
    pub fn follow(&mut self, mesh: &Mesh<3>) {
        self.edges.clear();
        for face in &mesh.faces {
            let corner = |e: &FaceEdge, k: usize| Corner::new(mesh, e.nodes[k], e.images[k]);
            let edges = face.edges.iter().map(|e| [corner(e, 0), corner(e, 1)]);
            self.edges.push(edges.collect());
        }
        let firsts = std::iter::once(0).chain(self.ends.iter().copied());
        let firsts = firsts.take(self.ends.len());
        self.planes.clear();
        for (first, map) in firsts.zip(&self.maps) {
            let first = first as usize;
            self.planes.push(match map {
                Some(_) => plane_of(mesh, first),
                None => Plane::new(mesh.corners(first)[0], mesh.elements[first].normal),
            });
        }
        self.patches.clear();
        self.circles.clear();
        if self.maps.iter().all(Option::is_some) {
            return;
        }
        for (t, triangle) in mesh.elements.iter().enumerate() {
            let plane = &self.planes[triangle.face];
            let (patch, circle) = Patch::new(plane, mesh.corners(t), triangle.measure);
            self.patches.push(patch);
            self.circles.push(circle);
        }
    }
}

//! Nodes, triangles and faces of walls in space, and what may be asked of them.

use std::sync::OnceLock;

use super::grid::NearTriangle;
use super::sides::Sides;
use super::vector::{add, sub};
use crate::error::WallWarning;
use crate::geometry::periodic::PeriodicBox;
use crate::rigid::pose::Pose;

/// A node of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Present position, m.
    pub position: [f64; 3],
    /// θ, the solid angle of the fluid at the node over 4π: 1/2 on a flat wall, 1/4 on a
    /// right-angled edge seen from the fluid, 1/8 in the corner of a box, 3/4 and 7/8 on the edges
    /// and corners of a block. At a free edge as if the wall went straight on.
    pub theta: f64,
    /// Wall area that the node answers for, a third of each triangle around it (a quarter of each rectangle), over the
    /// spacing squared.
    pub size: f64,
    /// Index of the wall; at a joint, one of those that meet.
    pub wall: usize,
}

/// An element of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners, counter-clockwise seen from the tip of the normal.
    pub nodes: [usize; 3],
    /// Whole periods to add to the position of each.
    pub images: [[i32; 3]; 3],
    /// Index of the wall.
    pub wall: usize,
    /// Index of the planar face that it is part of.
    pub face: usize,
    /// Area, m².
    pub area: f64,
    /// Mean of the corners, m.
    pub centre: [f64; 3],
    /// Unit normal, into the fluid.
    pub normal: [f64; 3],
}

/// A straight edge of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaceEdge {
    /// First and second corner.
    pub nodes: [usize; 2],
    /// Whole periods to add to the position of each.
    pub images: [[i32; 3]; 2],
}

/// A planar piece of a wall, as large as the wall is planar, perhaps with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Index of the wall.
    pub wall: usize,
    /// Unit normal, into the fluid.
    pub normal: [f64; 3],
    /// Edges as drawn, not cut at the spacing; the face is on their left seen from the tip of the
    /// normal.
    pub edges: Vec<FaceEdge>,
}

/// An edge of a triangle that no other triangle continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FreeEdge {
    /// First and second node, as its triangle travels it.
    pub nodes: [usize; 2],
    /// Whole periods to add to the position of each.
    pub images: [[i32; 3]; 2],
    /// Index of the wall.
    pub wall: usize,
    /// Index of the triangle.
    pub triangle: usize,
    /// Index of the opening.
    pub opening: usize,
    /// Index of another wall that has a face at the edge, which does not continue this one.
    pub met: Option<usize>,
}

/// Free edges that hang together: a hole in a wall, or the rim of an open one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Index of the wall, or of one of several.
    pub wall: usize,
    /// Number of straight edges around it, before they are cut at the spacing.
    pub edges: usize,
    /// Diagonal of the box around it, m.
    pub extent: f64,
    /// Middle of that box, m.
    pub centre: [f64; 3],
}

/// All walls of a scene in space, cut into triangles of about the particle spacing.
///
/// Triangles of a wall that lie in one plane become one face. The edges of the faces are cut into
/// equal parts, alike for all faces that share them, also between walls of one group and across
/// periodic sides, where nodes are merged. Inside a face are points of a square lattice along its
/// longest edge; a rectangle of whole spacings gets exactly the lattice of the spacing. Where walls
/// of one group touch face to face, what they have in common is left out of both, so that the mesh
/// is the boundary of the fluid. Facets smaller than the spacing stay as they are drawn.
#[derive(Clone, Debug)]
pub struct TriangleMesh {
    pub(super) walls: Vec<String>,
    pub(super) groups: Vec<usize>,
    pub(super) spacing: f64,
    pub(super) domain: PeriodicBox<3>,
    pub(super) nodes: Vec<Node>,
    pub(super) triangles: Vec<Triangle>,
    pub(super) faces: Vec<Face>,
    pub(super) free_edges: Vec<FreeEdge>,
    pub(super) openings: Vec<Opening>,
    pub(super) warnings: Vec<WallWarning>,
    /// Positions of the nodes before any motion, m.
    pub(super) reference: Vec<[f64; 3]>,
    /// Normals of the faces before any motion.
    pub(super) reference_normals: Vec<[f64; 3]>,
    pub(super) poses: Vec<Pose<3>>,
    /// Made when first asked for, and again after a motion.
    pub(super) sides: OnceLock<Sides>,
}

impl TriangleMesh {
    /// Names of the walls, in the order given.
    pub fn walls(&self) -> &[String] {
        &self.walls
    }

    /// Group of every wall.
    pub fn groups(&self) -> &[usize] {
        &self.groups
    }

    /// Length at which the walls are cut, m.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// All nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// All triangles, face by face.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// All planar faces, wall by wall.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// Edges that no other triangle continues.
    pub fn free_edges(&self) -> &[FreeEdge] {
        &self.free_edges
    }

    /// What the free edges surround.
    pub fn openings(&self) -> &[Opening] {
        &self.openings
    }

    /// Remarks on the walls.
    pub fn warnings(&self) -> &[WallWarning] {
        &self.warnings
    }

    /// The box and its periodic directions.
    pub fn domain(&self) -> &PeriodicBox<3> {
        &self.domain
    }

    /// Corners of a triangle, m.
    pub fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        let Triangle { nodes, images, .. } = &self.triangles[triangle];
        [0, 1, 2].map(|k| self.node_at(nodes[k], images[k]))
    }

    pub(super) fn node_at(&self, node: usize, image: [i32; 3]) -> [f64; 3] {
        self.node_from([0.0; 3], node, image)
    }

    /// Corners of an image of a triangle relative to a point, m.
    ///
    /// Made from the node's own position and the whole number of periods to it, so that all
    /// triangles and faces at a node see bitwise the same vector.
    #[inline]
    pub fn corners_from(&self, point: [f64; 3], near: NearTriangle) -> [[f64; 3]; 3] {
        let Triangle { nodes, images, .. } = &self.triangles[near.triangle as usize];
        [0, 1, 2].map(|k| self.node_from(point, nodes[k], total(images[k], near.image)))
    }

    /// Edges of an image of a face relative to a point, m; bitwise the same vectors as
    /// [`TriangleMesh::corners_from`] gives.
    pub fn face_edges_from(
        &self,
        point: [f64; 3],
        face: usize,
        image: [i8; 3],
    ) -> impl Iterator<Item = [[f64; 3]; 2]> {
        self.faces[face].edges.iter().map(move |edge| {
            [0, 1].map(|k| self.node_from(point, edge.nodes[k], total(edge.images[k], image)))
        })
    }

    #[inline]
    fn node_from(&self, point: [f64; 3], node: usize, image: [i32; 3]) -> [f64; 3] {
        let from = sub(self.nodes[node].position, point);
        match image {
            [0, 0, 0] => from,
            _ => add(from, self.domain.shift(image)),
        }
    }
}

fn total(own: [i32; 3], image: [i8; 3]) -> [i32; 3] {
    [0, 1, 2].map(|k| own[k] + i32::from(image[k]))
}

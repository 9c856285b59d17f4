//! Nodes, elements and faces of walls, and their queries.

use std::sync::OnceLock;

use sph_core::bed::Bed;

use super::tree::{NearElement, Sides};
use crate::geometry::vector::{Point, add, sub};
use crate::{FreeEnd, PeriodicBox, Pose, RigidMotion};

/// A node of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node<const D: usize> {
    /// Present position, m.
    pub position: [f64; D],
    /// θ, the angle of the fluid at the node over 2π: 1/2 on a straight wall, 1/4 in a right angle seen from the fluid,
    /// 3/4 at a re-entrant one, 1 at the end of a plate of zero thickness. In space the solid angle over 4π: 1/2 on a flat
    /// wall, 1/4 on a right-angled edge, 1/8 in the corner of a box, 3/4 and 7/8 on the edges and corners of a block. At
    /// free ends and edges as if the wall went straight on.
    pub theta: f64,
    /// Wall that the node answers for, over δr^(D−1): half of each segment around it, at a free end as if the wall went
    /// on; in space a third of each triangle (a quarter of each rectangle).
    pub size: f64,
    /// Index of the wall; at a joint, one of those that meet.
    pub wall: usize,
}

impl<const D: usize> Node<D> {
    /// With half the fluid around it and no size yet.
    pub(crate) fn new(position: [f64; D], wall: usize) -> Self {
        Node {
            position,
            theta: 0.5,
            size: 0.0,
            wall,
        }
    }
}

/// An element of the wall: a segment or a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element<const D: usize> {
    /// Corners, in the direction of travel; counter-clockwise seen from the tip of the normal.
    pub nodes: [usize; D],
    /// Whole periods to add to the position of each.
    pub images: [[i32; D]; D],
    /// Index of the wall.
    pub wall: usize,
    /// Index of the straight edge or planar face that it is part of, among those of all walls.
    pub face: usize,
    /// Length or area, m^(D−1).
    pub measure: f64,
    /// Mean of the corners, m.
    pub centre: [f64; D],
    /// Unit normal into the fluid; in the plane (−t_y, t_x), t the direction of travel.
    pub normal: [f64; D],
}

impl Element<2> {
    /// Unit vector along the direction of travel.
    pub fn tangent(&self) -> [f64; 2] {
        [self.normal[1], -self.normal[0]]
    }
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
    /// Edges as drawn, not cut at the spacing; the face is on their left seen from the tip of the normal.
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
    /// Number of straight edges around it, before they are cut at the spacing.
    pub edges: usize,
    /// Diagonal of the box around it, m.
    pub extent: f64,
    /// Middle of that box, m.
    pub centre: [f64; 3],
}

/// All walls of a scene, cut into segments or triangles of about the particle spacing.
///
/// From polylines every edge is cut into equal segments, numbered along the walls in the order given. Ends of open
/// polylines that coincide, also across a periodic side, are joined into one node; others are never merged. A plate of
/// zero thickness therefore has two coincident nodes along it, one per side, each with the fluid angle of its own side.
/// Walls may touch (a block on a floor, a corner on an edge) but not cross.
///
/// From surfaces triangles of a wall that lie in one plane become one face. The edges of the faces are cut into equal
/// parts, alike for all faces that share them, also between walls of one group and across periodic sides, where nodes
/// are merged. Inside a face are points of a square lattice along its longest edge; a rectangle of whole spacings gets
/// exactly the lattice of the spacing. Where walls of one group touch face to face, the common part is left out of
/// both, so that the mesh is the boundary of the fluid. Facets smaller than the spacing stay as they are drawn.
#[derive(Clone, Debug, Default)]
pub struct Mesh<const D: usize> {
    /// Names of the walls, in the order given.
    pub walls: Vec<String>,
    pub(crate) groups: Vec<usize>,
    /// Length at which the walls are cut, m.
    pub spacing: f64,
    /// The box and its periodic directions.
    pub domain: PeriodicBox<D>,
    /// All nodes.
    pub nodes: Vec<Node<D>>,
    /// All elements, face by face.
    pub elements: Vec<Element<D>>,
    /// Of the plane, by node: the segments that end and begin there.
    pub beside: Vec<[Option<usize>; 2]>,
    /// Of the plane: ends that nothing continues.
    pub free_ends: Vec<FreeEnd>,
    /// Of space: all planar faces, wall by wall.
    pub faces: Vec<Face>,
    /// Of space: edges that no other triangle continues.
    pub free_edges: Vec<FreeEdge>,
    /// Of space: the openings that free edges surround.
    pub openings: Vec<Opening>,
    /// Remarks on the walls.
    pub warnings: Vec<String>,
    /// Positions of the nodes before any motion, m.
    pub(crate) reference: Vec<[f64; D]>,
    /// Normals of the faces before any motion.
    pub(crate) reference_normals: Vec<Point>,
    /// Present poses, one per wall.
    pub poses: Vec<Pose<D>>,
    /// Motion of each wall; only changes of its shape matter.
    pub(crate) motions: Vec<RigidMotion<D>>,
    /// The beds that walls follow, as they are.
    pub(crate) beds: Vec<Bed>,
    /// Made at the first request, and again after a motion.
    pub(crate) sides: OnceLock<Sides<D>>,
}

impl<const D: usize> Mesh<D> {
    pub(crate) fn empty(
        walls: Vec<String>,
        groups: &[usize],
        spacing: f64,
        domain: &PeriodicBox<D>,
    ) -> Self {
        Mesh {
            poses: vec![Pose::default(); walls.len()],
            motions: vec![RigidMotion::default(); walls.len()],
            walls,
            groups: groups.to_vec(),
            spacing,
            domain: *domain,
            ..Mesh::default()
        }
    }

    /// Corners of an element, m.
    pub fn corners(&self, element: usize) -> [[f64; D]; D] {
        let Element { nodes, images, .. } = &self.elements[element];
        std::array::from_fn(|k| self.node_from([0.0; D], nodes[k], images[k]))
    }

    /// Corners of an image of an element relative to a point, m.
    ///
    /// Made from the node's own position and the whole number of periods to it, so that all elements and faces at a
    /// node see bitwise the same vector, as [`Renormalisation2d::segment`](crate::Renormalisation2d::segment) asks.
    #[inline]
    pub fn corners_from(&self, point: [f64; D], near: NearElement<D>) -> [[f64; D]; D] {
        let Element { nodes, images, .. } = &self.elements[near.index()];
        std::array::from_fn(|k| self.node_from(point, nodes[k], total(images[k], near.image)))
    }

    #[inline]
    pub(crate) fn node_from(&self, point: [f64; D], node: usize, image: [i32; D]) -> [f64; D] {
        let from = sub(self.nodes[node].position, point);
        if image == [0; D] {
            return from;
        }
        add(from, self.domain.shift(image))
    }
}

/// The parts of a mesh that differ between segments and triangles.
pub trait Simplices<const D: usize> {
    /// Finds length or area, centre and normal of an element.
    fn measure(&mut self, element: usize);
    /// Changes of nodes and faces by walls that moved.
    fn follow(&mut self, moved: &[bool]);
    /// Height over the origin at which the ray along an axis meets an element, with +1 where the fluid is on the near side
    /// of it and −1 where it is on the far side.
    fn crossing(corners: [[f64; D]; D], normal: [f64; D], along: usize) -> Option<(f64, i32)>;
    /// True if the fluid lies beyond all walls along the positive direction of an axis.
    fn is_fluid_beyond(&self, along: usize) -> bool;
    /// Prepares the winding number of walls that end freely.
    fn wind(&self, sides: &mut Sides<D>);
    /// Winding number of walls that end freely, around a place.
    fn wound(&self, sides: &Sides<D>, point: [f64; D]) -> Option<f64>;
}

impl Mesh<3> {
    /// Edges of an image of a face relative to a point, m; bitwise the same vectors as [`Mesh::corners_from`] gives.
    pub fn face_edges_from(
        &self,
        point: Point,
        face: usize,
        image: [i8; 3],
    ) -> impl Iterator<Item = [Point; 2]> {
        self.faces[face].edges.iter().map(move |edge| {
            [0, 1].map(|k| self.node_from(point, edge.nodes[k], total(edge.images[k], image)))
        })
    }
}

#[inline]
fn total<const D: usize>(own: [i32; D], image: [i8; D]) -> [i32; D] {
    std::array::from_fn(|k| own[k] + i32::from(image[k]))
}

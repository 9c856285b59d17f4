//! The walls of a scene for their treatments: meshed, with the search for their elements.

pub(crate) mod beds;
pub(crate) mod cover;
mod face_sums;
mod faces;
mod planar;
mod spatial;

use std::borrow::BorrowMut;
use std::sync::OnceLock;

use sph_core::Vect;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::geometry::vector::dot;
use crate::geometry::walls::faces::Planes;
use crate::{
    Element, ElementTree, Gammas, Mesh, NearElement, NearRows, Node, PeriodicBox, Pose, Result,
    SeenElement, Shells, WallSpec,
};

/// Walls cut at the particle spacing, with the tree that finds their elements.
#[derive(Debug)]
pub struct Walls<const D: usize> {
    pub(crate) mesh: Mesh<D>,
    /// Of the present position, made at the first request.
    tree: OnceLock<ElementTree<D>>,
    pub(crate) planes: Planes,
    pub(crate) shells: Shells,
    pub(crate) reach: f64,
}

/// Walls of the plane.
pub type PlanarWalls = Walls<2>;

/// Walls in space.
pub type SpatialWalls = Walls<3>;

impl<const D: usize> Walls<D> {
    /// Of a mesh; queries look up to `reach` metres far.
    pub(crate) fn new(mesh: Mesh<D>, walls: &[WallSpec<D>], reach: f64) -> Self {
        let elements = mesh.elements.iter();
        let elements = elements.map(|e| (e.nodes, walls[e.wall].open));
        let ends = mesh.free_ends.iter().map(|end| end.node);
        let free = ends.chain(mesh.free_edges.iter().flat_map(|edge| edge.nodes));
        Walls {
            shells: Shells::new(elements, mesh.nodes.len(), free),
            tree: OnceLock::new(),
            planes: Planes::default(),
            mesh,
            reach,
        }
    }

    pub(crate) fn tree(&self) -> &ElementTree<D> {
        self.tree
            .get_or_init(|| ElementTree::build(&self.mesh, self.reach))
    }
}

/// A direction in which a wall keeps a particle off.
#[derive(Clone, Copy, Debug)]
pub struct Hindrance<const D: usize> {
    /// Unit vector from the wall to the particle.
    pub away: Vect<D>,
    /// Distance along it, m.
    pub distance: f64,
    /// Direction and distance that must be hindered as well before this one counts.
    pub only_if: Option<(Vect<D>, f64)>,
    /// Index of the wall.
    pub wall: usize,
    /// The nearest place of the wall, as near as it is seen, m.
    pub place: Vect<D>,
    /// Whole periods from the wall to its visible image, m.
    pub image: Vect<D>,
}

/// A particle, and the shells that it is behind, each with its place in the near lists.
pub type View<'a, const D: usize> = (&'a Vect<D>, &'a [(u32, u32)]);

/// The walls of a scene as a mesh of elements of about the particle spacing: the common queries of the two dimensions,
/// and those with a method of each.
pub trait WallMesh<const D: usize>:
    BorrowMut<Walls<D>> + Sized + Send + Sync + std::fmt::Debug + 'static
{
    /// The wall integrals of a kernel.
    type Integrals: Send + Sync + std::fmt::Debug;
    /// Buffers of a task that finds γ.
    type Scratch: Default + Send + Sync + std::fmt::Debug;

    /// Meshes the walls by elements of a size, m; queries look up to `reach` metres far.
    ///
    /// # Errors
    /// If a wall is refused; the message names it.
    fn build(walls: &[WallSpec<D>], size: f64, reach: f64, domain: &PeriodicBox<D>)
    -> Result<Self>;

    /// Integrals of a kernel shape with a smoothing length, m.
    ///
    /// # Errors
    /// If the kernel cannot be integrated.
    fn integrals(shape: &PiecewisePolynomial, smoothing_length: f64) -> Result<Self::Integrals>;

    /// The mesh and the search for its elements.
    fn walls(&self) -> &Walls<D> {
        self.borrow()
    }

    /// The same, to change.
    fn walls_mut(&mut self) -> &mut Walls<D> {
        self.borrow_mut()
    }

    /// Moves every wall to its pose.
    ///
    /// # Errors
    /// If a wall cannot follow.
    fn move_walls(&mut self, poses: &[Pose<D>]) -> Result<()>;

    /// Appends for every point the elements within a radius, or a few more, ascending.
    fn near_all(&self, points: &[Vect<D>], radius: f64, rows: &mut NearRows<D>);

    /// Leaves of the rows of [`near_all`](Self::near_all) as much as γ, contacts and hindrances need: all, if it says nothing
    /// else.
    fn merge(&self, _rows: &mut NearRows<D>) {}

    /// γ at points, each with the elements that may be within its support; see [`Shells`] for those that end freely.
    /// Those that are within it become contacts, but for those hidden behind such a shell; further ones change nothing.
    fn gammas<'a>(
        &self,
        integrals: &Self::Integrals,
        points: impl Iterator<Item = (&'a Vect<D>, &'a [NearElement<D>])>,
        room: &mut Self::Scratch,
        contacts: &mut ContactBlock<D>,
        found: &mut Gammas,
    );

    /// True if the way `by` from a point leads through an element.
    fn is_crossed(&self, near: NearElement<D>, point: &Vect<D>, by: &Vect<D>) -> bool;

    /// Least height of a point over the planes of those elements near it that face it, m; infinite without such an element. No
    /// element is nearer.
    fn clearance(&self, point: &Vect<D>, near: &[NearElement<D>]) -> f64;

    /// Planes at which the walls keep off a particle, among the places nearer than `reach` metres.
    fn hindrances(&self, of: View<'_, D>, row: &[NearElement<D>], reach: f64) -> Vec<Hindrance<D>>;

    /// True if a point is on the fluid's side of all walls.
    fn contains(&self, point: &Vect<D>) -> bool;

    /// Winding number of walls with free ends around a point, positive where they face it; none of closed walls.
    fn enclosed(&self, point: &Vect<D>) -> Option<f64>;

    /// Refuses points within a radius of the free end of an open wall.
    ///
    /// # Errors
    /// Names the wall and the place.
    fn check_free_ends(&self, points: &[Vect<D>], radius: f64) -> Result<()>;

    /// Places of dummy particles behind the walls with the index of their wall, m.
    fn layers(&self, spacing: f64, support: f64) -> Vec<(usize, Vect<D>)>;

    /// Names of the walls.
    fn names(&self) -> &[String] {
        &self.walls().mesh.walls
    }

    /// All nodes at the present position of the walls.
    fn nodes(&self) -> &[Node<D>] {
        &self.walls().mesh.nodes
    }

    /// Places of the nodes, m.
    fn places(&self) -> Vec<Vect<D>> {
        self.nodes().iter().map(|n| n.position.into()).collect()
    }

    /// Unit normals of the nodes into the fluid, the means of those around.
    fn normals(&self) -> impl Iterator<Item = Vect<D>> + '_ {
        let mesh = &self.walls().mesh;
        let mut normals = vec![Vect::<D>::zeros(); mesh.nodes.len()];
        for element in &mesh.elements {
            // At a corner of the plane both segments count alike.
            let weight = if D == 2 { 1.0 } else { element.measure };
            for node in element.nodes {
                normals[node] += Vect::from(element.normal) * weight;
            }
        }
        // The two faces of a plate of no thickness have none where they meet.
        let least = if D == 2 { 1e-9 } else { 0.0 };
        let unit = move |n: Vect<D>| n.try_normalize(least).unwrap_or_else(Vect::zeros);
        normals.into_iter().map(unit)
    }

    /// All elements at the present position of the walls.
    fn elements(&self) -> &[Element<D>] {
        &self.walls().mesh.elements
    }

    /// Elements within a radius of a point, or a few more, ascending.
    fn near(&self, point: &Vect<D>, radius: f64) -> Vec<NearElement<D>> {
        let mut rows = NearRows::default();
        self.near_all(&[*point], radius, &mut rows);
        rows.elements
    }

    /// Pieces that end freely.
    fn shells(&self) -> &Shells {
        &self.walls().shells
    }

    /// Index of the wall of an element.
    fn wall_of(&self, near: NearElement<D>) -> usize {
        self.walls().mesh.elements[near.index()].wall
    }

    /// Elements as seen from a point.
    fn seen<'a>(
        &self,
        point: &Vect<D>,
        near: impl IntoIterator<Item = &'a NearElement<D>>,
    ) -> Vec<SeenElement<D>> {
        let (mesh, x) = (&self.walls().mesh, (*point).into());
        near.into_iter().map(|near| mesh.seen(x, *near)).collect()
    }

    /// Distance of the nearest wall, m, and its index, if nearer than `within`.
    fn nearest(&self, point: &Vect<D>, within: f64) -> Option<(f64, usize)> {
        let (walls, x) = (self.walls(), (*point).into());
        let near = walls.tree().near(&walls.mesh, x, within.min(walls.reach));
        let distance2 = |near| {
            let offset = walls.mesh.closest(x, near).offset;
            (dot(offset, offset), near)
        };
        let nearest = near.map(distance2).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(d2, near)| (d2.sqrt(), self.wall_of(near)))
    }
}

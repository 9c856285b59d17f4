//! What a wall treatment asks of the walls' geometry, in either dimension.

use sph_core::Vect;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::{BoundaryError, Gammas, PeriodicBox, Pose, Shells, WallSpec};

/// A node of the mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshPoint<const D: usize> {
    /// Position, m.
    pub position: Vect<D>,
    /// Unit normal into the fluid, the mean of those around.
    pub normal: Vect<D>,
    /// Fluid angle over 2π in the plane, fluid solid angle over 4π in space.
    pub theta: f64,
    /// Length or area of wall that the node answers for over δr^(d−1).
    pub size: f64,
    /// Index of the wall.
    pub wall: usize,
}

/// An element of the mesh: a segment or a triangle.
#[derive(Clone, Copy, Debug)]
pub struct MeshElement<const D: usize> {
    /// Centre, m.
    pub centre: Vect<D>,
    /// Unit normal into the fluid.
    pub normal: Vect<D>,
    /// Length or area, m^(d−1).
    pub measure: f64,
    /// Index of the wall.
    pub wall: usize,
    /// Its nodes.
    pub corners: [u32; D],
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
    /// Whole periods from the wall to what is seen of it, m.
    pub image: Vect<D>,
}

/// The walls of a scene as a mesh of elements of about the particle spacing.
pub trait WallMesh<const D: usize>: Sized + Send + Sync + std::fmt::Debug + 'static {
    /// An element, or one of its periodic images, near a point.
    type Near: Copy + Send + Sync + std::fmt::Debug;
    /// An element relative to a point.
    type Seen: Send + Sync;
    /// The wall integrals of a kernel.
    type Integrals: Send + Sync + std::fmt::Debug;
    /// Buffers of a task that finds γ.
    type Room: Default + Send + Sync + std::fmt::Debug;

    /// Meshes the walls; queries look up to `reach` metres far.
    ///
    /// # Errors
    /// If a wall is refused; the message names it.
    fn build(
        walls: &[WallSpec<D>],
        spacing: f64,
        reach: f64,
        domain: &PeriodicBox<D>,
    ) -> Result<Self, BoundaryError>;

    /// Integrals of a kernel shape with a smoothing length, m.
    ///
    /// # Errors
    /// If the kernel cannot be integrated.
    fn integrals(
        shape: &PiecewisePolynomial,
        smoothing_length: f64,
    ) -> Result<Self::Integrals, BoundaryError>;

    /// Names of the walls.
    fn names(&self) -> &[String];
    /// All nodes at the present position of the walls.
    fn points(&self) -> impl Iterator<Item = MeshPoint<D>> + '_;
    /// All elements at the present position of the walls.
    fn elements(&self) -> impl Iterator<Item = MeshElement<D>> + '_;

    /// Moves every wall to its pose.
    ///
    /// # Errors
    /// If a wall cannot follow.
    fn move_walls(&mut self, poses: &[Pose<D>]) -> Result<(), BoundaryError>;

    /// For every point the elements within a radius, or a few more: their number, and all of them one behind the other,
    /// each point's ascending.
    fn near_all(
        &self,
        points: &[Vect<D>],
        radius: f64,
        counts: &mut Vec<u32>,
        rows: &mut Vec<Self::Near>,
    );

    /// Elements within a radius of a point, or a few more, ascending.
    fn near(&self, point: &Vect<D>, radius: f64) -> Vec<Self::Near> {
        let mut row = Vec::new();
        self.near_all(
            std::slice::from_ref(point),
            radius,
            &mut Vec::new(),
            &mut row,
        );
        row
    }

    /// γ at a point from all elements that may be within the support; those that are become
    /// contacts. What else is in the row changes nothing.
    fn gamma(
        &self,
        integrals: &Self::Integrals,
        point: &Vect<D>,
        near: &[Self::Near],
        room: &mut Self::Room,
        contacts: &mut ContactBlock<D>,
    ) -> f64 {
        let mut found = Gammas::default();
        let one = std::iter::once((point, near));
        self.gammas(integrals, one, room, contacts, &mut found);
        found.all[0].0
    }

    /// γ at points, each with the elements that may be within its support; see [`Shells`] for those that end freely. What is
    /// hidden behind such a shell is no contact.
    fn gammas<'a>(
        &self,
        integrals: &Self::Integrals,
        points: impl Iterator<Item = (&'a Vect<D>, &'a [Self::Near])>,
        room: &mut Self::Room,
        contacts: &mut ContactBlock<D>,
        found: &mut Gammas,
    );

    /// Pieces that end freely.
    fn shells(&self) -> &Shells;

    /// Index of an element.
    fn element(&self, near: Self::Near) -> usize;

    /// Whether the way `by` from a point leads through an element.
    fn is_crossed(&self, near: Self::Near, point: &Vect<D>, by: &Vect<D>) -> bool;

    /// Least height of a point over the planes of the elements near it, of those that it is in front of, m; infinite where there
    /// is none. No element is nearer.
    fn clearance(&self, point: &Vect<D>, near: &[Self::Near]) -> f64;

    /// Where the walls keep a particle off that is behind some shells, among the places nearer than `reach` metres.
    fn hindrances(
        &self,
        of: (&Vect<D>, &[(u32, u32)]),
        near: &[Self::Near],
        reach: f64,
        hindrances: &mut Vec<Hindrance<D>>,
    );

    /// Whether a point is on the fluid's side of all walls.
    fn contains(&self, point: &Vect<D>) -> bool;

    /// How far walls with free ends enclose a point: their winding number, positive where they face it; none of closed
    /// walls.
    fn enclosed(&self, point: &Vect<D>) -> Option<f64>;

    /// Distance of the nearest wall, m, and its index, if nearer than `within`.
    fn nearest(&self, point: &Vect<D>, within: f64) -> Option<(f64, usize)>;

    /// Index of the wall of an element.
    fn wall_of(&self, near: Self::Near) -> usize;

    /// An element as seen from a point.
    fn seen(&self, point: &Vect<D>, near: Self::Near) -> Self::Seen;

    /// Distance of the nearest of some elements from a place relative to the point they are seen from, m, positive on its
    /// fluid's side; `None` if none of them is nearer than `within`.
    fn signed_distance(seen: &[Self::Seen], place: &Vect<D>, within: f64) -> Option<f64>;

    /// Lower and upper corner of the box around all walls, m.
    fn bounds(&self) -> Option<(Vect<D>, Vect<D>)>;

    /// Refuses points within a radius of the free end of an open wall.
    ///
    /// # Errors
    /// Names the wall and the place.
    fn check_free_ends(&self, points: &[Vect<D>], radius: f64) -> Result<(), BoundaryError>;

    /// Places of dummy particles behind the walls with the index of their wall, m.
    fn layers(&self, spacing: f64, support: f64) -> Vec<(usize, Vect<D>)>;

    /// Remarks on the walls.
    fn warnings(&self) -> Vec<String>;
}

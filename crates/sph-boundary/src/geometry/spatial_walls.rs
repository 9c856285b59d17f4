//! Walls in space: triangles for the wall treatments.

use std::sync::OnceLock;

use sph_core::Vect;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::geometry::faces::{Corner, Planes};
use crate::geometry::shells::{Gammas, ShellSums, Shells};
use crate::geometry::wall_mesh::{Hindrance, MeshElement, MeshPoint, WallMesh};
use crate::integrals::spatial::Weights;
use crate::treatment::groups::groups;
use crate::{
    BoundaryError, Closest, Drawing, Feature, NearTriangle, PeriodicBox, Pose, Renormalisation3d,
    SeenTriangle, Surface, TriangleGrid, TriangleMesh, WallSpec,
};

/// Surfaces remeshed at the particle spacing, with the grid that finds their triangles.
#[derive(Debug)]
pub struct SpatialWalls {
    pub(crate) mesh: TriangleMesh,
    /// Of the present position, made when somebody asks.
    grid: OnceLock<TriangleGrid>,
    pub(crate) planes: Planes,
    pub(crate) shells: Shells,
    reach: f64,
    pub(crate) domain: PeriodicBox<3>,
}

/// Two places nearer than this, relatively, are equally near.
const EQUALLY_NEAR: f64 = 1.0 + 1e-9;
/// A place is in a plane if it is this near to it, relatively.
const SAME_PLANE: f64 = 1e-6;

/// A triangle with its closest place, the vector there and its length.
type Seen<'a> = (&'a NearTriangle, Closest, Vect<3>, f64);

impl SpatialWalls {
    fn grid(&self) -> &TriangleGrid {
        let make = || TriangleGrid::build(&self.mesh, self.reach);
        self.grid.get_or_init(make)
    }
}

impl WallMesh<3> for SpatialWalls {
    type Near = NearTriangle;
    type Seen = SeenTriangle;
    type Integrals = Renormalisation3d;
    type Room = Weights;

    fn build(
        walls: &[WallSpec<3>],
        spacing: f64,
        reach: f64,
        domain: &PeriodicBox<3>,
    ) -> Result<Self, BoundaryError> {
        let mut surfaces: Vec<Surface> = Vec::new();
        for spec in walls {
            match &spec.drawing {
                Drawing::Surface(surface) => surfaces.push(surface.clone()),
                Drawing::Line(line) => {
                    let wall = line.name.clone();
                    return Err(BoundaryError::Dimension { wall, dimension: 3 });
                }
            }
        }
        let mesh = TriangleMesh::build(&surfaces, &groups(walls), spacing, domain)?;
        let triangles = mesh.triangles().iter();
        let triangles = triangles.map(|t| (t.nodes, walls[t.wall].open));
        let free = mesh.free_edges().iter().flat_map(|edge| edge.nodes);
        Ok(SpatialWalls {
            shells: Shells::new(triangles, mesh.nodes().len(), free),
            grid: OnceLock::new(),
            planes: Planes::new(&mesh),
            mesh,
            reach,
            domain: *domain,
        })
    }

    fn integrals(shape: &PiecewisePolynomial, h: f64) -> Result<Renormalisation3d, BoundaryError> {
        Renormalisation3d::new(shape, h)
    }

    fn names(&self) -> &[String] {
        self.mesh.walls()
    }

    fn points(&self) -> impl Iterator<Item = MeshPoint<3>> + '_ {
        let mut normals = vec![Vect::<3>::zeros(); self.mesh.nodes().len()];
        for triangle in self.mesh.triangles() {
            for node in triangle.nodes {
                normals[node] += Vect::from(triangle.normal) * triangle.area;
            }
        }
        let nodes = self.mesh.nodes().iter();
        nodes.zip(normals).map(|(node, normal)| MeshPoint {
            position: node.position.into(),
            normal: normal.try_normalize(0.0).unwrap_or_else(Vect::zeros),
            theta: node.theta,
            size: node.size,
            wall: node.wall,
        })
    }

    fn elements(&self) -> impl Iterator<Item = MeshElement<3>> + '_ {
        self.mesh.triangles().iter().map(|triangle| MeshElement {
            centre: triangle.centre.into(),
            normal: triangle.normal.into(),
            measure: triangle.area,
            wall: triangle.wall,
            corners: triangle.nodes.map(|n| n as u32),
        })
    }

    fn move_walls(&mut self, poses: &[Pose<3>]) -> Result<(), BoundaryError> {
        self.mesh.move_walls(poses)?;
        self.grid = OnceLock::new();
        self.planes = Planes::new(&self.mesh);
        Ok(())
    }

    /// Also those of which only the sphere around them is in reach: to look closer costs more than
    /// to see them left out by every γ. Face by face, as the triangles are.
    fn near_all(
        &self,
        points: &[Vect<3>],
        radius: f64,
        counts: &mut Vec<u32>,
        rows: &mut Vec<NearTriangle>,
    ) {
        let points: Vec<[f64; 3]> = points.iter().map(|p| (*p).into()).collect();
        self.grid()
            .rows(&points, radius.min(self.reach), counts, rows);
    }

    /// γ and the sum of ∇γ are exact over every planar face; the sum is shared out to the face's
    /// triangles by quadrature. A face counts where the disc of its plane within the support meets one of its triangles,
    /// whatever else stands in the row.
    fn clearance(&self, point: &Vect<3>, near: &[NearTriangle]) -> f64 {
        let heights = self.faces(near).map(|part| {
            let first = &self.mesh.triangles()[part[0].triangle as usize];
            let corner = Corner::new(&self.mesh, first.nodes[0], first.images[0]);
            -self
                .seen(&corner, part[0].image, point)
                .dot(&Vect::from(first.normal))
        });
        heights.filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min)
    }

    fn gammas<'a>(
        &self,
        integrals: &Renormalisation3d,
        points: impl Iterator<Item = (&'a Vect<3>, &'a [NearTriangle])>,
        room: &mut Weights,
        contacts: &mut ContactBlock<3>,
        found: &mut Gammas,
    ) {
        let mut sides = std::mem::take(&mut found.sides);
        for of in points {
            let planes = contacts.planes();
            sides.clear();
            let sum = self.see(integrals, of, room, contacts, (&mut sides, &[]));
            let behind: Vec<u32> = sides.behind().map(|(shell, _)| shell).collect();
            if !behind.is_empty() {
                contacts.truncate(planes);
                let again = &mut ShellSums::default();
                self.see(integrals, of, room, contacts, (again, &behind));
            }
            let gamma = sides.gamma(sum.signed_sum).unwrap_or_else(|| sum.gamma());
            found.push(gamma, contacts.planes(), &sides);
        }
        found.sides = sides;
    }

    fn shells(&self) -> &Shells {
        &self.shells
    }

    fn element(&self, near: NearTriangle) -> usize {
        near.triangle as usize
    }

    fn is_crossed(&self, near: NearTriangle, point: &Vect<3>, by: &Vect<3>) -> bool {
        let [a, b, c] = self
            .mesh
            .corners_from((*point).into(), near)
            .map(Vect::from);
        let normal = Vect::from(self.mesh.triangles()[near.triangle as usize].normal);
        let here = a.dot(&normal);
        if here * (here - by.dot(&normal)) > 0.0 {
            return false;
        }
        let sides = [(a, b), (b, c), (c, a)].map(|(p, q): (Vect<3>, Vect<3>)| by.dot(&p.cross(&q)));
        sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
    }

    fn hindrances(
        &self,
        (point, behind): (&Vect<3>, &[(u32, u32)]),
        row: &[NearTriangle],
        reach: f64,
        hindrances: &mut Vec<Hindrance<3>>,
    ) {
        let x: [f64; 3] = (*point).into();
        let all: Vec<_> = row
            .iter()
            .map(|near| {
                let closest = self.mesh.closest(x, *near);
                let offset = Vect::from(closest.offset);
                (near, closest, offset, offset.norm())
            })
            .filter(|(near, closest, _, distance)| {
                let shell = self.shells.of(near.triangle as usize);
                let turned = behind.iter().any(|(_, s)| *s == shell);
                let before = if turned {
                    closest.height < 0.0
                } else {
                    closest.height > 0.0
                };
                before && *distance <= reach
            })
            .collect();
        for (near, closest, offset, distance) in &all {
            // A place on the rim of a triangle counts where it is the nearest of the wall around:
            // on an edge that stands out, not where the plane beyond the rim is nearer.
            let beyond = |other: &Seen| {
                let normal = Vect::from(self.mesh.triangles()[other.0.triangle as usize].normal);
                let apart = offset - other.2;
                other.3 * EQUALLY_NEAR < *distance
                    && apart.dot(&normal).abs() < SAME_PLANE * distance
                    && apart.norm() < 2.0 * distance
            };
            if *distance == 0.0 || (closest.feature != Feature::Face && all.iter().any(beyond)) {
                continue;
            }
            hindrances.push(Hindrance {
                away: -offset / *distance,
                distance: *distance,
                only_if: None,
                wall: self.mesh.triangles()[near.triangle as usize].wall,
                place: point + offset,
                image: self.domain.shift(near.image.map(i32::from)).into(),
            });
        }
    }

    fn enclosed(&self, point: &Vect<3>) -> Option<f64> {
        self.mesh.enclosed((*point).into())
    }

    fn contains(&self, point: &Vect<3>) -> bool {
        self.mesh.contains((*point).into())
    }

    fn nearest(&self, point: &Vect<3>, within: f64) -> Option<(f64, usize)> {
        let x: [f64; 3] = (*point).into();
        let near = self.grid().near(&self.mesh, x, within.min(self.reach));
        near.map(|near| {
            let offset = Vect::from(self.mesh.closest(x, near).offset);
            (offset.norm(), near.triangle)
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(d, triangle)| (d, self.mesh.triangles()[triangle as usize].wall))
    }

    fn wall_of(&self, near: NearTriangle) -> usize {
        self.mesh.triangles()[near.triangle as usize].wall
    }

    fn seen(&self, point: &Vect<3>, near: NearTriangle) -> SeenTriangle {
        self.mesh.seen((*point).into(), near)
    }

    fn signed_distance(seen: &[SeenTriangle], place: &Vect<3>, within: f64) -> Option<f64> {
        SeenTriangle::signed_distance(seen, (*place).into(), within)
    }

    fn bounds(&self) -> Option<(Vect<3>, Vect<3>)> {
        let places = || self.mesh.nodes().iter().map(|n| Vect::from(n.position));
        let low = places().reduce(|a, b| a.inf(&b))?;
        Some((low, places().reduce(|a, b| a.sup(&b))?))
    }

    fn check_free_ends(&self, points: &[Vect<3>], radius: f64) -> Result<(), BoundaryError> {
        if self.mesh.free_edges().is_empty() {
            return Ok(());
        }
        let points: Vec<[f64; 3]> = points.iter().map(|p| (*p).into()).collect();
        self.mesh.check_free_edges(&points, radius)
    }

    fn layers(&self, spacing: f64, support: f64) -> Vec<(usize, Vect<3>)> {
        crate::geometry::lattice_layers::layers(self, &self.domain, spacing, support)
    }

    fn warnings(&self) -> Vec<String> {
        let all = self.mesh.warnings().iter();
        all.map(ToString::to_string).collect()
    }
}

//! Walls in space: triangles for the wall treatments.

use std::sync::OnceLock;

use sph_core::Vect;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::geometry::wall_mesh::{Hindrance, MeshElement, MeshPoint, WallMesh};
use crate::integrals::spatial::{Circle, Foot, Patch, Plane, Weights};
use crate::treatment::outline::groups;
use crate::{
    BoundaryError, Closest, Drawing, FaceEdge, Feature, GammaSum3d, NearTriangle, PeriodicBox,
    Pose, Renormalisation3d, SeenTriangle, Surface, TriangleGrid, TriangleMesh, WallSpec,
};

/// Surfaces remeshed at the particle spacing, with the grid that finds their triangles.
#[derive(Debug)]
pub struct SpatialWalls {
    mesh: TriangleMesh,
    /// Of the present position, made when somebody asks.
    grid: OnceLock<TriangleGrid>,
    planes: Planes,
    reach: f64,
    domain: PeriodicBox<3>,
}

/// The faces as planes, and the triangles in them.
#[derive(Debug, Default)]
struct Planes {
    planes: Vec<Plane>,
    /// By face: one more than its last triangle.
    ends: Vec<u32>,
    /// By face: its edges, with the corners at hand.
    edges: Vec<Vec<[Corner; 2]>>,
    /// By triangle: its face.
    faces: Vec<u32>,
    /// By triangle.
    patches: Vec<Patch>,
    /// By triangle.
    circles: Vec<Circle>,
}

/// A corner of a face.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Of its node, m.
    position: Vect<3>,
    /// Whole periods to add.
    image: [i32; 3],
}

impl Corner {
    fn new(mesh: &TriangleMesh, node: usize, image: [i32; 3]) -> Self {
        let position = mesh.nodes()[node].position.into();
        Corner { position, image }
    }
}

impl Planes {
    /// For the present position of the walls.
    fn new(mesh: &TriangleMesh) -> Self {
        let mut all = Self::default();
        for face in mesh.faces() {
            let corner = |e: &FaceEdge, k: usize| Corner::new(mesh, e.nodes[k], e.images[k]);
            let edges = face.edges.iter().map(|e| [corner(e, 0), corner(e, 1)]);
            all.edges.push(edges.collect());
        }
        // Triangles are stored face by face.
        for (t, triangle) in mesh.triangles().iter().enumerate() {
            let corners = mesh.corners(t);
            if all.planes.len() <= triangle.face {
                let plane = Plane::new(corners[0], triangle.normal);
                all.planes.resize(triangle.face + 1, plane);
                all.ends.resize(triangle.face + 1, t as u32);
            }
            all.ends[triangle.face] = t as u32 + 1;
            let plane = &all.planes[triangle.face];
            let (patch, circle) = Patch::new(plane, corners, triangle.area);
            all.patches.push(patch);
            all.circles.push(circle);
            all.faces.push(triangle.face as u32);
        }
        all
    }
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

    /// The triangles of a row, sorted by image and triangle, by face and image.
    fn faces<'a>(
        &'a self,
        mut row: &'a [NearTriangle],
    ) -> impl Iterator<Item = &'a [NearTriangle]> + 'a {
        std::iter::from_fn(move || {
            let first = row.first()?;
            let end = self.planes.ends[self.planes.faces[first.triangle as usize] as usize];
            let same = |n: &NearTriangle| n.image == first.image && n.triangle < end;
            let (part, rest) = row.split_at(first_other(row, same));
            row = rest;
            Some(part)
        })
    }

    /// A corner of an image of a face relative to a point, m: bitwise what
    /// [`TriangleMesh::corners_from`] gives.
    #[inline(always)]
    fn seen(&self, corner: &Corner, image: [i8; 3], point: &Vect<3>) -> Vect<3> {
        let from = corner.position - point;
        if corner.image == [0; 3] && image == [0; 3] {
            return from;
        }
        let shift = |k: usize| corner.image[k] + i32::from(image[k]);
        from + Vect::from(self.domain.shift([shift(0), shift(1), shift(2)]))
    }
}

/// Where a row that begins with what is alike goes on with others. Steps of a fixed size are foreseen by the processor, those
/// of a bisection are not.
#[inline(always)]
fn first_other<T>(row: &[T], same: impl Fn(&T) -> bool) -> usize {
    const STEP: usize = 16;
    let mut from = 1;
    while row.get(from + STEP).is_some_and(&same) {
        from += STEP;
    }
    let others = row[from..].iter().position(|n| !same(n));
    others.map_or(row.len(), |k| from + k)
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
        Ok(SpatialWalls {
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

    fn gamma(
        &self,
        integrals: &Renormalisation3d,
        point: &Vect<3>,
        row: &[NearTriangle],
        weights: &mut Weights,
        contacts: &mut ContactBlock<3>,
    ) -> f64 {
        let radius = integrals.kernel_radius();
        let mut sum = GammaSum3d::default();
        for part in self.faces(row) {
            let image = part[0].image;
            let first = &self.mesh.triangles()[part[0].triangle as usize];
            let normal = Vect::from(first.normal);
            let corner = Corner::new(&self.mesh, first.nodes[0], first.images[0]);
            let height = -self.seen(&corner, image, point).dot(&normal);
            if height.abs() >= radius {
                continue;
            }
            let unshifted = match image {
                [0, 0, 0] => *point,
                _ => point - Vect::from(self.domain.shift(image.map(i32::from))),
            };
            let foot = Foot {
                place: self.planes.planes[first.face].foot(unshifted.into()),
                height,
                reach: (radius * radius - height * height).sqrt(),
            };
            let triangles = part.iter().map(|near| near.triangle);
            if !weights.find(triangles, &self.planes.circles, &foot) {
                continue;
            }
            let edges = self.planes.edges[first.face].iter().map(|[start, end]| {
                let start = self.seen(start, image, point).into();
                [start, self.seen(end, image, point).into()]
            });
            let whole = integrals.polygon(height, first.normal, edges);
            sum.add(&whole, first.normal);
            if whole.kernel == 0.0 {
                continue;
            }
            weights.weigh(integrals, &self.planes.patches, &foot);
            let (elements, weights) = weights.all();
            let mut total = 0.0;
            for weight in weights {
                total += weight;
            }
            let scale = whole.kernel / total;
            let share = |(&element, &weight): (&u32, &f64)| match weight > 0.0 {
                true => (element, weight * scale),
                false => (element, 0.0),
            };
            contacts.push(normal, height, elements.iter().zip(weights).map(share));
        }
        sum.gamma()
    }

    fn hindrances(
        &self,
        point: &Vect<3>,
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
            .filter(|(_, closest, _, distance)| closest.height > 0.0 && *distance <= reach)
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

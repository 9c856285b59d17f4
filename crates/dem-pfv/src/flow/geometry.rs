//! Pores and throats of spheres in a box: volumes of cells, faces between neighbours.

use crate::Vector;
use crate::flow::facet::{Facet, edge};
use crate::flow::throat::{Pores, SlipCondition, SolidAngles};
use crate::flow::{FlowError, Throat, solid_angle};
use crate::triangulation::{Cell, Sphere, Triangulation, Vertex, Wall, except};

/// Deepest overlap, in terms of the smaller radius.
const DEEPEST: f64 = 0.1;

/// Cells and throats of a triangulation in a room whose walls meet at right angles.
#[derive(Clone, Debug)]
pub struct PoreGeometry {
    /// The triangulation.
    pub mesh: Triangulation,
    /// Power centre of every cell, m.
    pub centres: Vec<Vector>,
    /// Volume of every cell, m³; the sum is that of the room.
    pub volumes: Vec<f64>,
    /// Volume of fluid in every cell, m³.
    pub void_volumes: Vec<f64>,
    /// All throats.
    pub throats: Vec<Throat>,
}

impl PoreGeometry {
    /// Pores and throats; one grip per wall.
    ///
    /// # Errors
    /// A room that is no box, spheres that overlap each other or a wall by more than a tenth of the radius, a list
    /// of grips of another length than the walls.
    pub fn new(
        mesh: Triangulation,
        grips: &[SlipCondition],
        angles: SolidAngles,
    ) -> Result<Self, FlowError> {
        Self::pressed(mesh, grips, angles, DEEPEST)
    }

    /// The same for spheres that a load has pressed together: `deepest` is the largest overlap, in terms of the
    /// smaller radius. Throats that spheres fill are closed. Where a centre is in another sphere, at 1, formulas end.
    ///
    /// # Errors
    /// As [`PoreGeometry::new`].
    pub fn pressed(
        mesh: Triangulation,
        grips: &[SlipCondition],
        angles: SolidAngles,
        deepest: f64,
    ) -> Result<Self, FlowError> {
        if grips.len() != mesh.walls.len() {
            let (given, needed) = (grips.len(), mesh.walls.len());
            return Err(FlowError::Length("grips of walls", given, needed));
        }
        check_walls(&mesh)?;
        check_overlaps(&mesh, deepest)?;
        let cells = 0..mesh.cells.len();
        let centres: Vec<_> = cells.map(|c| mesh.power_centre(c)).collect();
        let positions: Vec<_> = mesh.spheres.iter().map(|s| s.centre).collect();
        let volumes = cell_volumes(&mesh, &positions, &mesh.walls);
        let solids = mesh.cells.iter().map(|c| solid_volume(&mesh, c));
        let void_volumes = volumes.iter().zip(solids).map(|(v, s)| v - s).collect();
        let pores = Pores {
            mesh: &mesh,
            centres: &centres,
            grips,
            angles,
        };
        let throats = mesh.facets().map(|f| pores.throat(&f)).collect();
        Ok(Self {
            mesh,
            centres,
            volumes,
            void_volumes,
            throats,
        })
    }

    /// Share (m²) of a cell in a wall: the projection of the facet opposite; zero if it has no part in the wall.
    pub fn area_on_wall(&self, cell: usize, wall: usize) -> f64 {
        let v = self.mesh.cells[cell].vertices();
        let Some(i) = v.iter().position(|v| *v == Vertex::Wall(wall)) else {
            return 0.0;
        };
        let area = Facet::new(&self.mesh, &except(&v, i)).area();
        area.dot(&self.mesh.walls[wall].normal).abs()
    }

    /// A place inside each cell (m), for sensors and profiles: the mean of its centres, half-way to its walls.
    pub fn middles(&self) -> Vec<Vector> {
        let mesh = &self.mesh;
        let middle = |cell: &Cell| {
            let mean = mesh.middle(cell);
            cell.vertices().iter().fold(mean, |at, v| match v {
                Vertex::Wall(w) => {
                    let wall = &mesh.walls[*w];
                    at - 0.5 * wall.distance(mean) * wall.normal
                }
                Vertex::Sphere(_) => at,
            })
        };
        mesh.cells.iter().map(middle).collect()
    }

    /// All edges with a sphere, in the order of their numbers, spheres before walls. A face between grains at a free
    /// surface reaches up to the wall above them.
    ///
    /// The pyramids over all faces with tips at the spheres fill the room.
    pub fn edges(&self) -> Vec<Edge> {
        let mut parts: Vec<Edge> = Vec::with_capacity(3 * self.throats.len());
        for throat in &self.throats {
            for c in 0..3 {
                let (a, b) = (throat.vertices[c], throat.vertices[(c + 1) % 3]);
                let Vertex::Sphere(sphere) = a.min(b) else {
                    continue;
                };
                let other = a.max(b);
                let third = throat.vertices[(c + 2) % 3];
                let area = self.part(throat, sphere, other, third);
                parts.push(Edge {
                    sphere,
                    other,
                    area,
                });
            }
        }
        parts.sort_by_key(|e| (e.sphere, e.other));
        parts.dedup_by(|next, kept| {
            let same = (next.sphere, next.other) == (kept.sphere, kept.other);
            if same {
                kept.area += next.area;
            }
            same
        });
        parts
    }

    /// Area (m²) of the triangle of a throat's power centres and the point where the edge meets its face, with the sign
    /// of the turn around the edge: over all throats around it these add up to the face.
    fn part(&self, throat: &Throat, sphere: usize, other: Vertex, third: Vertex) -> f64 {
        let mesh = &self.mesh;
        let along = edge(mesh, sphere, other);
        let Some(direction) = along.try_normalize(0.0) else {
            return 0.0;
        };
        let Sphere { centre, radius } = mesh.spheres[sphere];
        let between = along.norm();
        let distance = match other {
            // Where the powers of a point on the line of centres are equal.
            Vertex::Sphere(l) => {
                let second = mesh.spheres[l].radius;
                0.5 * (between + (radius * radius - second * second) / between)
            }
            Vertex::Wall(_) => between,
        };
        let middle = centre + distance * direction;
        let [i, j] = throat.cells.map(|c| self.centres[c] - middle);
        let around = direction.cross(&edge(mesh, sphere, third));
        let turn = throat.normal.dot(&around);
        let area: Vector = 0.5 * i.cross(&j);
        area.dot(&direction) * turn.signum()
    }
}

fn check_walls(mesh: &Triangulation) -> Result<(), FlowError> {
    let walls = &mesh.walls;
    for (first, v) in walls.iter().enumerate() {
        for (second, w) in walls.iter().enumerate().skip(first + 1) {
            let cosine = v.normal.dot(&w.normal).abs();
            if cosine > 1e-12 && cosine < 1.0 - 1e-12 {
                return Err(FlowError::ObliqueWalls(first, second));
            }
        }
    }
    match walls.len() {
        6 => Ok(()),
        walls => Err(FlowError::NoBox(walls)),
    }
}

fn check_overlaps(mesh: &Triangulation, deepest: f64) -> Result<(), FlowError> {
    let pairs = |cell: &Cell| {
        let vertices = cell.vertices();
        let spheres = vertices.into_iter().filter_map(Vertex::sphere);
        spheres.flat_map(move |k| vertices.map(|other| (k, other)))
    };
    for (first, other) in mesh.cells.iter().flat_map(pairs) {
        let a = &mesh.spheres[first];
        match other {
            Vertex::Sphere(second) if second > first => {
                let b = &mesh.spheres[second];
                let overlap = a.radius + b.radius - (a.centre - b.centre).norm();
                if overlap > deepest * a.radius.min(b.radius) {
                    return Err(FlowError::Overlap(first, second, overlap, deepest));
                }
            }
            Vertex::Wall(wall) => {
                let overlap = a.radius - mesh.walls[wall].distance(a.centre);
                if overlap > deepest * a.radius {
                    return Err(FlowError::InWall(first, wall, overlap, deepest));
                }
            }
            Vertex::Sphere(_) => {}
        }
    }
    Ok(())
}

/// Volumes V_i (m³) of all cells with the centres and walls given in place of the mesh's own, connectivity
/// kept; they add up to the room's. With distances a_c of a centre a from wall c:
///
/// ```text
/// tetrahedron     (a − d) × (b − d) · (c − d) / 6
/// prism           A⊥ (a_c + b_c + c_c) / 3,            A⊥ the area projected on the wall
/// wedge           ℓ/3 (a₁a₂ + b₁b₂ + ½ (a₁b₂ + a₂b₁)),  ℓ the length along both walls
/// corner          a₁ a₂ a₃
/// ```
///
/// A volume is negative if the cell has turned inside out. Rates follow by differences in time, from
/// volumes of the same mesh. Source: the exact limit of Catalano 2012, §3.1.
pub fn cell_volumes(mesh: &Triangulation, centres: &[Vector], walls: &[Wall]) -> Vec<f64> {
    let volume = |cell: &Cell| volume(cell, centres, walls);
    mesh.cells.iter().map(volume).collect()
}

fn volume(cell: &Cell, centres: &[Vector], walls: &[Wall]) -> f64 {
    let (vertices, sign) = spheres_first(cell.vertices());
    let x = |i: usize| match vertices[i] {
        Vertex::Sphere(k) => centres[k],
        Vertex::Wall(_) => Vector::zeros(),
    };
    let wall = |i: usize| match vertices[i] {
        Vertex::Wall(w) => Some(&walls[w]),
        Vertex::Sphere(_) => None,
    };
    match (wall(1), wall(2), wall(3)) {
        (Some(u), Some(v), Some(w)) => u.distance(x(0)) * v.distance(x(0)) * w.distance(x(0)),
        (None, Some(v), Some(w)) => {
            let [[a1, a2], [b1, b2]] = [0, 1].map(|i| [v, w].map(|wall| wall.distance(x(i))));
            let length = sign * (x(0) - x(1)).dot(&v.normal.cross(&w.normal));
            length / 3.0 * (a1 * a2 + b1 * b2 + 0.5 * (a1 * b2 + a2 * b1))
        }
        (_, _, Some(w)) => {
            let base = 0.5 * sign * (x(0) - x(2)).cross(&(x(1) - x(2))).dot(&w.normal);
            base * (0..3).map(|i| w.distance(x(i))).sum::<f64>() / 3.0
        }
        _ => sign * (x(0) - x(3)).cross(&(x(1) - x(3))).dot(&(x(2) - x(3))) / 6.0,
    }
}

/// Vertices with spheres first, and the sign of the permutation.
fn spheres_first(mut vertices: [Vertex; 4]) -> ([Vertex; 4], f64) {
    let mut sign = 1.0;
    let wall = |v: Vertex| v.sphere().is_none();
    while let Some(i) = (0..3).find(|&i| wall(vertices[i]) && !wall(vertices[i + 1])) {
        vertices.swap(i, i + 1);
        sign = -sign;
    }
    (vertices, sign)
}

/// Volume of the spheres within a cell, m³: Σ ⅓ R³ |ω|.
pub fn solid_volume(mesh: &Triangulation, cell: &Cell) -> f64 {
    let vertices = cell.vertices();
    let share = |(i, v): (usize, &Vertex)| {
        let Vertex::Sphere(k) = *v else { return 0.0 };
        let [a, b, c] = except(&vertices, i).map(|o| edge(mesh, k, o));
        mesh.spheres[k].radius.powi(3) / 3.0 * solid_angle(a, b, c).abs()
    };
    vertices.iter().enumerate().map(share).sum()
}

/// Two neighbours: a sphere, and a sphere or a wall beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The sphere, of two the one with the smaller number.
    pub sphere: usize,
    /// Its neighbour.
    pub other: Vertex,
    /// Area S of the face between both in the power diagram, m²: the polygon of the power centres around the edge.
    pub area: f64,
}

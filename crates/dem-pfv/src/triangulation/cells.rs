//! The finished triangulation: cells, facets, neighbours, power centres.

use sparse::Groups;

use crate::Vector;
use crate::triangulation::build::Builder;
use crate::triangulation::order::insertion_order;
use crate::triangulation::predicates::{GHOST, Predicates, except};
use crate::triangulation::{Sphere, TriangulationError, Wall, build};

/// A vertex of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Vertex {
    /// The sphere with this number.
    Sphere(usize),
    /// The wall with this number, a vertex at infinity.
    Wall(usize),
}

/// Marks the numbers of walls.
const WALL: u32 = 1 << 31;
const NONE: u32 = u32::MAX;

/// A tetrahedron of four spheres; with one to three walls in their place, a prism, a wedge or a corner.
///
/// The determinant (x₁ − x₀) × (x₂ − x₀) · (x₃ − x₀) of four spheres is negative: seen from vertex 3,
/// the vertices 0, 1, 2 go counterclockwise. With x − x₀ replaced by −n for walls this holds for all cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    vertices: [u32; 4],
    neighbours: [u32; 4],
}

impl Vertex {
    /// The number of the sphere, if it is one.
    pub fn sphere(self) -> Option<usize> {
        match self {
            Self::Sphere(k) => Some(k),
            Self::Wall(_) => None,
        }
    }
}

impl Cell {
    /// Its vertices.
    pub fn vertices(&self) -> [Vertex; 4] {
        self.vertices.map(|v| match v & WALL {
            0 => Vertex::Sphere(v as usize),
            _ => Vertex::Wall((v & !WALL) as usize),
        })
    }

    /// The cell across the facet that lacks vertex `i`; none across the hull and in the corner of a room.
    pub fn neighbour(&self, i: usize) -> Option<usize> {
        (self.neighbours[i] != NONE).then_some(self.neighbours[i] as usize)
    }

    /// Number of walls among its vertices, 0 to 3.
    pub fn walls(&self) -> usize {
        self.vertices.iter().filter(|v| **v & WALL != 0).count()
    }
}

/// A triangle between two cells, of three vertices of which two at most are walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Facet {
    /// The cells on both sides, the lower number first.
    pub cells: [usize; 2],
    /// The opposite vertex of the first cell.
    pub opposite: usize,
    /// Its vertices, in the order in which the first cell has them.
    pub vertices: [Vertex; 3],
}

/// The regular triangulation of spheres.
#[derive(Clone, Debug)]
pub struct Triangulation {
    /// The spheres, in the order given.
    pub spheres: Vec<Sphere>,
    /// The walls, in the order given.
    pub walls: Vec<Wall>,
    /// All cells.
    pub cells: Vec<Cell>,
    /// Cells around each sphere, then around each wall.
    pub(crate) around: Groups,
}

impl Triangulation {
    /// Triangulates the convex hull of the centres of at least four spheres.
    ///
    /// # Errors
    /// Bad numbers, equal centres, hidden spheres, centres in one plane: [`TriangulationError`].
    pub fn of_spheres(spheres: &[Sphere]) -> Result<Self, TriangulationError> {
        checked(spheres, &[], 4)?;
        let predicates = Predicates::new(spheres, &[]);
        let (done, cells) = build::four_spheres(&predicates, spheres)?;
        let order = insertion_order(spheres).into_iter();
        let order = order.filter(|e| !done.contains(e));
        Self::grown(spheres, &[], Builder::new(&predicates, cells), order)
    }

    /// Triangulates the room between walls that holds at least one sphere. Walls make a convex room,
    /// in whose corners three meet.
    ///
    /// # Errors
    /// Bad numbers, equal centres, hidden spheres, centres on or behind a wall, walls that leave a way
    /// out or have no part in the room: [`TriangulationError`].
    pub fn within(spheres: &[Sphere], walls: &[Wall]) -> Result<Self, TriangulationError> {
        if walls.is_empty() {
            return Self::of_spheres(spheres);
        }
        checked(spheres, walls, 1)?;
        let predicates = Predicates::new(spheres, walls);
        let mut order = insertion_order(spheres).into_iter();
        let first = order.next().unwrap_or_default();
        let cells = build::room(&predicates, walls, spheres.len(), first)?;
        Self::grown(spheres, walls, Builder::new(&predicates, cells), order)
    }

    /// Inserts further spheres, then leaves out vacant places and cells behind the hull.
    fn grown(
        spheres: &[Sphere],
        walls: &[Wall],
        mut builder: Builder,
        mut order: impl Iterator<Item = u32>,
    ) -> Result<Self, TriangulationError> {
        order.try_for_each(|e| builder.insert(e))?;
        let vacant = builder.vacant();
        let mut number = vec![NONE; vacant.len()];
        let mut count = 0;
        for (c, cell) in builder.cells.iter().enumerate() {
            if !vacant[c] && !cell.contains(&GHOST) {
                number[c] = count;
                count += 1;
            }
        }
        let vertex = |v: u32| match v as usize {
            v if v < spheres.len() => v as u32,
            v => (v - spheres.len()) as u32 | WALL,
        };
        let kept = (0..vacant.len()).filter(|c| number[*c] != NONE);
        let cell = |c: usize| Cell {
            vertices: builder.cells[c].map(vertex),
            neighbours: builder.neighbours[c].map(|n| number[n as usize]),
        };
        let cells: Vec<_> = kept.map(cell).collect();
        let place = |v: u32| match v & WALL {
            0 => v,
            _ => spheres.len() as u32 + (v & !WALL),
        };
        let corners = cells.iter().zip(0_u32..);
        let corners = corners.flat_map(|(cell, c)| cell.vertices.map(|v| (place(v), c)));
        let around = Groups::new(spheres.len() + walls.len(), corners);
        if let Some(sphere) = (0..spheres.len()).find(|k| around.members(*k).is_empty()) {
            return Err(TriangulationError::Hidden(sphere));
        }
        Ok(Self {
            spheres: spheres.to_vec(),
            walls: walls.to_vec(),
            cells,
            around,
        })
    }

    /// The numbers of the cells around a vertex, ascending.
    pub fn cells_around(&self, vertex: Vertex) -> &[u32] {
        self.around.members(match vertex {
            Vertex::Sphere(k) => k,
            Vertex::Wall(w) => self.spheres.len() + w,
        })
    }

    /// Mean of the centres of a cell's spheres, m.
    pub fn middle(&self, cell: &Cell) -> Vector {
        let spheres = cell.vertices().into_iter().filter_map(Vertex::sphere);
        let sum: Vector = spheres.map(|k| self.spheres[k].centre).sum();
        sum / (4 - cell.walls()) as f64
    }

    /// Facets between two cells, each once, in the order of their first cells.
    pub fn facets(&self) -> impl Iterator<Item = Facet> + '_ {
        let cells = self.cells.iter().enumerate();
        cells.flat_map(|(c, cell)| {
            (0..4).filter_map(move |i| {
                let n = cell.neighbour(i).filter(|n| *n > c)?;
                Some(Facet {
                    cells: [c, n],
                    opposite: i,
                    vertices: except(&cell.vertices(), i),
                })
            })
        })
    }

    /// The point of equal power to the four vertices of a cell, m; on every wall of the cell:
    ///
    /// ```text
    /// (x_k − x₀) · (P − x₀) = ½ (|x_k − x₀|² − R_k² + R₀²),     n_w · (P − x₀) = c_w − n_w · x₀
    /// ```
    ///
    /// solved by Cramer's rule. Source: Catalano 2012, §3.1; the wall's row is the limit of a tangent
    /// sphere of infinite radius.
    pub fn power_centre(&self, cell: usize) -> Vector {
        let vertices = self.cells[cell].vertices();
        let spheres = vertices.iter().enumerate();
        let mut spheres = spheres.filter_map(|(i, v)| Some((i, &self.spheres[v.sphere()?])));
        let Some((base, s0)) = spheres.next() else {
            return Vector::repeat(f64::NAN);
        };
        let row = |v: Vertex| match v {
            Vertex::Sphere(k) => {
                let s = &self.spheres[k];
                let d = s.centre - s0.centre;
                let weights = (s0.radius - s.radius) * (s0.radius + s.radius);
                (d, 0.5 * (d.norm_squared() + weights))
            }
            Vertex::Wall(w) => {
                let wall = &self.walls[w];
                (wall.normal, -wall.distance(s0.centre))
            }
        };
        let [(d1, b1), (d2, b2), (d3, b3)] = except(&vertices, base).map(row);
        let c = d2.cross(&d3);
        s0.centre + (b1 * c + b2 * d3.cross(&d1) + b3 * d1.cross(&d2)) / d1.dot(&c)
    }
}

/// Refuses spheres without a triangulation, before it is tried.
fn checked(spheres: &[Sphere], walls: &[Wall], needed: usize) -> Result<(), TriangulationError> {
    if spheres.len() < needed {
        return Err(TriangulationError::TooFew(spheres.len(), needed));
    }
    for (wall, w) in walls.iter().enumerate() {
        let unit = (w.normal.norm() - 1.0).abs() < 1e-9;
        if !unit || !w.offset.is_finite() {
            return Err(TriangulationError::BadWall(wall, w.normal.into(), w.offset));
        }
    }
    for (sphere, s) in spheres.iter().enumerate() {
        let finite = s.centre.iter().all(|x| x.is_finite()) && s.radius.is_finite();
        if !finite || s.radius < 0.0 {
            let (at, radius) = (s.centre.into(), s.radius);
            return Err(TriangulationError::BadSphere(sphere, at, radius));
        }
        let distances = walls.iter().map(|w| w.distance(s.centre)).enumerate();
        if let Some((wall, distance)) = distances.into_iter().find(|(_, d)| *d <= 0.0) {
            return Err(TriangulationError::Outside(sphere, wall, distance));
        }
    }
    distinct(spheres)
}

/// Refuses equal centres.
fn distinct(spheres: &[Sphere]) -> Result<(), TriangulationError> {
    // Adding zero makes −0 and 0 equal.
    let key = |k: &usize| <[f64; 3]>::from(spheres[*k].centre).map(|x| (x + 0.0).to_bits());
    let mut order: Vec<_> = (0..spheres.len()).collect();
    order.sort_unstable_by_key(|k| (key(k), *k));
    match order.windows(2).find(|pair| key(&pair[0]) == key(&pair[1])) {
        Some(pair) => {
            let centre = spheres[pair[0]].centre.into();
            Err(TriangulationError::Duplicate(pair[0], pair[1], centre))
        }
        None => Ok(()),
    }
}

//! Surfaces as drawn, and their triangles with the corners welded.

use super::places::{HalfEdge, Places, Site, half_edges};
use crate::Polyline;
use crate::error::{BoundaryError, Place, Result};
use crate::geometry::checks::check_finite;
use crate::geometry::vector::{Point, bounds, dot, double_area, norm, padded, sub};
use crate::parallel::*;

/// Area over longest edge squared below which a triangle has none.
const NO_AREA: f64 = 1e-9;
/// Altitude over longest edge below which a triangle is a needle.
const NEEDLE: f64 = 1e-6;
/// Surfaces smaller than this many spacings are refused.
const SMALLEST: f64 = 2.0;
/// Most triangles of all walls together.
pub(super) const MOST_ELEMENTS: u64 = 20_000_000;

/// A wall as drawn in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name, used in messages.
    pub name: String,
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// Corners of the triangles among the points; the normal by the right-hand rule points into the fluid.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The same surface with the fluid on the other side.
    pub fn reversed(mut self) -> Self {
        for corners in &mut self.triangles {
            corners.swap(1, 2);
        }
        self
    }
}

/// Geometry of a wall.
#[derive(Clone, Debug)]
pub enum Drawing {
    /// In two dimensions.
    Line(Polyline),
    /// In three dimensions.
    Surface(Surface),
}

impl Drawing {
    /// Name of the wall.
    pub fn name(&self) -> &str {
        match self {
            Self::Line(line) => &line.name,
            Self::Surface(surface) => &surface.name,
        }
    }

    /// Its points, with a given number of coordinates, m.
    pub fn points<const D: usize>(&self) -> Vec<[f64; D]> {
        match self {
            Self::Line(line) => line.points.iter().map(|p| padded(p)).collect(),
            Self::Surface(surface) => surface.points.iter().map(|p| padded(p)).collect(),
        }
    }
}

pub(super) struct Drawn {
    pub wall: usize,
    pub group: usize,
    /// Its number in the wall.
    pub index: usize,
    pub corners: [Site; 3],
    pub places: [Point; 3],
    pub area: f64,
    pub normal: Point,
}

/// Coordinates that are not finite and corners that do not exist.
pub(super) fn check_input(surface: &Surface) -> Result<()> {
    if surface.triangles.is_empty() {
        return Err(BoundaryError::unfit(&surface.name, "has no triangle"));
    }
    check_finite(&surface.name, &surface.points)?;
    let count = surface.points.len();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        if let Some(point) = corners.iter().find(|c| **c as usize >= count) {
            let why =
                format!("triangle {triangle} has the corner {point}, there are {count} points");
            return Err(BoundaryError::of_part(&surface.name, why));
        }
    }
    Ok(())
}

/// Surfaces of the size of a particle and walls of too many elements.
pub(super) fn check_extent(surfaces: &[Surface], spacing: f64) -> Result<()> {
    let mut needs = Vec::with_capacity(surfaces.len());
    for surface in surfaces {
        let corners = |t: &[u32; 3]| t.map(|c| surface.points[c as usize]);
        let [low, high] = bounds(surface.triangles.iter().flat_map(corners));
        let extent = norm(sub(high, low));
        if extent < SMALLEST * spacing {
            let why = format!(
                "is {extent} m across, less than two spacings of {spacing} m: draw it larger, check the unit of length, \
                 or take a smaller spacing"
            );
            return Err(BoundaryError::unfit(&surface.name, why));
        }
        // Two triangles to a square of the spacing.
        let cells = |t: &[u32; 3]| norm(double_area(corners(t))) / (spacing * spacing);
        needs.push(surface.triangles.iter().map(cells).sum::<f64>());
    }
    let estimate: f64 = needs.iter().sum();
    let most = (0..needs.len()).max_by(|a, b| needs[*a].total_cmp(&needs[*b]));
    match most {
        Some(most) if estimate > MOST_ELEMENTS as f64 => {
            let (wall, own) = (&surfaces[most].name, needs[most] as u64);
            Err(too_many(wall, own, estimate as u64))
        }
        _ => Ok(()),
    }
}

pub(super) fn too_many(wall: &str, own: u64, estimate: u64) -> BoundaryError {
    BoundaryError(format!(
        "the walls would be cut into about {estimate} triangles, {MOST_ELEMENTS} at most: `{wall}` alone needs {own}; \
         check the unit of length or use a coarser spacing"
    ))
}

/// Welds the corners of a wall and checks every triangle by itself.
pub(super) fn weld(
    surface: &Surface,
    wall: usize,
    group: usize,
    places: &mut Places,
) -> Result<Vec<Drawn>> {
    // In the order of the points: the first of those at one place sets the place of its node.
    let mut used = vec![false; surface.points.len()];
    for corner in surface.triangles.iter().flatten() {
        used[*corner as usize] = true;
    }
    let site = |(point, used): (&Point, bool)| match used {
        true => places.find(*point, group),
        false => Site::unmoved(u32::MAX),
    };
    let sites: Vec<Site> = surface.points.iter().zip(used).map(site).collect();
    let mut drawn = Vec::with_capacity(surface.triangles.len());
    for (index, corners) in surface.triangles.iter().enumerate() {
        let corners = corners.map(|c| sites[c as usize]);
        let at = corners.map(|c| places.at(c));
        let double = double_area(at);
        let area = 0.5 * norm(double);
        let side = |i: usize| norm(sub(at[(i + 1) % 3], at[i]));
        let edge = side(0).max(side(1)).max(side(2));
        let refused = |why: String| {
            let why = format!("triangle {index} at {} {why}", Place::from(at[0]));
            Err(BoundaryError::of_part(&surface.name, why))
        };
        let [a, b, c] = corners;
        if a == b || b == c || c == a || area < NO_AREA * edge * edge {
            return refused("has no area".into());
        }
        let altitude = 2.0 * area / edge;
        if altitude < NEEDLE * edge {
            return refused(format!(
                "is a needle: {altitude} m high on an edge of {edge} m"
            ));
        }
        drawn.push(Drawn {
            wall,
            group,
            index,
            corners,
            places: at,
            area,
            normal: double.map(|x| x / (2.0 * area)),
        });
    }
    Ok(drawn)
}

/// The triangle beyond each edge of each triangle of a wall, with the edge at the very same place.
pub(super) type Neighbours = Vec<[Option<u32>; 3]>;

/// Refuses triangles given twice, edges of more than two triangles and flipped neighbours.
pub(super) fn neighbours(name: &str, drawn: &[Drawn], places: &Places) -> Result<Neighbours> {
    check_repeated(name, drawn)?;
    let halves = half_edges(drawn.iter().map(|d| d.corners));
    let mut neighbours = vec![[None; 3]; drawn.len()];
    for run in halves.chunk_by(|a, b| a.key == b.key) {
        let index = |h: &HalfEdge| drawn[h.triangle as usize].index;
        let middle = |h: &HalfEdge| -> Place {
            let corners = &drawn[h.triangle as usize].corners;
            let [a, b] = [h.edge as usize, (h.edge as usize + 1) % 3].map(|k| corners[k]);
            let [a, b] = [places.at(a), places.at(b)];
            [0, 1, 2].map(|k| 0.5 * (a[k] + b[k])).into()
        };
        match run {
            [_] => {}
            [a, b] if a.forward != b.forward => {
                if a.at == b.at {
                    neighbours[a.triangle as usize][a.edge as usize] = Some(b.triangle);
                    neighbours[b.triangle as usize][b.edge as usize] = Some(a.triangle);
                }
            }
            [a, b] => {
                let why = format!(
                    "triangles {} and {} meet in an edge at {} but put the fluid on opposite sides: one of them is \
                     flipped",
                    index(a),
                    index(b),
                    middle(a)
                );
                return Err(BoundaryError::of_part(name, why));
            }
            more => {
                let why = format!(
                    "{} triangles meet in one edge at {}, the first is {}: the surface is not a manifold there, draw \
                     the bodies as walls of their own",
                    more.len(),
                    middle(&more[0]),
                    index(&more[0])
                );
                return Err(BoundaryError::of_part(name, why));
            }
        }
    }
    Ok(neighbours)
}

fn check_repeated(name: &str, drawn: &[Drawn]) -> Result<()> {
    let key = |(t, d): (usize, &Drawn)| {
        let mut sorted = d.corners;
        sorted.sort_unstable();
        (sorted.map(|c| c.moved_back(sorted[0].image)), t as u32)
    };
    let mut keys: Vec<([Site; 3], u32)> = drawn.iter().enumerate().map(key).collect();
    keys.par_sort_unstable();
    let Some(pair) = keys.windows(2).find(|pair| pair[0].0 == pair[1].0) else {
        return Ok(());
    };
    let [a, b] = [&drawn[pair[0].1 as usize], &drawn[pair[1].1 as usize]];
    if dot(a.normal, b.normal) <= 0.0 {
        return Err(no_thickness(name, [a, b], a.places[0]));
    }
    let (a, b, at) = (a.index, b.index, Place::from(a.places[0]));
    let why = format!("triangles {a} and {b} at {at} have the same corners");
    Err(BoundaryError::of_part(name, why))
}

/// Two faces of a wall on each other, with opposite normals.
pub(super) fn no_thickness(wall: &str, [a, b]: [&Drawn; 2], at: Point) -> BoundaryError {
    let (a, b, at) = (a.index, b.index, Place::from(at));
    let why = format!(
        "triangles {a} and {b} lie on each other near {at} with opposite normals: give the plate a thickness, or draw \
         bodies that touch as walls of their own"
    );
    BoundaryError::of_part(wall, why)
}

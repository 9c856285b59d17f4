//! Surfaces as drawn, and their triangles with the corners welded.

use super::places::{HalfEdge, Places, Site, half_edges};
use crate::error::BoundaryError;
use crate::geometry::vector::{Point, bounds, dot, double_area, norm, sub};
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
    /// Corners of the triangles among the points; the normal by the right-hand rule points into
    /// the fluid.
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

/// A triangle as drawn.
pub(super) struct Drawn {
    pub wall: usize,
    /// Its number in the wall.
    pub index: usize,
    pub corners: [Site; 3],
    pub places: [Point; 3],
    pub area: f64,
    pub normal: Point,
}

/// Coordinates that are not finite and corners that do not exist.
pub(super) fn check_input(surface: &Surface) -> Result<(), BoundaryError> {
    let wall = || surface.name.clone();
    if surface.triangles.is_empty() {
        return Err(BoundaryError::unfit(wall(), "has no triangle"));
    }
    let finite = |p: &Point| p.iter().all(|x| x.is_finite());
    if let Some(point) = surface.points.iter().position(|p| !finite(p)) {
        return Err(BoundaryError::NotFinite {
            wall: wall(),
            point,
        });
    }
    let count = surface.points.len();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        if let Some(point) = corners.iter().find(|c| **c as usize >= count) {
            return Err(BoundaryError::MissingPoint {
                wall: wall(),
                triangle,
                point: *point,
                count,
            });
        }
    }
    Ok(())
}

/// Surfaces of the size of a particle and walls of too many elements.
pub(super) fn check_extent(surfaces: &[Surface], spacing: f64) -> Result<(), BoundaryError> {
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
        Some(most) if estimate > MOST_ELEMENTS as f64 => Err(BoundaryError::TooManyElements {
            wall: surfaces[most].name.clone(),
            own: needs[most] as u64,
            estimate: estimate as u64,
            limit: MOST_ELEMENTS,
        }),
        _ => Ok(()),
    }
}

/// Welds the corners of a wall and checks every triangle by itself.
pub(super) fn weld(
    surface: &Surface,
    wall: usize,
    group: usize,
    places: &mut Places,
) -> Result<Vec<Drawn>, BoundaryError> {
    // In the order of the points: the first of those at one place sets the place of its node.
    let mut used = vec![false; surface.points.len()];
    for corner in surface.triangles.iter().flatten() {
        used[*corner as usize] = true;
    }
    let nowhere = Site {
        id: u32::MAX,
        image: [0; 3],
    };
    let points = surface.points.iter().zip(used);
    let sites: Vec<Site> = points
        .map(|(p, used)| {
            if used {
                places.find(*p, group)
            } else {
                nowhere
            }
        })
        .collect();
    let mut drawn = Vec::with_capacity(surface.triangles.len());
    for (index, corners) in surface.triangles.iter().enumerate() {
        let corners = corners.map(|c| sites[c as usize]);
        let at = corners.map(|c| places.at(c));
        let double = double_area(at);
        let area = 0.5 * norm(double);
        let side = |i: usize| norm(sub(at[(i + 1) % 3], at[i]));
        let edge = side(0).max(side(1)).max(side(2));
        let name = || surface.name.clone();
        let [a, b, c] = corners;
        if a == b || b == c || c == a || area < NO_AREA * edge * edge {
            return Err(BoundaryError::NoArea {
                wall: name(),
                triangle: index,
                at: at[0].into(),
            });
        }
        let altitude = 2.0 * area / edge;
        if altitude < NEEDLE * edge {
            return Err(BoundaryError::Needle {
                wall: name(),
                triangle: index,
                at: at[0].into(),
                altitude,
                edge,
            });
        }
        drawn.push(Drawn {
            wall,
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
pub(super) fn neighbours(
    name: &str,
    drawn: &[Drawn],
    places: &Places,
) -> Result<Neighbours, BoundaryError> {
    check_repeated(name, drawn)?;
    let halves = half_edges(drawn.iter().map(|d| d.corners));
    let mut neighbours = vec![[None; 3]; drawn.len()];
    for run in halves.chunk_by(|a, b| a.key == b.key) {
        let index = |h: &HalfEdge| drawn[h.triangle as usize].index;
        let middle = |h: &HalfEdge| -> Point {
            let corners = &drawn[h.triangle as usize].corners;
            let [a, b] = [h.edge as usize, (h.edge as usize + 1) % 3].map(|k| corners[k]);
            let [a, b] = [places.at(a), places.at(b)];
            std::array::from_fn(|k| 0.5 * (a[k] + b[k]))
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
                return Err(BoundaryError::Flipped {
                    wall: name.into(),
                    triangle: index(a),
                    other: index(b),
                    at: middle(a).into(),
                });
            }
            more => {
                return Err(BoundaryError::NotManifold {
                    wall: name.into(),
                    triangle: index(&more[0]),
                    count: more.len(),
                    at: middle(&more[0]).into(),
                });
            }
        }
    }
    Ok(neighbours)
}

fn check_repeated(name: &str, drawn: &[Drawn]) -> Result<(), BoundaryError> {
    let mut keys: Vec<([Site; 3], u32)> = drawn
        .iter()
        .enumerate()
        .map(|(t, d)| {
            let mut sorted = d.corners;
            sorted.sort_unstable();
            (sorted.map(|c| c.moved_back(sorted[0].image)), t as u32)
        })
        .collect();
    keys.par_sort_unstable();
    let Some(pair) = keys.windows(2).find(|pair| pair[0].0 == pair[1].0) else {
        return Ok(());
    };
    let [a, b] = [&drawn[pair[0].1 as usize], &drawn[pair[1].1 as usize]];
    let (wall, triangle, other, at) = (name.into(), a.index, b.index, a.places[0].into());
    Err(match dot(a.normal, b.normal) > 0.0 {
        true => BoundaryError::Repeated {
            wall,
            triangle,
            other,
            at,
        },
        false => BoundaryError::NoThickness {
            wall,
            triangle,
            other,
            at,
        },
    })
}

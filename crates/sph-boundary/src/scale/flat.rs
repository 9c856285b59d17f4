//! Flat faces of walls whose scales multiply.

use sph_core::Vect;
use sph_neighbours::Domain;

use crate::scale::plane::{PlaneScale, fade};
use crate::{Element, WallMesh};

/// Cosine of the angle between normals up to which faces are square to each other.
const SQUARE: f64 = 1e-6;
/// Length over which the scale of a face goes on beyond its end, over h.
const BEYOND: f64 = 1.0;

/// A flat face, in the place where it was drawn.
#[derive(Clone, Debug)]
pub(crate) struct FlatFace<const D: usize> {
    /// Unit normal into the fluid.
    pub normal: Vect<D>,
    /// A place on it, m.
    pub place: Vect<D>,
    /// Area, m^(D−1).
    pub measure: f64,
    /// Its walls, ascending.
    pub walls: Vec<u32>,
    /// Directions along it, with half its length there, m; infinite where it goes on through a period.
    spans: Vec<(Vect<D>, f64)>,
}

impl<const D: usize> FlatFace<D> {
    /// True if an element is on its plane.
    fn has(&self, element: &Element<D>, size: f64) -> bool {
        let same = (Vect::from(element.normal) - self.normal).norm() < SQUARE;
        let apart = Vect::from(element.centre) - self.place;
        same && apart.dot(&self.normal).abs() < SQUARE * size
    }

    /// ln s of it alone, and its gradient, 1/m, at a place relative to its own; beyond its ends it fades out.
    pub fn at(&self, apart: &Vect<D>, plane: &PlaneScale, h: f64) -> Option<(f64, Vect<D>)> {
        let height = apart.dot(&self.normal);
        if height >= super::plane::REACH * h {
            return None;
        }
        let [mut value, slope] = plane.at(height / h);
        let mut gradient = self.normal * (slope / h);
        for (along, half) in &self.spans {
            let way = apart.dot(along);
            let beyond = (way.abs() - half) / (BEYOND * h);
            if beyond >= 1.0 {
                return None;
            }
            if beyond > 0.0 {
                let [share, change] = fade(beyond);
                let change = change / (BEYOND * h) * way.signum();
                gradient = gradient * share + along * (value * change);
                value *= share;
            }
        }
        Some((value, gradient))
    }
}

/// The faces of a mesh whose scales multiply: all of the mesh is on the fluid's side of each, and any two are square to each
/// other or face each other. Largest first; and which elements are on none of them.
pub(crate) fn flat_faces<const D: usize, M: WallMesh<D>>(
    mesh: &M,
    domain: &Domain<D>,
    size: f64,
) -> (Vec<FlatFace<D>>, Vec<bool>) {
    let nodes = mesh.places();
    let elements = mesh.elements();
    let mut faces: Vec<FlatFace<D>> = Vec::new();
    let mut face_of: Vec<usize> = Vec::with_capacity(elements.len());
    for element in elements {
        // Neighbours in a mesh are on the same face more often than not.
        let known = faces.iter().rposition(|face| face.has(element, size));
        let face = known.unwrap_or_else(|| {
            faces.push(FlatFace {
                normal: element.normal.into(),
                place: element.centre.into(),
                measure: 0.0,
                walls: Vec::new(),
                spans: Vec::new(),
            });
            faces.len() - 1
        });
        faces[face].measure += element.measure;
        if let Err(place) = faces[face].walls.binary_search(&(element.wall as u32)) {
            faces[face].walls.insert(place, element.wall as u32);
        }
        face_of.push(face);
        if faces.len() > MOST {
            break;
        }
    }
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|a, b| faces[*b].measure.total_cmp(&faces[*a].measure));
    let mut chosen: Vec<usize> = Vec::new();
    for face in order.into_iter().filter(|_| faces.len() <= MOST) {
        let own = &faces[face];
        let square = |other: &usize| {
            let cosine = own.normal.dot(&faces[*other].normal);
            let apart = own.normal.dot(&(faces[*other].place - own.place));
            cosine.abs() < SQUARE || (cosine < SQUARE - 1.0 && apart > SQUARE * size)
        };
        let before = |x: &Vect<D>| own.normal.dot(&(x - own.place)) >= -SQUARE * size;
        if chosen.iter().all(square) && nodes.iter().all(before) {
            chosen.push(face);
        }
    }
    let on_none = match faces.len() <= MOST {
        true => face_of.iter().map(|f| !chosen.contains(f)).collect(),
        false => vec![true; elements.len()],
    };
    let found = chosen.iter().map(|face| {
        let own = elements.iter().zip(&face_of).filter(|(_, f)| *f == face);
        let corners = own.flat_map(|(e, _)| unrolled(e, &nodes, domain));
        spanned(faces[*face].clone(), &corners.collect::<Vec<_>>(), domain)
    });
    (found.collect(), on_none)
}

/// Faces beyond which a mesh is curved.
const MOST: usize = 400;

/// Corners of an element, m. It may go on beyond a periodic border, where its node is that of the other side.
pub(crate) fn unrolled<const D: usize>(
    element: &Element<D>,
    nodes: &[Vect<D>],
    domain: &Domain<D>,
) -> [Vect<D>; D] {
    let centre = Vect::from(element.centre);
    let place = |n: usize| centre + domain.nearest(nodes[n] - centre);
    element.nodes.map(place)
}

/// A face with its place in the middle of its corners, and its spans.
fn spanned<const D: usize>(
    mut face: FlatFace<D>,
    corners: &[Vect<D>],
    domain: &Domain<D>,
) -> FlatFace<D> {
    let mut spans: Vec<Vect<D>> = Vec::new();
    // The axes that are flattest on it first.
    let mut axes: Vec<usize> = (0..D).collect();
    axes.sort_by(|a, b| face.normal[*a].abs().total_cmp(&face.normal[*b].abs()));
    for axis in axes {
        let mut along = Vect::<D>::from_fn(|k, _| f64::from(u8::from(k == axis)));
        along -= face.normal * face.normal[axis];
        for other in &spans {
            along -= other * other.dot(&along);
        }
        if spans.len() + 1 < D && along.norm() > SQUARE {
            spans.push(along.normalize());
        }
    }
    let from = face.place;
    for along in spans {
        let ways = || corners.iter().map(|c| (c - from).dot(&along));
        let low = ways().fold(f64::INFINITY, f64::min);
        let high = ways().fold(f64::NEG_INFINITY, f64::max);
        let mut period = (0..D).filter(|k| domain.periodic[*k] && along[*k].abs() > 1.0 - SQUARE);
        let half = match period.any(|k| high - low > domain.length(k) * (1.0 - SQUARE)) {
            true => f64::INFINITY,
            false => 0.5 * (high - low),
        };
        face.place += along * (0.5 * (low + high));
        face.spans.push((along, half));
    }
    face
}

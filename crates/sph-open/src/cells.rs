//! Elements of a face of the size of a particle, each with a port.

use std::collections::HashMap;

use sph_core::Vect;
use sph_neighbours::WallSet;

use crate::FaceElement;

/// Normals and areas that differ relatively by less are the same.
const SAME: f64 = 1e-6;

/// An element of a face: in the plane one of the walls', in space mostly two triangles that make a square.
///
/// The rows in front of a face and the ports on it then stand as the particles of a lattice do. A triangle of half a square
/// would give birth to every second row, beside its other half at the same time.
pub(crate) struct Cell<const D: usize> {
    /// Elements of the walls.
    pub elements: Vec<u32>,
    pub place: FaceElement<D>,
}

/// The elements of a face, in the order of the walls'.
pub(crate) fn cells<const D: usize>(walls: &WallSet<D>, face: &str) -> Vec<Cell<D>> {
    let elements = &walls.elements;
    let own = |s: &u32| walls.names[elements.wall[*s as usize] as usize] == face;
    let own: Vec<u32> = (0..elements.centre.len() as u32).filter(own).collect();
    let pairs = match D {
        2 => own.iter().map(|s| vec![*s]).collect(),
        _ => paired(walls, &own),
    };
    let mut cells: Vec<Cell<D>> = pairs.into_iter().map(|p| cell(walls, p)).collect();
    if D == 2 {
        along_a_line(&mut cells);
    } else if let Some(rectangle) = Rectangle::around(walls, &own) {
        for cell in &mut cells {
            let [s, t] = rectangle.at(&cell.place.centre);
            (cell.place.along, cell.place.across) = (s, t);
            cell.place.rectangle = Some(rectangle.sides);
        }
    }
    cells
}

fn cell<const D: usize>(walls: &WallSet<D>, own: Vec<u32>) -> Cell<D> {
    let elements = &walls.elements;
    let measure: f64 = own.iter().map(|s| elements.measure[*s as usize]).sum();
    let centre = match own[..] {
        [one] => elements.centre[one as usize],
        _ => {
            let one = |s: &u32| elements.centre[*s as usize] * elements.measure[*s as usize];
            own.iter().map(one).sum::<Vect<D>>() / measure
        }
    };
    let place = FaceElement {
        centre,
        normal: elements.normal[own[0] as usize],
        measure,
        along: 0.5,
        across: 0.5,
        rectangle: None,
    };
    Cell {
        elements: own,
        place,
    }
}

fn along_a_line<const D: usize>(cells: &mut [Cell<D>]) {
    let whole: f64 = cells.iter().map(|c| c.place.measure).sum();
    let mut before = 0.0;
    for cell in cells {
        let measure = cell.place.measure;
        cell.place.along = (before + 0.5 * measure) / whole;
        before += measure;
    }
}

/// Triangles of one plane by twos: those that share an edge, the nearest centres first. The two of a square have them nearer
/// than those of neighbouring squares.
fn paired<const D: usize>(walls: &WallSet<D>, own: &[u32]) -> Vec<Vec<u32>> {
    let elements = &walls.elements;
    let mut of_edge: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    let mut near: Vec<(f64, [u32; 2])> = Vec::new();
    for &s in own {
        let corners = elements.corners[s as usize];
        for k in 0..D {
            let [a, b] = [corners[k], corners[(k + 1) % D]];
            let beside = of_edge.entry([a.min(b), a.max(b)]).or_default();
            for &other in beside.iter() {
                let [one, two] = [other, s].map(|s| s as usize);
                if elements.normal[one].dot(&elements.normal[two]) > 1.0 - SAME {
                    let apart = elements.centre[one] - elements.centre[two];
                    near.push((apart.norm_squared(), [other, s]));
                }
            }
            beside.push(s);
        }
    }
    near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut other: HashMap<u32, u32> = HashMap::new();
    for (_, [one, two]) in near {
        if !other.contains_key(&one) && !other.contains_key(&two) {
            other.extend([(one, two), (two, one)]);
        }
    }
    let pair = |s: &u32| match other.get(s) {
        Some(with) if with < s => None,
        Some(with) => Some(vec![*s, *with]),
        None => Some(vec![*s]),
    };
    own.iter().filter_map(pair).collect()
}

/// A plane rectangle whose sides go along two axes of space, seen from the third: s and t go from 0 to 1 along the first and
/// the second of them.
struct Rectangle<const D: usize> {
    axes: [Vect<D>; 2],
    from: [f64; 2],
    sides: [f64; 2],
}

impl<const D: usize> Rectangle<D> {
    /// The one that the elements fill, if they do.
    fn around(walls: &WallSet<D>, own: &[u32]) -> Option<Self> {
        let elements = &walls.elements;
        let normal = elements.normal[*own.first()? as usize];
        let flat = |s: &u32| elements.normal[*s as usize].dot(&normal) > 1.0 - SAME;
        if !own.iter().all(flat) {
            return None;
        }
        let steepest = (0..D).max_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs()))?;
        let first = (0..D).find(|k| *k != steepest)?;
        let second = (0..D).rev().find(|k| *k != steepest)?;
        let in_plane = |axis: usize| {
            let unit = Vect::<D>::from_fn(|k, _| if k == axis { 1.0 } else { 0.0 });
            unit - normal * normal[axis]
        };
        let u = in_plane(first).normalize();
        let v = in_plane(second);
        let axes = [u, (v - u * v.dot(&u)).normalize()];
        let (mut from, mut to) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let corners = own.iter().flat_map(|s| elements.corners[*s as usize]);
        for corner in corners {
            for (k, axis) in axes.iter().enumerate() {
                let x = walls.points.position[corner as usize].dot(axis);
                (from[k], to[k]) = (from[k].min(x), to[k].max(x));
            }
        }
        let sides = [to[0] - from[0], to[1] - from[1]];
        let area: f64 = own.iter().map(|s| elements.measure[*s as usize]).sum();
        let filled = (area - sides[0] * sides[1]).abs() <= SAME * area;
        filled.then_some(Rectangle { axes, from, sides })
    }

    fn at(&self, place: &Vect<D>) -> [f64; 2] {
        [0, 1].map(|k| (place.dot(&self.axes[k]) - self.from[k]) / self.sides[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_neighbours::{Elements, WallPoints};

    /// Two squares and a triangle in a plane, as walls are cut.
    fn strip() -> WallSet<3> {
        let rows = [
            [0.0, 1.0, 2.0].map(|x| [x, 0.0]),
            [0.0, 1.0, 2.0].map(|x| [x, 1.0]),
        ];
        let corners = rows.into_iter().flatten().chain([[3.0, 0.0]]);
        let position: Vec<_> = corners.map(|[x, y]| Vect::<3>::new(x, y, 0.5)).collect();
        let corners = vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 6, 5]];
        let middle = |c: &[u32; 3]| c.iter().map(|c| position[*c as usize]).sum::<Vect<3>>() / 3.0;
        WallSet {
            names: vec!["face".into()],
            elements: Elements {
                centre: corners.iter().map(middle).collect(),
                normal: vec![Vect::<3>::new(0.0, 0.0, 1.0); 5],
                measure: vec![0.5; 5],
                wall: vec![0; 5],
                corners,
                ..Elements::default()
            },
            points: WallPoints {
                position,
                ..WallPoints::default()
            },
            ..WallSet::default()
        }
    }

    #[test]
    fn triangles_of_a_square_are_one_element() {
        let cells = cells(&strip(), "face");
        let own: Vec<_> = cells.iter().map(|c| c.elements.clone()).collect();
        assert_eq!(own, [vec![0, 1], vec![2, 3], vec![4]]);
        assert!((cells[1].place.centre - Vect::<3>::new(1.5, 0.5, 0.5)).norm() < 1e-15);
        assert_eq!(cells[1].place.measure, 1.0);
        // A trapezium is no rectangle.
        assert_eq!(cells[0].place.rectangle, None);
    }

    #[test]
    fn a_rectangle_has_coordinates() {
        let mut walls = strip();
        walls.elements.wall[4] = 1;
        walls.names.push("other".into());
        let cells = cells(&walls, "face");
        let at = cells.iter().map(|c| [c.place.along, c.place.across]);
        let at: Vec<_> = at.collect();
        assert_eq!(at, [[0.25, 0.5], [0.75, 0.5]]);
        assert_eq!(cells[0].place.rectangle, Some([2.0, 1.0]));
    }
}

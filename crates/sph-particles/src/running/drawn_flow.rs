//! Data of a flow for pictures: columns, places, walls.

use std::collections::BTreeMap;

use sph_core::Plain;
use sph_neighbours::World;
use sph_solver::Flow;

/// A place in three dimensions.
pub fn padded<const D: usize>(x: &sph_core::Vect<D>) -> [f64; 3] {
    std::array::from_fn(|k| if k < D { x[k] } else { 0.0 })
}

/// A column with its label, vectors by their lengths; `None` if the scene does not have it.
pub fn column_of<const D: usize>(flow: &Flow<D>, name: &str) -> Option<(String, Vec<f64>)> {
    let found = flow.world.free.columns().find(|(n, ..)| *n == name);
    let (_, unit, _, components, values) = found?;
    let values: Vec<f64> = match values {
        Plain::Index(v) => v.iter().map(|x| f64::from(*x)).collect(),
        Plain::Real(v) if components == 1 => v.into_owned(),
        Plain::Real(v) => {
            let length = |c: &[f64]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.chunks(components).map(length).collect()
        }
    };
    let label = match unit {
        "1" => name.replace('_', " "),
        unit => format!("{} [{unit}]", name.replace('_', " ")),
    };
    Some((label, values))
}

/// The walls as lines.
pub fn drawn_walls<const D: usize>(world: &World<D>) -> Vec<[[f64; 3]; 2]> {
    // A line whose ends are a period apart is drawn at neither side.
    let longest = 3.0 * world.spacing;
    let points = &world.walls.points.position;
    let lines = wall_lines(world).into_iter();
    let lines = lines.map(|ends| ends.map(|c| padded(&points[c as usize])));
    let short = lines.filter(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1]) < longest);
    short.collect()
}

/// Cosine of the angle, 20°, beyond which two elements make an edge.
const SMOOTH: f64 = 0.94;

/// Corner points of the lines: all segments in the plane; in space the edges of which only one
/// element is there, or two whose normals differ by more than 20°.
pub fn wall_lines<const D: usize>(world: &World<D>) -> Vec<[u32; 2]> {
    let elements = &world.walls.elements;
    if D == 2 {
        return elements.corners.iter().map(|c| [c[0], c[1]]).collect();
    }
    let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (s, corners) in elements.corners.iter().enumerate() {
        for k in 0..D {
            let (a, b) = (corners[k], corners[(k + 1) % D]);
            sides.entry([a.min(b), a.max(b)]).or_default().push(s);
        }
    }
    let shows = |sides: &[usize]| match sides {
        [a, b] => elements.normal[*a].dot(&elements.normal[*b]) < SMOOTH,
        _ => true,
    };
    let lines = sides.iter().filter(|(_, sides)| shows(sides));
    lines.map(|(edge, _)| *edge).collect()
}

//! Data of a flow for pictures: columns, places, walls.

use sph_core::Plain;
use sph_neighbours::World;
use sph_solver::Flow;

use crate::running::edges::wall_lines;

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
        Plain::Real(v) => v
            .chunks(components)
            .map(|c| c.iter().map(|x| x * x).sum::<f64>().sqrt())
            .collect(),
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
    wall_lines(world)
        .into_iter()
        .map(|ends| ends.map(|c| padded(&points[c as usize])))
        .filter(|[a, b]| (a[0] - b[0]).hypot(a[1] - b[1]) < longest)
        .collect()
}

//! Particles and walls: pieces of a frame, and columns, places and lines of a picture.

use std::collections::BTreeMap;

use sph_core::{Plain, Store, Vect, fields, labelled};
use sph_io::{Cells, FieldData, FieldValues, Location, Piece};
use sph_neighbours::World;
use sph_neighbours::decomposition::OWNER;
use sph_scene::Scene;
use sph_solver::Flow;

use crate::failure::error::RunError;
use crate::zones::Level;

/// The places of the particles.
pub(crate) fn points<const D: usize>(flow: &Flow<D>) -> Result<Vec<[f64; 3]>, RunError> {
    let position = flow.world.free.get(fields::POSITION)?;
    Ok(position.iter().map(padded).collect())
}

/// A vector field padded to three components.
fn vectors<const D: usize>(
    name: &'static str,
    unit: &'static str,
    values: &[Vect<D>],
) -> FieldData<'static> {
    FieldData {
        name: name.into(),
        unit: unit.into(),
        location: Location::Point,
        components: 3,
        data: FieldValues::F64(values.iter().flat_map(padded).collect()),
    }
}

/// The particles of a store with the columns that are `wanted`.
pub(crate) fn particles<'a, const D: usize>(
    free: &'a Store<D>,
    points: &'a [[f64; 3]],
    wanted: impl Fn(&str) -> bool,
) -> Piece<'a> {
    let mut data = Vec::new();
    for (name, unit, _, components, values) in free.columns() {
        let always = name == fields::IDENTITY.name || name == fields::PHASE.name;
        if name == fields::POSITION.name || !(always || wanted(name)) {
            continue;
        }
        data.push(match values {
            Plain::Index(v) => FieldData::integer(name, v.to_vec()),
            Plain::Real(v) if components == 1 => FieldData::scalar(name, unit, v.into_owned()),
            Plain::Real(v) if components != D => {
                FieldData::tensor(name, unit, components, v.into_owned())
            }
            Plain::Real(v) => {
                let all = v.chunks_exact(D).map(Vect::<D>::from_column_slice);
                vectors(name, unit, &all.collect::<Vec<_>>())
            }
        });
    }
    Piece {
        name: "fluid".into(),
        points: points.into(),
        cells: Cells::Vertices,
        fields: data,
    }
}

/// The particles of a rank that are its own.
pub(crate) fn own_particles<const D: usize>(
    flow: &Flow<D>,
    wanted: impl Fn(&str) -> bool,
) -> Result<Piece<'static>, RunError> {
    let owned = flow.world.owned();
    let own: Vec<bool> = (0..flow.world.free.len()).map(|k| owned.has(k)).collect();
    some_particles(flow, "fluid", &own, |name| {
        name != OWNER.name && wanted(name)
    })
}

/// The particles of a zone that are in its shape.
pub(crate) fn zone_particles<const D: usize>(
    level: &Level<D>,
    wanted: impl Fn(&str) -> bool,
) -> Result<Piece<'static>, RunError> {
    let flow = &level.stepper.parts.flow;
    let position = flow.world.free.get(fields::POSITION)?;
    let frame = level.frame();
    let inside = position.iter().map(|x| frame.holds(x, 0.0));
    let inside: Vec<bool> = inside.collect();
    some_particles(flow, &format!("zone-{}", level.name), &inside, wanted)
}

fn some_particles<const D: usize>(
    flow: &Flow<D>,
    name: &str,
    chosen: &[bool],
    wanted: impl Fn(&str) -> bool,
) -> Result<Piece<'static>, RunError> {
    let all = points(flow)?;
    let piece = particles(&flow.world.free, &all, wanted);
    let fields = piece.fields.into_iter();
    Ok(Piece {
        name: name.to_string().into(),
        points: kept(&piece.points, 1, chosen).into(),
        cells: Cells::Vertices,
        fields: fields.map(|f| kept_field(f, chosen)).collect(),
    })
}

fn kept_field(field: FieldData<'_>, own: &[bool]) -> FieldData<'static> {
    let each = field.components;
    FieldData {
        name: field.name.into_owned().into(),
        unit: field.unit.into_owned().into(),
        location: field.location,
        components: each,
        data: match field.data {
            FieldValues::F64(v) => FieldValues::F64(kept(&v, each, own).into()),
            FieldValues::U32(v) => FieldValues::U32(kept(&v, each, own).into()),
            FieldValues::I64(v) => FieldValues::I64(kept(&v, each, own).into()),
        },
    }
}

/// The tuples of `each` numbers whose particle is kept.
fn kept<T: Copy>(values: &[T], each: usize, own: &[bool]) -> Vec<T> {
    let tuples = values.chunks_exact(each).zip(own);
    let tuples = tuples.filter(|(_, own)| **own).map(|(tuple, _)| tuple);
    tuples.flatten().copied().collect()
}

/// Writes the share of a rank behind the first of output `index`.
pub(crate) fn write_own_share<const D: usize>(
    scene: &Scene,
    flow: &Flow<D>,
    folder: &std::path::Path,
    (index, rank): (usize, usize),
) -> Result<(), RunError> {
    let wanted = |name: &str| scene.output.fields.iter().any(|f| f == name);
    let piece = own_particles(flow, wanted)?;
    let below = folder.join("fields");
    sph_io::write_share(below, &piece, (index, rank), flow.world.time)?;
    Ok(())
}

/// The walls, if there are any.
pub(crate) fn walls<const D: usize>(world: &World<D>) -> Option<Piece<'_>> {
    let walls = &world.walls;
    if walls.is_empty() {
        return None;
    }
    let p = &walls.points;
    let mut data = vec![
        FieldData::scalar("pressure", "Pa", &p.pressure[..]),
        FieldData::scalar("share", "1", &p.share[..]),
        vectors("velocity", "m/s", &p.velocity),
        FieldData::integer("wall", &p.wall[..]),
    ];
    let elements = &walls.elements;
    let cells = match D {
        2 if !elements.corners.is_empty() => {
            data.push(vectors("normal", "1", &elements.normal).at_cells());
            let pressure = FieldData::scalar("element_pressure", "Pa", &elements.pressure[..]);
            data.push(pressure.at_cells());
            let segments = elements.corners.iter().map(|c| [c[0], c[1]]);
            Cells::Segments(segments.collect())
        }
        _ => Cells::Vertices,
    };
    let points: Vec<[f64; 3]> = p.position.iter().map(padded).collect();
    Some(Piece {
        name: "walls".into(),
        points: points.into(),
        cells,
        fields: data,
    })
}

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
    Some((labelled(&name.replace('_', " "), unit), values))
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
fn wall_lines<const D: usize>(world: &World<D>) -> Vec<[u32; 2]> {
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

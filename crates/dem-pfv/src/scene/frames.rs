//! Fields of grains; spheres, contacts, pores and throats as files for ParaView, and pictures of spheres.

use std::path::Path;

use nalgebra::Matrix3;
use sph_core::{bounds, labelled};
use sph_io::{Cells, FieldData, Picture, Piece, View};

use crate::coupled::CoupledSystem;
use crate::flow::Throat;
use crate::grains::{GrainSystem, Partner, Touch, Vector, Wall, strains};
use crate::scene::{DemError, Model, Origin};
use crate::sphere;
use crate::triangulation::Vertex;

/// Everything at one time: `spheres`, `contacts`, and with a fluid `pores` and `throats`.
pub fn pieces(model: &Model, origin: &Origin) -> Vec<Piece<'static>> {
    let mut all = vec![spheres(model, origin), contacts(model.grains())];
    if let Some(system) = model.wet() {
        all.extend([pores(system), throats(system)]);
    }
    all
}

fn points(system: &GrainSystem) -> Vec<[f64; 3]> {
    let all = system.grains.position.iter();
    all.map(|x| (*x).into()).collect()
}

fn at_cells(name: &'static str, unit: &'static str, values: Vec<f64>) -> FieldData<'static> {
    FieldData::scalar(name, unit, values).at_cells()
}

/// One point per grain; scale glyphs by `radius`.
fn spheres(model: &Model, origin: &Origin) -> Piece<'static> {
    let system = model.grains();
    let vector = |name: &'static str, unit: &'static str, all: &[Vector]| {
        let all: Vec<f64> = all.iter().flatten().copied().collect();
        FieldData::tensor(name, unit, 3, all)
    };
    let mut fields = vec![
        vector("velocity", "m/s", &system.grains.velocity),
        vector("spin", "1/s", &system.grains.spin),
        vector("shift", "m", &displacements(system, origin)),
    ];
    let names = names(model.wet().is_some());
    fields.extend(names.map(|n| FieldData::scalar(n, unit(n), values(n, model, origin))));
    let numbers: Vec<_> = (0..system.grains.len() as u32).collect();
    fields.push(FieldData::integer("grain", numbers));
    Piece {
        name: "spheres".into(),
        points: points(system).into(),
        cells: Cells::Vertices,
        fields,
    }
}

/// A line from centre to centre, or from the centre to the wall; the size of the force on it.
fn contacts(system: &GrainSystem) -> Piece<'static> {
    let mut ends = Vec::new();
    let (mut normal, mut shear, mut wall) = (Vec::new(), Vec::new(), Vec::new());
    let all = &system.grains;
    for touch in system.contacts() {
        let from = all.position[touch.grain];
        // The nearest image, which lies across the end of a periodic axis or does not.
        let to = match touch.partner {
            Partner::Grain(other) => {
                from - touch.normal * (all.radius[touch.grain] + all.radius[other] - touch.overlap)
            }
            _ => touch.point,
        };
        ends.extend([from, to].map(<[f64; 3]>::from));
        let along = touch.force.dot(&touch.normal);
        normal.push(along);
        shear.push((touch.force - touch.normal * along).norm());
        wall.push(u32::from(!matches!(touch.partner, Partner::Grain(_))));
    }
    let lines = (0..ends.len() as u32 / 2).map(|k| [2 * k, 2 * k + 1]);
    let lines: Vec<[u32; 2]> = lines.collect();
    Piece {
        name: "contacts".into(),
        points: ends.into(),
        cells: Cells::Segments(lines.into()),
        fields: vec![
            at_cells("normal_force", "N", normal),
            at_cells("shear_force", "N", shear),
            FieldData::integer("at_wall", wall).at_cells(),
        ],
    }
}

/// Tetrahedra between four grains; a vertex that is a wall is put on it, below the mean of the grains.
fn pores(system: &CoupledSystem) -> Piece<'static> {
    let mesh = &system.pores().mesh;
    let mut places = points(system.grains());
    let mut cells = Vec::new();
    for cell in &mesh.cells {
        let mean = mesh.middle(cell);
        cells.push(cell.vertices().map(|v| match v {
            Vertex::Sphere(k) => k as u32,
            Vertex::Wall(w) => {
                places.push(mesh.walls[w].projection(mean).into());
                places.len() as u32 - 1
            }
        }));
    }
    let rates = system.rates.iter().zip(&system.volumes);
    let rates = rates.map(|(rate, volume)| rate / volume);
    Piece {
        name: "pores".into(),
        points: places.into(),
        cells: Cells::Tetrahedra(cells.into()),
        fields: vec![
            at_cells("pressure", "Pa", system.pressures.to_vec()),
            at_cells("volume", "m³", system.volumes.to_vec()),
            at_cells("void", "m³", system.pores().void_volumes.to_vec()),
            at_cells("strain_rate", "1/s", rates.collect()),
        ],
    }
}

/// A line between the places of two pores, with the conductance of the throat between them.
fn throats(system: &CoupledSystem) -> Piece<'static> {
    let places = system.pores().middles().into_iter().map(<[f64; 3]>::from);
    let all = &system.pores().throats;
    let lines: Vec<[u32; 2]> = all.iter().map(|t| t.cells.map(|c| c as u32)).collect();
    let pressure = |cell: usize| system.pressures[cell];
    let difference = |t: &Throat| pressure(t.cells[0]) - pressure(t.cells[1]);
    let radii = all.iter().map(|t| t.hydraulic_radius());
    let radii = radii.map(|r| if r.is_finite() { r } else { 0.0 });
    let areas = all.iter().map(|t| t.fluid_area);
    Piece {
        name: "throats".into(),
        points: places.collect::<Vec<_>>().into(),
        cells: Cells::Segments(lines.into()),
        fields: vec![
            at_cells(
                "pressure_difference",
                "Pa",
                all.iter().map(difference).collect(),
            ),
            at_cells("hydraulic_radius", "m", radii.collect()),
            at_cells("fluid_area", "m²", areas.collect()),
        ],
    }
}

/// A picture of the spheres seen along y, coloured by a field; a grain may be ringed.
pub fn picture(
    model: &Model,
    origin: &Origin,
    field: &str,
    range: Option<[f64; 2]>,
    title: &str,
    ring: Option<[f64; 3]>,
    path: &Path,
) -> Result<(), DemError> {
    let system = model.grains();
    let points = points(system);
    let values = values(field, model, origin);
    let diameters: Vec<f64> = system.grains.radius.iter().map(|r| 2.0 * r).collect();
    let label = labelled(&field.replace('_', " "), unit(field));
    let walls = walls(system, &points);
    let picture = Picture {
        title,
        time: Some(system.time),
        label: &label,
        diameter: origin.diameter,
        diameters: &diameters,
        walls: &walls,
        view: View::Front,
        range,
        ring,
        ..Picture::new(&points, &values)
    };
    Ok(picture.save(path)?)
}

/// Walls beyond this place are not there any more, m.
const FAR_ENOUGH: f64 = 5e3;

/// Walls across x and z as lines around the contents.
fn walls(system: &GrainSystem, points: &[[f64; 3]]) -> Vec<[[f64; 3]; 2]> {
    let largest = system.grains.largest_radius();
    let there = |x: &f64| x.abs() < FAR_ENOUGH;
    let ends = |axis: usize| {
        let all = points.iter().map(|p| p[axis]).filter(|x| x.is_finite());
        let [[low], [high]] = bounds(all.map(|x| [x]));
        let across = system.walls.iter().filter(|w| w.normal[axis].abs() > 0.99);
        let walls = across.map(|w| w.point[axis]).filter(there);
        let [[from], [to]] = bounds(walls.chain([low - largest, high + largest]).map(|x| [x]));
        (from, to)
    };
    let (x, z) = (ends(0), ends(2));
    let standing = |w: &&Wall| w.normal.y.abs() < 0.01 && there(&w.point.amax());
    let line = |w: &Wall| {
        let p = w.point;
        match w.normal.x.abs() > w.normal.z.abs() {
            // z = p.z + s n_x, x = p.x − s n_z: a point at each end of the picture.
            true => [z.0, z.1].map(|at| [p.x - (at - p.z) * w.normal.z / w.normal.x, 0.0, at]),
            false => [x.0, x.1].map(|at| [at, 0.0, p.z - (at - p.x) * w.normal.x / w.normal.z]),
        }
    };
    system.walls.iter().filter(standing).map(line).collect()
}

/// Name and unit of a field, and one number per grain.
type Field = (&'static str, &'static str, fn(&Model, &Origin) -> Vec<f64>);

/// All fields; those that a fluid adds are the last.
static FIELDS: [Field; 9] = [
    ("radius", "m", |m, _| m.grains().grains.radius.to_vec()),
    ("speed", "m/s", |m, _| {
        let velocities = m.grains().grains.velocity.iter();
        velocities.map(|v| v.norm()).collect()
    }),
    // A third of the trace: the mean stress in the grain.
    ("stress", "Pa", |m, _| {
        let stresses = m.grains().grain_stresses();
        stresses.iter().map(|s| s.trace() / 3.0).collect()
    }),
    ("displacement", "m", |m, origin| {
        let all = displacements(m.grains(), origin);
        all.iter().map(Vector::norm).collect()
    }),
    ("contacts", "", |m, _| contact_counts(m.grains(), |_| true)),
    ("sliding_contacts", "", |m, _| {
        contact_counts(m.grains(), |touch| touch.sliding)
    }),
    ("strain_deviator", "", |m, origin| {
        strain_deviators(m.grains(), origin)
    }),
    ("pore_pressure", "Pa", |m, _| pore_pressures(m)),
    ("fluid_force", "N", |m, _| fluid_forces(m)),
];
/// Number of those that need no fluid.
const DRY: usize = 7;

/// Names of the fields of a system.
pub fn names(wet: bool) -> impl Iterator<Item = &'static str> {
    let count = if wet { FIELDS.len() } else { DRY };
    FIELDS[..count].iter().map(|(name, ..)| *name)
}

fn field(name: &str) -> Option<&'static Field> {
    FIELDS.iter().find(|(n, ..)| *n == name)
}

/// Unit of a field.
pub fn unit(name: &str) -> &'static str {
    field(name).map_or("", |(_, unit, _)| unit)
}

/// One number per grain; zeros for an unknown name.
pub fn values(name: &str, model: &Model, origin: &Origin) -> Vec<f64> {
    match field(name) {
        Some((.., values)) => values(model, origin),
        None => vec![0.0; model.grains().grains.len()],
    }
}

/// Displacements since the start, m; those across the ends of a periodic axis by the nearest image.
pub fn displacements(system: &GrainSystem, origin: &Origin) -> Vec<Vector> {
    let period = &system.period;
    let from = |(x, start): (&Vector, &Vector)| {
        Vector::from_fn(|k, _| {
            let shift = x[k] - start[k];
            match period[k] {
                Some([low, high]) => shift - (shift / (high - low)).round() * (high - low),
                None => shift,
            }
        })
    };
    let now = system.grains.position.iter();
    now.zip(&origin.positions).map(from).collect()
}

/// √(2/3 e : e) around each grain since the start, e the deviator of its strain: 1 per unit of axial strain at constant volume.
pub fn strain_deviators(system: &GrainSystem, origin: &Origin) -> Vec<f64> {
    let moved = displacements(system, origin);
    let size = |strain: Matrix3<f64>| {
        let deviator = strain - Matrix3::identity() * (strain.trace() / 3.0);
        (2.0 / 3.0_f64).sqrt() * deviator.norm()
    };
    let tetrahedra = origin.tetrahedra(&system.grains.radius);
    let all = strains(tetrahedra, &origin.positions, &moved);
    all.into_iter().map(size).collect()
}

/// Number of contacts of each grain that are counted.
fn contact_counts(system: &GrainSystem, counted: impl Fn(&Touch) -> bool) -> Vec<f64> {
    let mut count = vec![0.0; system.grains.len()];
    for touch in system.contacts().filter(counted) {
        count[touch.grain] += 1.0;
        if let Partner::Grain(other) = touch.partner {
            count[other] += 1.0;
        }
    }
    count
}

/// Mean pressure of the pores around each grain, by their volumes, Pa.
fn pore_pressures(model: &Model) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; model.grains().grains.len()];
    if let Some(system) = model.wet() {
        let cells = system.pores().mesh.cells.iter();
        for ((cell, p), volume) in cells.zip(&system.pressures).zip(&system.volumes) {
            for k in cell.vertices().into_iter().filter_map(Vertex::sphere) {
                sums[k][0] += p * volume;
                sums[k][1] += volume;
            }
        }
    }
    let mean = |[pv, v]: [f64; 2]| if v > 0.0 { pv / v } else { 0.0 };
    sums.into_iter().map(mean).collect()
}

/// Sizes of the fluid's forces, buoyancy apart, N.
fn fluid_forces(model: &Model) -> Vec<f64> {
    let system = model.grains();
    let grains = &system.grains;
    let Some(wet) = model.wet() else {
        return vec![0.0; grains.len()];
    };
    let lift = system.gravity * wet.setup().fluid.density;
    let all = grains.external_force.iter().zip(&grains.radius);
    all.map(|(f, r)| (f + lift * sphere(*r)).norm()).collect()
}

//! Fields of grains, for pictures and files.

use nalgebra::Matrix3;

use crate::grains::{GrainSystem, Partner, Touch, Vector, strains};
use crate::scene::{Model, Origin};
use crate::sphere;
use crate::triangulation::Vertex;

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
    ("contacts", "", |m, _| contacts(m.grains(), |_| true)),
    ("sliding_contacts", "", |m, _| {
        contacts(m.grains(), |touch| touch.sliding)
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

/// One number per grain; zeros for a name that is none.
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
fn contacts(system: &GrainSystem, counted: impl Fn(&Touch) -> bool) -> Vec<f64> {
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
        for ((cell, p), volume) in cells.zip(system.pressures()).zip(system.volumes()) {
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

//! Geometry against identities, flow against closed forms, YADE and an independent prototype.

mod compressible;
mod cubic;
mod partition;
mod random_packings;
mod refusals;
mod solid_angles;
mod systems;

use dem_pfv::flow::{
    Boundary, Conductance, FlowSystem, Forces, HydraulicRadius, PoreGeometry, SlipCondition,
    SolidAngles, Solver, Storage,
};
use dem_pfv::triangulation::{Sphere, Triangulation, Wall};

use crate::{BOX25, BOX200, BOX1000, spheres};

const PACKINGS: [(&str, &str); 3] = [
    ("box25", BOX25),
    ("box200", BOX200),
    ("box1000_mono", BOX1000),
];

/// No-slip or slip on the four lateral walls; the ends y₋, y₊ let fluid through and stick as the laterals do.
fn geometry(spheres: &[Sphere], grip: SlipCondition, angles: SolidAngles) -> PoreGeometry {
    let mesh = Triangulation::within(spheres, &Wall::cuboid([0.0; 3], [1.0; 3])).expect("cells");
    PoreGeometry::new(mesh, &[grip; 6], angles).expect("pores")
}

/// A packing between sticking walls, by signed angles.
fn packed(text: &str) -> PoreGeometry {
    geometry(&spheres(text), SlipCondition::NoSlip, SolidAngles::Signed)
}

/// p = 0 at y = 0 and 1 Pa at y = 1.
fn drop_along_y(geometry: &PoreGeometry) -> Boundary {
    let mut boundary = Boundary::closed(geometry);
    boundary.pressure(geometry, 2, |_| Some(0.0));
    boundary.pressure(geometry, 3, |_| Some(1.0));
    boundary
}

/// The factorised system of a fluid of 1 Pa s, by hydraulic radii.
fn direct(geometry: &PoreGeometry, boundary: &Boundary, storage: Option<Storage>) -> FlowSystem {
    let law = hydraulic();
    FlowSystem::new(geometry, boundary, &law, 1.0, storage, Solver::Direct).expect("a system")
}

/// Largest difference of two lists.
fn most_apart(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// What a permeameter shows of a unit cube with µ = 1 Pa s.
struct Permeameter {
    /// Permeability κ = µ Q l / (Δp S), m².
    kappa: f64,
    /// Relative difference of what flows in and out.
    leak: f64,
    pressures: Vec<f64>,
    forces: Forces,
}

fn permeameter(geometry: &PoreGeometry, law: &dyn Conductance) -> Permeameter {
    let boundary = drop_along_y(geometry);
    let mut system =
        FlowSystem::new(geometry, &boundary, law, 1.0, None, Solver::Direct).expect("a system");
    let pressures = system.solve(&boundary, &[]).expect("pressures");
    let [low, high] = [2, 3].map(|w| system.inflow(geometry, w, &pressures));
    Permeameter {
        kappa: high,
        leak: (low + high).abs() / high,
        forces: Forces::new(geometry, &pressures),
        pressures,
    }
}

/// Force along y on all spheres and on the lateral walls.
fn sum_along_y(p: &Permeameter) -> f64 {
    let f = &p.forces;
    let spheres = f.pressure.iter().chain(&f.viscous);
    spheres.chain(&f.wall_viscous).map(|f| f.y).sum()
}

fn hydraulic() -> HydraulicRadius {
    HydraulicRadius::default()
}

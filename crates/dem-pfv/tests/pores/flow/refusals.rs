//! What cannot flow is named.

use dem_pfv::flow::{
    Boundary, FlowError, FlowSystem, PoreGeometry, SlipCondition, SolidAngles, Solver,
};
use dem_pfv::triangulation::{Sphere, Triangulation, Wall};

use crate::flow::{direct, drop_along_y, hydraulic, packed};
use crate::{BOX25, assert_says, spheres};

fn pores(spheres: &[Sphere], walls: &[Wall]) -> Result<PoreGeometry, FlowError> {
    let mesh = Triangulation::within(spheres, walls).expect("cells");
    let grips = vec![SlipCondition::NoSlip; walls.len()];
    PoreGeometry::new(mesh, &grips, SolidAngles::Signed)
}

#[test]
fn deep_overlaps_are_named() {
    let unit = Wall::cuboid([0.0; 3], [1.0; 3]);
    let two = [
        Sphere::new([0.4, 0.5, 0.5], 0.2),
        Sphere::new([0.7, 0.5, 0.5], 0.15),
    ];
    let error = pores(&two, &unit).expect_err("overlap");
    assert_kind!(error, FlowError::Overlap(0, 1, ..));
    let error = pores(&[Sphere::new([0.1, 0.5, 0.5], 0.2)], &unit).expect_err("in a wall");
    assert_kind!(error, FlowError::InWall(0, 0, ..));
}

#[test]
fn rooms_that_are_no_box_are_named() {
    let mut walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    walls[3] = Wall::through([0.0, 1.0, 0.0], [0.1, -1.0, 0.0]);
    let error = pores(&[Sphere::new([0.5; 3], 0.2)], &walls).expect_err("oblique");
    assert_eq!(error, FlowError::ObliqueWalls(0, 3));
    let free = Triangulation::within(&spheres(BOX25), &[]).expect("cells");
    let error = PoreGeometry::new(free, &[], SolidAngles::Signed).expect_err("no walls");
    assert_eq!(error, FlowError::NoBox(0));
}

#[test]
fn closed_rooms_have_no_pressure() {
    let geometry = packed(BOX25);
    let closed = Boundary::closed(&geometry);
    let system = FlowSystem::new(&geometry, &closed, &hydraulic(), 1.0, None, Solver::Direct);
    assert_says(system.err().expect("singular"), "no pressure is given");
}

#[test]
fn bad_numbers_and_changed_conditions_are_named() {
    let geometry = packed(BOX25);
    let boundary = drop_along_y(&geometry);
    for viscosity in [0.0, -1.0, f64::NAN] {
        let (law, solver) = (hydraulic(), Solver::Direct);
        let system = FlowSystem::new(&geometry, &boundary, &law, viscosity, None, solver);
        assert_says(system.err().expect("refused"), "viscosity is");
    }
    let mut system = direct(&geometry, &boundary, None);
    let changed = system.solve(&Boundary::closed(&geometry), &[]);
    assert!(matches!(changed, Err(FlowError::ConditionsChanged(_))));
    let short = system.solve(&boundary, &[0.0; 3]);
    assert!(matches!(short, Err(FlowError::Length(_, 3, _))));
}

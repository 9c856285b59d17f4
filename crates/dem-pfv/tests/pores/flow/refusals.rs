//! What cannot flow is named.

use dem_pfv::flow::{
    Boundary, FlowError, FlowSystem, PoreGeometry, SlipCondition, SolidAngles, Solver,
};
use dem_pfv::triangulation::{Sphere, Triangulation, Wall};

use crate::flow::{BOX25, direct, drop_along_y, geometry, hydraulic, spheres};

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
    assert!(matches!(error, FlowError::Overlap(0, 1, ..)), "{error}");
    let error = pores(&[Sphere::new([0.1, 0.5, 0.5], 0.2)], &unit).expect_err("in a wall");
    assert!(matches!(error, FlowError::InWall(0, 0, ..)), "{error}");
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
    let geometry = geometry(&spheres(BOX25), SlipCondition::NoSlip, SolidAngles::Signed);
    let closed = Boundary::closed(&geometry);
    let error = FlowSystem::new(&geometry, &closed, &hydraulic(), 1.0, None, Solver::Direct)
        .err()
        .expect("singular");
    assert!(
        error.to_string().contains("no pressure is given"),
        "{error}"
    );
}

#[test]
fn bad_numbers_and_changed_conditions_are_named() {
    let geometry = geometry(&spheres(BOX25), SlipCondition::NoSlip, SolidAngles::Signed);
    let boundary = drop_along_y(&geometry);
    for viscosity in [0.0, -1.0, f64::NAN] {
        let error = FlowSystem::new(
            &geometry,
            &boundary,
            &hydraulic(),
            viscosity,
            None,
            Solver::Direct,
        )
        .err();
        let told = error.expect("refused").to_string();
        assert!(told.starts_with("viscosity is"), "{told}");
    }
    let mut system = direct(&geometry, &boundary, None);
    let error = system
        .solve(&Boundary::closed(&geometry), &[])
        .expect_err("changed");
    assert!(matches!(error, FlowError::ConditionsChanged(_)));
    let error = system.solve(&boundary, &[0.0; 3]).expect_err("short");
    assert!(matches!(error, FlowError::Length(_, 3, _)));
}

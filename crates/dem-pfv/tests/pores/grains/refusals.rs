//! What is refused, with the grain and the value.

use dem_pfv::grains::{
    Cloud, Control, Grain, GrainError as Error, GrainSystem, LinearElastic, Mesh, Partner, Setup,
    Vector, Wall,
};

use crate::assert_says;
use crate::grains::{RADIUS, floor, grain, kilogram, law};

fn setup(grains: Vec<Grain>) -> Setup {
    Setup::new(grains, law(0.5, 0.3, 0.0))
}

fn refused(setup: Setup) -> Error {
    GrainSystem::new(setup).expect_err("refused")
}

#[test]
fn a_box_without_grains_is_refused() {
    assert_eq!(refused(setup(Vec::new())), Error::NoGrains);
}

#[test]
fn bad_numbers_name_their_grain() {
    for value in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let bad_radius = Grain::new([1.0, 0.0, 0.0], value, 2600.0);
        let error = refused(setup(vec![grain(0.0, 0.0, 0.0), bad_radius]));
        assert_kind!(error, Error::NotPositive(1, "radius", _));
        let bad_density = Grain::new([1.0, 0.0, 0.0], RADIUS, value);
        let error = refused(setup(vec![grain(0.0, 0.0, 0.0), bad_density]));
        assert_says(error, &format!("grain 1 has the density {value}"));
    }
    let error = refused(setup(vec![grain(0.0, f64::NAN, 0.0)]));
    assert_kind!(error, Error::NotFinite(0, "position", _));
    let flying = grain(0.0, 0.0, 0.0).moving([f64::INFINITY, 0.0, 0.0]);
    assert_kind!(
        refused(setup(vec![flying])),
        Error::NotFinite(_, "velocity", _)
    );
}

#[test]
fn bad_laws_name_their_parameter() {
    for (bad, what) in [
        (LinearElastic::new(0.0, 0.5, 0.3), "modulus"),
        (LinearElastic::new(f64::NAN, 0.5, 0.3), "modulus"),
        (LinearElastic::new(1e6, -0.5, 0.3), "stiffness ratio"),
        (LinearElastic::new(1e6, 0.5, -0.3), "friction"),
        (LinearElastic::new(1e6, 0.5, f64::INFINITY), "friction"),
        (law(0.5, 0.3, 1.0), "damping"),
    ] {
        assert_says(refused(Setup::new(vec![grain(0.0, 0.0, 0.0)], bad)), what);
    }
}

#[test]
fn overlaps_of_more_than_a_tenth_are_refused() {
    let small = Grain::new([RADIUS + 0.05 - 0.006, 0.0, 0.0], 0.05, kilogram());
    let error = refused(setup(vec![
        grain(5.0, 0.0, 0.0),
        grain(0.0, 0.0, 0.0),
        small,
    ]));
    assert_says(&error, "6.000e-3 m");
    assert_kind!(error, Error::Overlap(1, 2, _));
    // A tenth itself is not more.
    let fine = Grain::new([RADIUS + 0.05 - 0.0049, 0.0, 0.0], 0.05, kilogram());
    assert!(GrainSystem::new(setup(vec![grain(0.0, 0.0, 0.0), fine])).is_ok());
}

#[test]
fn grains_in_or_beyond_walls_and_meshes_are_named() {
    for x in [0.97, 1.0, 1.05, 3.0] {
        let setup = setup(vec![grain(0.5, 0.5, 0.5), grain(x, 0.5, 0.5)]);
        let error = refused(setup.walls(Wall::cuboid([0.0; 3], [1.0; 3])));
        assert_kind!(error, Error::InWall(1, 1, ..));
    }
    let corners = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2]]);
    let error = refused(setup(vec![grain(0.2, 0.2, 0.5 * RADIUS)]).mesh(mesh));
    assert_kind!(error, Error::InMesh(0, Partner::Triangle(_, 0), _));
}

#[test]
fn walls_meshes_and_periods_are_checked() {
    let one = || setup(vec![grain(0.5, 0.5, 0.5)]);
    let across = Wall::new([0.0; 3], [1.0, 0.0, 0.0]);
    let mesh = |xs: &[f64]| {
        let vertices = xs.iter().map(|x| [*x, 0.0, 0.0]);
        Mesh::new(vertices.collect(), vec![[0, 1, 2]])
    };
    let lawless = Setup {
        laws: Vec::new(),
        ..one()
    };
    for (setup, words) in [
        (one().walls([Wall::new([0.0; 3], [0.0; 3])]), "wall 0"),
        (one().walls([across.with_law(3)]), "contact law 3"),
        (one().mesh(mesh(&[0.0, 1.0])), "vertex 2"),
        (one().mesh(mesh(&[0.0, 1.0, 2.0])), "area"),
        (one().periodic(0, 0.0, 0.3), "too short"),
        (one().periodic(0, 0.6, 2.0), "outside the period"),
        (one().periodic(0, 0.0, 2.0).walls([across]), "periodic"),
        (one().damping(1.0), "damping"),
        (lawless, "there are 0"),
    ] {
        assert_says(refused(setup), words);
    }
}

#[test]
fn steps_and_runaways_are_refused() {
    let one = || setup(vec![grain(0.5, 0.5, 0.5)]);
    let mut system = GrainSystem::new(one()).expect("one");
    let limit = system.critical_step();
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_says(system.step(step).expect_err("no step"), "the step is");
    }
    let error = system.step(1.01 * limit).expect_err("too large");
    assert_says(&error, "above the critical one");
    assert_says(&error, "grain 0");
    assert_eq!(system.steps, 0);
    system.grains.external_force[0] = Vector::repeat(f64::NAN);
    system.step(0.5 * limit).expect("it flies away");
    let error = system.step(0.5 * limit).expect_err("gone");
    assert_kind!(error, Error::NotFinite(0, ..));

    let mut pressed = floor();
    let (stress, mass) = (1.0, 1.0);
    pressed.control = Control::Piston { stress, mass };
    let mut open = GrainSystem::new(one().walls([pressed])).expect("open");
    assert!(matches!(open.step(0.5 * limit), Err(Error::NoArea(0))));
}

#[test]
fn a_full_cloud_names_who_found_no_room() {
    let cloud = Cloud::new([0.0; 3], [1.0; 3]);
    let error = |radii: &[f64]| cloud.place(radii, 1).expect_err("no room");
    assert_kind!(error(&[0.6]), Error::NoRoom(0, ..));
    assert_kind!(error(&[0.1; 200]), Error::NoRoom(..));
    assert_kind!(error(&[0.1, -0.1]), Error::NotPositive(1, ..));
}

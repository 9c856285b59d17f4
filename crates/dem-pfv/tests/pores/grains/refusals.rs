//! What is refused, with the grain and the value.

use dem_pfv::grains::{
    Cloud, Control, Grain, GrainError as Error, GrainSystem, LinearElastic, Mesh, Partner, Setup,
    Vector, Wall,
};

use crate::grains::{RADIUS, grain, kilogram, law};

fn refused(grains: Vec<Grain>) -> Error {
    GrainSystem::new(Setup::new(grains, law(0.5, 0.3, 0.0))).expect_err("refused")
}

#[test]
fn a_box_without_grains_is_refused() {
    assert_eq!(refused(Vec::new()), Error::NoGrains);
}

#[test]
fn bad_numbers_name_their_grain() {
    for value in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let bad_radius = Grain::new([1.0, 0.0, 0.0], value, 2600.0);
        let error = refused(vec![grain(0.0, 0.0, 0.0), bad_radius]);
        assert!(
            matches!(error, Error::NotPositive(1, "radius", _)),
            "{error}"
        );
        let bad_density = Grain::new([1.0, 0.0, 0.0], RADIUS, value);
        let error = refused(vec![grain(0.0, 0.0, 0.0), bad_density]);
        let text = error.to_string();
        assert!(
            text.contains("grain 1 has the density") && text.contains(&value.to_string()),
            "{text}"
        );
    }
    let error = refused(vec![grain(0.0, f64::NAN, 0.0)]);
    assert!(
        matches!(error, Error::NotFinite(0, "position", _)),
        "{error}"
    );
    let error = refused(vec![grain(0.0, 0.0, 0.0).moving([f64::INFINITY, 0.0, 0.0])]);
    assert!(
        matches!(error, Error::NotFinite(_, "velocity", _)),
        "{error}"
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
        let error = GrainSystem::new(Setup::new(vec![grain(0.0, 0.0, 0.0)], bad)).expect_err("bad");
        assert!(error.to_string().contains(what), "{error}");
    }
}

#[test]
fn overlaps_of_more_than_a_tenth_are_refused() {
    let small = Grain::new([RADIUS + 0.05 - 0.006, 0.0, 0.0], 0.05, kilogram());
    let error = refused(vec![grain(5.0, 0.0, 0.0), grain(0.0, 0.0, 0.0), small]);
    assert!(matches!(error, Error::Overlap(1, 2, _)), "{error}");
    assert!(error.to_string().contains("6.000e-3 m"), "{error}");
    // A tenth itself is not more.
    let fine = Grain::new([RADIUS + 0.05 - 0.0049, 0.0, 0.0], 0.05, kilogram());
    let setup = Setup::new(vec![grain(0.0, 0.0, 0.0), fine], law(0.5, 0.3, 0.0));
    assert!(GrainSystem::new(setup).is_ok());
}

#[test]
fn grains_in_or_beyond_walls_and_meshes_are_named() {
    let walls = || Wall::cuboid([0.0; 3], [1.0; 3]);
    for x in [0.97, 1.0, 1.05, 3.0] {
        let setup = Setup::new(
            vec![grain(0.5, 0.5, 0.5), grain(x, 0.5, 0.5)],
            law(0.5, 0.3, 0.0),
        );
        let error = GrainSystem::new(setup.walls(walls())).expect_err("beyond");
        assert!(matches!(error, Error::InWall(1, 1, ..)), "{error}");
    }
    let mesh = Mesh::new(
        vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        vec![[0, 1, 2]],
    );
    let setup = Setup::new(vec![grain(0.2, 0.2, 0.5 * RADIUS)], law(0.5, 0.3, 0.0)).mesh(mesh);
    let error = GrainSystem::new(setup).expect_err("in the mesh");
    assert!(
        matches!(error, Error::InMesh(0, Partner::Triangle(_, 0), _)),
        "{error}"
    );
}

#[test]
fn walls_meshes_and_periods_are_checked() {
    let one = || Setup::new(vec![grain(0.5, 0.5, 0.5)], law(0.5, 0.3, 0.0));
    let error = |setup: Setup| GrainSystem::new(setup).expect_err("refused").to_string();
    let flat = Wall::new([0.0; 3], [0.0; 3]);
    assert!(error(one().walls([flat])).contains("wall 0"));
    let mut stray = Wall::new([0.0; 3], [1.0, 0.0, 0.0]);
    stray.law = 3;
    assert!(error(one().walls([stray])).contains("contact law 3"));
    let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0]], vec![[0, 1, 2]]);
    assert!(error(one().mesh(mesh)).contains("vertex 2"));
    let mesh = Mesh::new(
        vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        vec![[0, 1, 2]],
    );
    assert!(error(one().mesh(mesh)).contains("area"));
    assert!(error(one().periodic(0, 0.0, 0.3)).contains("too short"));
    assert!(error(one().periodic(0, 0.6, 2.0)).contains("outside the period"));
    let across = Wall::new([0.0; 3], [1.0, 0.0, 0.0]);
    assert!(error(one().periodic(0, 0.0, 2.0).walls([across])).contains("periodic"));
    assert!(error(one().damping(1.0)).contains("damping"));
    let none = Setup {
        grains: vec![grain(0.0, 0.0, 0.0)],
        ..Setup::default()
    };
    assert!(error(none).contains("there are 0"));
}

#[test]
fn steps_and_runaways_are_refused() {
    let one = || Setup::new(vec![grain(0.5, 0.5, 0.5)], law(0.5, 0.3, 0.0));
    let mut system = GrainSystem::new(one()).expect("one");
    let limit = system.critical_step();
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = system.step(step).expect_err("no step").to_string();
        assert!(error.starts_with("the step is"), "{error}");
    }
    let error = system
        .step(1.01 * limit)
        .expect_err("too large")
        .to_string();
    assert!(
        error.contains("above the critical one") && error.contains("grain 0"),
        "{error}"
    );
    assert_eq!(system.steps, 0);
    system.grains.external_force[0] = Vector::repeat(f64::NAN);
    system.step(0.5 * limit).expect("it flies away");
    let error = system.step(0.5 * limit).expect_err("gone");
    assert!(matches!(error, Error::NotFinite(0, ..)), "{error}");

    let mut pressed = Wall::new([0.0; 3], [0.0, 0.0, 1.0]);
    let (stress, mass) = (1.0, 1.0);
    pressed.control = Control::Piston { stress, mass };
    let mut open = GrainSystem::new(one().walls([pressed])).expect("open");
    assert!(matches!(open.step(0.5 * limit), Err(Error::NoArea(0))));
}

#[test]
fn a_full_cloud_names_who_found_no_room() {
    let cloud = Cloud::new([0.0; 3], [1.0; 3]);
    let error = cloud.place(&[0.6], 1).expect_err("too large");
    assert!(matches!(error, Error::NoRoom(0, ..)), "{error}");
    let error = cloud.place(&[0.1; 200], 1).expect_err("too many");
    assert!(matches!(error, Error::NoRoom(..)), "{error}");
    assert!(matches!(
        cloud.place(&[0.1, -0.1], 1),
        Err(Error::NotPositive(1, ..))
    ));
}

//! Generators.

use dem_pfv::grains::{
    Cloud, Control, Grain, GrainSystem, Grown, LinearElastic, Setup, Vector, Wall, rain,
    step_to_rest, uniform_radii,
};

use crate::close;
use crate::grains::{cloud, floor, repeated};

const MODULUS: f64 = 15e6;

fn smooth() -> LinearElastic {
    LinearElastic::new(MODULUS, 0.0, 0.0)
}

#[test]
fn a_cloud_touches_nothing() {
    let radii = uniform_radii(600, 0.02, 0.06, 5);
    let cloud = Cloud::new([0.0; 3], [1.2, 1.0, 1.0]).periodic(0);
    let places = cloud.place(&radii, 5).expect("a cloud");
    assert_eq!(places, cloud.place(&radii, 5).expect("the same cloud"));
    assert_ne!(places, cloud.place(&radii, 6).expect("another cloud"));
    for (i, (a, ra)) in places.iter().zip(&radii).enumerate() {
        assert!(a.y >= *ra && a.y <= 1.0 - ra && (0.0..=1.2).contains(&a.x));
        for (b, rb) in places.iter().zip(&radii).skip(i + 1) {
            let mut d: Vector = a - b;
            d.x -= 1.2 * (d.x / 1.2).round();
            assert!(d.norm() >= ra + rb);
        }
    }
    // Their mean is the middle of the interval, within four standard deviations.
    let mean = radii.iter().sum::<f64>() / 600.0;
    close(mean, 0.04, 4.0 * 0.04 / (12.0 * 600.0_f64).sqrt());
}

#[test]
fn growth_ends_at_its_porosity() {
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    let grains = cloud(200, [0.045, 0.055], 1);
    let setup = Setup::new(grains, smooth()).walls(walls).damping(0.3);
    let mut system = GrainSystem::new(setup).expect("a cloud");
    let growth = Grown {
        fast: 1.002,
        tolerance: 1e-2,
        porosity: Some(0.38),
        ..Grown::default()
    };
    growth.run(&mut system, 0.5, 1_000_000).expect("grown");
    close(system.porosity().expect("closed"), 0.38, 1e-12);
}

#[test]
fn growth_in_a_periodic_box_ends_at_its_stress() {
    let setup = Setup::new(cloud(150, [0.045, 0.055], 1), smooth()).damping(0.3);
    let mut system = GrainSystem::new(repeated(setup, 1.0)).expect("a cloud");
    let growth = Grown {
        fast: 1.002,
        slow: 1.0002,
        stress: Some(5e4),
        ..Grown::default()
    };
    growth.run(&mut system, 0.5, 1_000_000).expect("grown");
    close(system.mean_stress().expect("closed") / 5e4, 1.0, 1e-3);
    // Without walls nothing but the grains carries: each is in equilibrium, its stress symmetric.
    let stress = system.stress(1.0);
    close(stress.trace() / 3.0, 5e4, 50.0);
    let stresses = system.grain_stresses().into_iter();
    let volume = |r: &f64| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
    let parts = stresses.zip(&system.grains.radius);
    let of_grains: f64 = parts.map(|(s, r)| s.trace() / 3.0 * volume(r)).sum();
    close(of_grains / 5e4, 1.0, 1e-3);
}

#[test]
fn a_pluviated_bed_rests_on_the_floor_with_its_weight() {
    let radii = uniform_radii(150, 0.045, 0.055, 2);
    let grains = rain([0.0; 3], [0.6, 0.6], &radii, 2600.0, 0.7, 2).expect("rain");
    let sides = Wall::cuboid([0.0; 3], [0.6; 3]).into_iter().take(4);
    let walls = [floor()].into_iter().chain(sides.map(|w| w.with_law(1)));
    let law = LinearElastic {
        damping: 0.2,
        ..LinearElastic::new(MODULUS, 0.5, 0.3)
    };
    let setup = Setup::new(grains, law).law(smooth()).walls(walls);
    let setup = setup.gravity([0.0, 0.0, -9.81]).damping(0.2);
    let mut system = GrainSystem::new(setup).expect("a bed");
    step_to_rest(&mut system, 0.7, 1e-4, 400_000).expect("rest");
    let g = &system.grains;
    let weight: f64 = g.mass.iter().map(|m| m * 9.81).sum();
    // What is not balanced grain by grain is not on the floor.
    let forces = g.contact_force.iter().zip(&g.mass);
    let rest: f64 = forces.map(|(f, m)| (f.z - 9.81 * m).abs()).sum();
    close(system.walls[0].push(), weight, rest + 1e-9 * weight);
    // The bed is a random packing: between the densest lattice and the loosest stable bed of spheres.
    let top = g.position.iter().map(|x| x.z).fold(0.0, f64::max);
    assert!(top < 150.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3) / (0.36 * 0.4));
}

/// Grains that are moved without forces, as in a flow: contacts are found where they are put.
#[test]
fn grains_move_without_forces() {
    let grains = vec![
        Grain::new([0.2, 0.5, 0.5], 0.05, 2600.0).moving([0.1, 0.0, 0.0]),
        Grain::new([0.5, 0.5, 0.5], 0.05, 2600.0),
    ];
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
    let mut system = GrainSystem::new(Setup::new(grains, smooth()).walls(walls)).expect("two");
    system.drift(1.0).expect("moved");
    close(system.grains.position[0].x, 0.3, 1e-15);
    assert_eq!(system.time, 0.0);
    system.grains.position[0] = Vector::new(0.401, 0.5, 0.5);
    system.evaluate().expect("forces");
    let touch = system.contacts().next().expect("a contact");
    close(touch.overlap, 0.001, 1e-12);
    // E R between equal spheres.
    close(touch.force.x, -MODULUS * 0.05 * 0.001, 1e-6);
    system.grains.held[1] = true;
    system.walls[0].control = Control::Velocity;
    system.step(1e-5).expect("a step");
    assert_eq!(system.grains.position[1], Vector::repeat(0.5));
}

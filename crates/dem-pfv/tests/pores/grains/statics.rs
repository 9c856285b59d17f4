//! Equilibria under weight and stress.

use std::f64::consts::TAU;

use dem_pfv::grains::{
    Control, GrainSystem, Grown, Partner, Setup, Touch, Vector, Wall, step_to_rest,
};
use nalgebra::Matrix3;

use crate::close;
use crate::grains::{GRAVITY, RADIUS, STIFFNESS, cloud, floor, grain, grown, law, position, run};

/// Ball n from the top carries n m g, so that its overlap below is n m g / k; damping moves none of it.
#[test]
fn a_damped_stack_is_as_deep_as_its_weight() {
    for damping in [0.1, 0.7] {
        let balls = (0..8).map(|i| grain(0.0, 0.0, RADIUS * f64::from(2 * i + 1)));
        let setup = Setup::new(balls.collect(), law(0.5, 0.3, 0.0)).walls([floor()]);
        let setup = setup.gravity([0.0, 0.0, -GRAVITY]).damping(damping);
        let mut system = GrainSystem::new(setup).expect("a stack");
        step_to_rest(&mut system, 0.5, 1e-12, 100_000).expect("rest");
        for touch in system.contacts() {
            let above = 8 - touch.grain.max(match touch.partner {
                Partner::Grain(other) => other,
                _ => 0,
            });
            let expected = above as f64 * GRAVITY / STIFFNESS;
            close(touch.overlap / expected, 1.0, 1e-9);
        }
        close(system.walls[0].push(), 8.0 * GRAVITY, 1e-9 * 8.0 * GRAVITY);
    }
}

/// A sample of 200 grains between walls without friction, grown to 50 kPa.
fn sample(friction: f64) -> GrainSystem {
    // A hundred times faster than the custom, for a small sample.
    let growth = Grown {
        fast: 1.002,
        slow: 1.0002,
        stress: Some(5e4),
        ..Grown::default()
    };
    grown(cloud(200, [0.04, 0.05], 3), friction, growth)
}

/// Σ_grains Σ_c (x^C − x) ⊗ F and the walls' Σ x^C ⊗ F differ by what is unbalanced, Σ x ⊗ F_res, exactly.
fn love_weber_is_wall_stress(system: &GrainSystem) {
    let volume = system.box_volume().expect("closed");
    let stress = system.stress(volume);
    let at_wall = |touch: &Touch| matches!(touch.partner, Partner::Wall(_));
    let moments = system.contacts().filter(at_wall);
    let moments = moments.map(|t| t.point * t.force.transpose());
    let walls = -moments.sum::<Matrix3<f64>>();
    let g = &system.grains;
    let rest = g.position.iter().zip(&g.contact_force);
    let rest: Matrix3<f64> = rest.map(|(x, f)| x * f.transpose()).sum();
    let difference = (stress * volume - walls - rest).amax();
    assert!(difference < 1e-12 * walls.amax() * 200.0, "{difference}");
    // And so the stress on a pair of walls is that of the grains, but for the overlaps and the rest.
    for axis in 0..3 {
        let pair = [2 * axis, 2 * axis + 1].map(|w| system.wall_stress(w).expect("area"));
        let mean = 0.5 * (pair[0] + pair[1]);
        let length = system.box_lengths().expect("closed")[axis];
        let deepest = system.contacts().map(|c| c.overlap).fold(0.0, f64::max);
        let uneven = (pair[0] - pair[1]).abs();
        let bound = rest.amax() / volume + mean * deepest / length + uneven;
        close(stress[(axis, axis)], mean, bound);
    }
}

#[test]
fn servo_walls_reach_their_stress() {
    let mut system = sample(0.3);
    love_weber_is_wall_stress(&system);
    let goals = [6e4, 6e4, 7e4, 7e4, 8e4, 8e4];
    for (wall, stress) in system.walls.iter_mut().zip(goals) {
        wall.control = Control::Stress {
            stress,
            largest_speed: 0.05,
        };
    }
    run(&mut system, 1e-4, 20_000);
    step_to_rest(&mut system, 0.5, 1e-4, 100_000).expect("rest");
    for (number, goal) in goals.into_iter().enumerate() {
        let stress = system.wall_stress(number).expect("area");
        close(stress / goal, 1.0, 1e-3);
    }
    love_weber_is_wall_stress(&system);
}

/// A piston on a held ball swings with ω² = k / M about the overlap σ A / k.
#[test]
fn a_piston_swings_as_its_mass_says() {
    let mut ball = grain(0.0, 0.0, 0.0);
    ball.held = true;
    let (mass, stress, area) = (2.0, 1e3, 0.04);
    let mut piston = Wall::new([0.0, 0.0, RADIUS], [0.0, 0.0, -1.0]);
    piston.control = Control::Piston { stress, mass };
    piston.area = Some(area);
    let setup = Setup::new(vec![ball], law(0.0, 0.0, 0.0)).walls([piston]);
    let mut system = GrainSystem::new(setup).expect("a ball");
    let period = TAU / (STIFFNESS / mass).sqrt();
    let step = period / 2000.0;
    let depth = |s: &GrainSystem| RADIUS - s.walls[0].point.z;
    run(&mut system, step, 1000);
    // Half a period later it is at twice the overlap of rest, and after a whole one where it was.
    let rest = stress * area / STIFFNESS;
    let order = (TAU / 2000.0_f64).powi(2);
    close(depth(&system) / rest, 2.0, order);
    run(&mut system, step, 1000);
    close(depth(&system) / rest, 0.0, 10.0 * order);
    assert_eq!(position(&system, 0), Vector::zeros());
}

/// At rest a piston carries its stress, whatever its mass.
#[test]
fn a_damped_piston_ends_at_its_stress() {
    let mut system = sample(0.3);
    let solid: f64 = system.grains.mass.iter().sum();
    for share in [0.02, 0.2] {
        let (stress, mass) = (6e4, share * solid);
        system.walls[5].control = Control::Piston { stress, mass };
        step_to_rest(&mut system, 0.5, 1e-8, 400_000).expect("rest");
        run(&mut system, 5e-5, 2000);
        close(system.wall_stress(5).expect("area") / stress, 1.0, 1e-6);
    }
}

/// A force from outside acts as weight does: buoyancy here.
#[test]
fn external_forces_lift() {
    let setup = Setup::new(vec![grain(0.0, 0.0, RADIUS)], law(0.5, 0.3, 0.0)).walls([floor()]);
    let setup = setup.gravity([0.0, 0.0, -GRAVITY]).damping(0.5);
    let mut system = GrainSystem::new(setup).expect("a ball");
    system.grains.external_force[0] = Vector::z() * (0.4 * GRAVITY);
    step_to_rest(&mut system, 0.5, 1e-12, 100_000).expect("rest");
    let depth = RADIUS - position(&system, 0).z;
    close(depth, 0.6 * GRAVITY / STIFFNESS, 1e-12);
}

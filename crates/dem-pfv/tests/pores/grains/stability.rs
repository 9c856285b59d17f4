//! The critical step.

use dem_pfv::grains::{GrainError, GrainSystem, Setup, Wall};

use crate::close;
use crate::grains::{RADIUS, STIFFNESS, grain, jaws, law, position, repeated};

/// A ball pressed between two walls: one spring of 2 k.
fn pressed() -> GrainSystem {
    let setup = Setup::new(vec![grain(0.0, 0.0, 1e-6)], law(0.0, 0.0, 0.0));
    GrainSystem::new(setup.walls(jaws())).expect("a ball")
}

#[test]
fn a_single_spring_is_stable_below_and_not_above() {
    let limit = pressed().critical_step();
    close(limit / (2.0 / (2.0 * STIFFNESS).sqrt()), 1.0, 1e-12);

    let mut below = pressed();
    let mut largest = 0.0_f64;
    for _ in 0..10_000 {
        below.step(0.9 * limit).expect("a step");
        largest = largest.max(position(&below, 0).z.abs());
    }
    // A start at rest half a step early swings to 1/√(1 − 0.9²) at most.
    let most = 1e-6 / (1.0_f64 - 0.81).sqrt();
    assert!(largest < most * (1.0 + 1e-6), "{largest}");

    let mut above = pressed();
    above.evaluate().expect("forces");
    let refused = above.integrate(1.02 * limit).expect_err("too large");
    assert!(matches!(refused, GrainError::StepTooLarge(.., 0)));
    assert!(refused.to_string().contains("grain 0"));
    for _ in 0..200 {
        above.evaluate().expect("forces");
        above.integrate_unchecked(1.02 * limit).expect("moved");
    }
    assert!(position(&above, 0).z.abs() > 1e-3);
}

/// The bound is exact where one contact is all there is.
#[test]
fn the_bound_is_exact_for_one_contact() {
    let overlap = 0.01 * RADIUS;
    let two = [0.0, 2.0 * RADIUS - overlap].map(|x| grain(x, 0.0, 0.0));
    let smooth = GrainSystem::new(Setup::new(two.into(), law(0.0, 0.0, 0.0))).expect("pair");
    // ω² = k / m* = 2 k / m.
    let bound = 2.0 / (2.0 * STIFFNESS).sqrt();
    close(smooth.critical_step() / bound, 1.0, 1e-12);

    // A ball that rolls on the spot at a wall: ω² = k_t (1/m + R²/J) = 7/2 k_t/m, the highest for k_t = k_n.
    let floor = Wall::new([0.0, 0.0, -RADIUS], [0.0, 0.0, 1.0]);
    let setup = Setup::new(vec![grain(0.0, 0.0, -1e-9)], law(1.0, 1e9, 0.0)).walls([floor]);
    let rough = GrainSystem::new(setup).expect("ball");
    // The floor of the estimate is a touch of two balls, ω² = 7 k_t/m.
    let bound = 2.0 / (7.0 * STIFFNESS).sqrt();
    close(rough.critical_step() / bound, 1.0, 1e-7);
}

/// A row of springs in a lattice: at 0.99 of the bound nothing grows, whatever the highest mode is.
#[test]
fn a_pressed_lattice_is_stable_at_the_bound() {
    let spacing = 1.96 * RADIUS;
    let size = 4.0 * spacing;
    let grains = (0..64).map(|i| {
        let at = |k: i32| (0.5 + f64::from(i / k % 4)) * spacing;
        let noise = 1e-9 * f64::from(i * 37 % 11 - 5);
        grain(at(1) + noise, at(4) - noise, at(16) + noise)
    });
    let setup = Setup::new(grains.collect(), law(0.5, 10.0, 0.0));
    let mut system = GrainSystem::new(repeated(setup, size)).expect("lattice");
    let step = 0.99 * system.critical_step();
    let mut largest = 0.0_f64;
    for _ in 0..5000 {
        system.step(step).expect("a step");
        let speed = system.kinetic_energy().sqrt();
        largest = largest.max(speed);
    }
    // 64 displacements of 5·10⁻⁹ m at most on springs of 6 k: ½ Σ 12 k x².
    let most = (64.0 * 6.0 * STIFFNESS).sqrt() * 5e-9 * 10.0;
    assert!(largest < most, "{largest}");
}

//! Boxes that repeat themselves.

use dem_pfv::grains::{GrainSystem, Setup, Vector};

use crate::close;
use crate::grains::{grain, law, position, repeated, run, velocity};

fn pair(first: f64, second: f64) -> GrainSystem {
    let grains = vec![
        grain(first, 0.5, 0.5).moving([0.2, 0.0, 0.0]),
        grain(second, 0.52, 0.5),
    ];
    let setup = Setup::new(grains, law(0.5, 0.3, 0.1));
    GrainSystem::new(repeated(setup, 1.0)).expect("pair")
}

/// The same impact in the middle and across the ends, then on and around the box.
#[test]
fn an_impact_across_the_ends_is_one_in_the_middle() {
    let (mut middle, mut across) = (pair(0.375, 0.625), pair(0.875, 0.125));
    let step = 0.1 * middle.critical_step();
    run(&mut middle, step, 20_000);
    run(&mut across, step, 20_000);
    for grain in 0..2 {
        let shift = position(&across, grain) - position(&middle, grain) - Vector::x() * 0.5;
        let whole = shift.map(|x| x - x.round());
        // Coordinates differ by half a box, and so does their rounding: 2·10⁴ steps of 10⁻¹⁶ m.
        assert!(whole.norm() < 1e-9, "{shift}");
        assert!((velocity(&across, grain) - velocity(&middle, grain)).norm() < 1e-9);
        let inside = position(&across, grain);
        assert!(inside.iter().all(|x| (0.0..1.0).contains(x)), "{inside}");
    }
    assert!(velocity(&middle, 1).x > 0.05, "they met");
}

#[test]
fn a_lone_grain_comes_round() {
    let grain = grain(0.9, 0.5, 0.5).moving([1.0, 0.0, 0.0]);
    let setup = Setup::new(vec![grain], law(0.5, 0.0, 0.0));
    let mut system = GrainSystem::new(setup.periodic(0, 0.0, 1.0)).expect("grain");
    let step = 1.0 / 1024.0;
    assert!(step < system.critical_step());
    run(&mut system, step, 3 * 1024);
    close(position(&system, 0).x, 0.9, 1e-12);
}

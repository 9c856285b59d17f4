//! Fluid that gives way.

use dem_pfv::flow::{Boundary, Storage};

use crate::flow::{direct, drop_along_y, most_apart, packed};
use crate::{BOX200, close};

/// 1 kPa over a step, s.
fn soft(step: f64) -> Storage {
    Storage {
        bulk_modulus: 1e3,
        step,
    }
}

/// A closed box takes what is pumped in by its pressure alone: K Q Δt / V_void on the mean, without a given pressure.
#[test]
fn a_closed_box_stores_what_is_pumped_in() {
    let geometry = packed(BOX200);
    let mut boundary = Boundary::closed(&geometry);
    boundary.source(17, 1e-3);
    let mut system = direct(&geometry, &boundary, Some(soft(0.5)));
    let mut pressures = vec![5.0; geometry.volumes.len()];
    for _ in 0..3 {
        pressures = system.step(&boundary, &[], &pressures).expect("pressures");
    }
    let void: f64 = geometry.void_volumes.iter().sum();
    let pairs = pressures.iter().zip(&geometry.void_volumes);
    let mean = pairs.map(|(p, v)| p * v).sum::<f64>() / void;
    let exact = 5.0 + 3.0 * 1e3 * 1e-3 * 0.5 / void;
    close(mean / exact, 1.0, 1e-9);
}

/// From rest, pressures rise step by step to those of the incompressible fluid, and none beyond; a long step is as
/// good as infinitely many.
#[test]
fn pressures_diffuse_to_the_steady_ones() {
    let geometry = packed(BOX200);
    let boundary = drop_along_y(&geometry);
    let mut steady = direct(&geometry, &boundary, None);
    let steady = steady.solve(&boundary, &[]).expect("pressures");
    // Diffusivity κ K/(µ n) is about 0.08 m²/s: 1 s goes a third of the way through the box.
    let mut system = direct(&geometry, &boundary, Some(soft(1.0)));
    let mut pressures = vec![0.0; steady.len()];
    let mut distance = vec![];
    for _ in 0..200 {
        let next = system.step(&boundary, &[], &pressures).expect("pressures");
        let mut pairs = next.iter().zip(&pressures);
        assert!(pairs.all(|(a, b)| a >= &(b - 1e-12)), "pressures rise");
        pressures = next;
        distance.push(most_apart(&pressures, &steady));
    }
    let (first, last) = (distance[0], distance[199]);
    println!("distance {first:.3} after 1 s, {last:.1e} after 200 s");
    assert!(first > 0.1 && last < 1e-9, "{first} and {last:e}");
    system.set_storage(soft(1e12)).expect("numbers");
    let once = system.step(&boundary, &[], &vec![0.0; steady.len()]);
    let largest = most_apart(&once.expect("pressures"), &steady);
    assert!(largest < 1e-9, "{largest:e} Pa");
}

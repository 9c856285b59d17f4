//! A current between two faces with the same pressure.

use sph_tests::close;

use super::*;

/// Sixteen rows of water under a pressure of 1 % of ρc², between walls without friction.
const CHANNEL: &str = r#"
title = "a current that nothing drives"
dimension = 2
[run]
end = 1.5
[numerics]
spacing = 0.03125
[kernel.wendland-c2]
[formulation.hu-adams]
[integrator.symplectic-euler]
[viscous-operator.monaghan-gingold]
[smoother.brezzi-pitkaranta]
[walls.usaw]
vertices = false
[wall.inlet]
polyline = [[0.0, 0.5], [0.0, 0.0]]
open-boundary.pressure = { pressure = 0.0 }
[wall.floor]
polyline = [[0.0, 0.0], [2.0, 0.0]]
condition = "free-slip"
[wall.outlet]
polyline = [[2.0, 0.0], [2.0, 0.5]]
open-boundary.pressure = { pressure = 0.0 }
[wall.top]
polyline = [[2.0, 0.5], [0.0, 0.5]]
condition = "free-slip"
[phase.water]
density = 1000.0
speed_of_sound = 16.0
equation-of-state.tait = { background_pressure = 2500.0 }
rheology.newtonian = { viscosity = "1e-3 Pa s" }
[body.water]
phase = "water"
box = [[0.0, 0.0], [2.0, 0.5]]
velocity = [0.2, 0.0]
[output]
every = 1.5
vtk = false
"#;

/// Nothing drives or holds the water, so it goes on as it is. What the faces do to it is less than a difference of 1 % of their
/// pressure: Δu = Δp t/(ρL).
#[test]
fn a_current_between_two_equal_pressures_goes_on() {
    let momentum = finished(CHANNEL, 1).last("momentum.x");
    let (velocity, bound) = (momentum / 1000.0, 0.01 * 2500.0 * 1.5 / (1000.0 * 2.0));
    println!("0.2 m/s have become {velocity} m/s");
    close(velocity, 0.2, bound, "m/s");
}

//! A current between two faces with the same pressure.

use sph_tests::close;

use super::*;

/// Sixteen rows of water under a pressure of 1 % of ρc², between walls without friction.
const CHANNEL: &str = include_str!("current.toml");

/// Nothing drives or holds the water, so it goes on as it is. What the faces do to it is less than a difference of 1 % of their
/// pressure: Δu = Δp t/(ρL).
#[test]
fn a_current_between_two_equal_pressures_goes_on() {
    let momentum = finished(CHANNEL, 1).last("momentum.x");
    let (velocity, bound) = (momentum / 1000.0, 0.01 * 2500.0 * 1.5 / (1000.0 * 2.0));
    println!("0.2 m/s have become {velocity} m/s");
    close(velocity, 0.2, bound, "m/s");
}

//! A mover from outside: `[wall.NAME.mover.winch]`.

use sph_boundary::{Load, Mover, MoverEntry, RigidState};
use sph_core::plugin;

/// A winch that lifts a wall with a force of its own, against weight and water: m v̇ = F + f − m g, upwards.
#[plugin(MoverEntry [2, 3], "winch", "lifts a wall with a force", source: "Archimedes")]
struct Winch {
    /// Mass of the wall.
    #[parameter(unit: "kg", above: 0.0)]
    mass: f64,
    /// Force of the winch, upwards.
    #[parameter(unit: "N")]
    pull: f64,
}

impl<const D: usize> Mover<D> for Winch {
    fn start(&self) -> RigidState<D> {
        RigidState::default()
    }
    fn next(&self, now: &RigidState<D>, load: &Load<D>, _time: f64, dt: f64) -> RigidState<D> {
        let up = D - 1;
        let mut state = *now;
        state.acceleration[up] = (self.pull + load.force[up]) / self.mass + load.gravity[up];
        state.velocity[up] += dt * state.acceleration[up];
        state.pose.translation[up] += dt * state.velocity[up];
        state
    }
}

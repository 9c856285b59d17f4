//! The trait of movers of walls.

use nalgebra::Matrix6;
use sph_core::{Vect, contract};
use sph_neighbours::DepthGauge;

use crate::{Load, MoverRefusal, MoverSetting, RigidMotion, RigidState, Touch};

/// Moves one wall. The wall's state is its whole memory: it is rolled back with the particles, and in
/// checkpoints.
pub trait Mover<const D: usize>: Send + Sync + std::fmt::Debug {
    /// Takes the geometry of its wall and of its surroundings; called once, first of all.
    ///
    /// # Errors
    /// The key of its table that does not fit the scene.
    fn prepare(&mut self, _setting: &MoverSetting<'_, D>) -> Result<(), MoverRefusal> {
        Ok(())
    }
    /// Contact law of the wall; none if nothing stops it. Its place among walls that touch is then in [`Load`].
    fn touch(&self) -> Option<Touch> {
        None
    }
    /// The state at time 0.
    fn start(&self) -> RigidState<D>;
    /// True if it needs the force of the fluid on the wall; the force is then measured before every kick.
    fn needs_forces(&self) -> bool {
        true
    }
    /// The gauge of the depth before its wall, in a state; the depth there is then in [`Load`].
    fn looks(&self, _now: &RigidState<D>) -> Option<DepthGauge<D>> {
        None
    }
    /// Forces of the lines on the wall in a state: the force of each on it, N, and its tension at the other end, N;
    /// none if it hangs on nothing.
    fn pulls(&self, _now: &RigidState<D>) -> Vec<(Vect<D>, f64)> {
        Vec::new()
    }
    /// Inverse of mass and inertia in a state at a time, s: the change of both velocities over an impulse and its moment
    /// about the centre, with zeros for locked freedoms; none for a wall without mass.
    fn mobility(&self, _now: &RigidState<D>, _time: f64) -> Option<Matrix6<f64>> {
        None
    }
    /// The state at `time + dt` from that at `time`, s, with the load of the last evaluation.
    fn next(&self, now: &RigidState<D>, load: &Load<D>, time: f64, dt: f64) -> RigidState<D>;
}

contract!(
    /// A mover that a wall may name.
    pub MoverEntry, "mover", InWall, "the motion of a wall by the force of the fluid on it", Mover<D>
);

/// Prescribed courses ignore forces.
impl<const D: usize> Mover<D> for RigidMotion<D> {
    fn start(&self) -> RigidState<D> {
        self.state(0.0)
    }
    fn needs_forces(&self) -> bool {
        false
    }
    fn next(&self, _: &RigidState<D>, _: &Load<D>, time: f64, dt: f64) -> RigidState<D> {
        self.state(time + dt)
    }
}

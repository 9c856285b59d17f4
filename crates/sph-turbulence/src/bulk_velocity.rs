//! A flow rate that is held.

use sph_contribution::{
    Contribution, Offer, Refusal, Setting, StepPhase, contribution_kind, step_hook,
};
use sph_core::{Access, Axis, StepError, Work, fields, plugin};
use sph_neighbours::World;

contribution_kind!(
    /// A control of the flow rate that a scene may name.
    pub FlowControlEntry, "flow-control", One, "control of the flow rate of a periodic flow", .works(Work::Others)
);

/// After every kick all particles are pushed by U₀ − Σ m u/Σ m along an axis, so that the mean velocity is U₀: a body
/// force that answers the friction on the walls at once, and is the same everywhere.
///
/// The forces between particles sum to nothing, so that the mean of all particles has none of the noise that a slab's
/// has, and there is no gain to choose. In a steady flow the push equals the friction of the walls: measure it with
/// `wall-force`.
///
/// Source: Issa 2004, §3.1.3, Eq. 3.14–3.16, with the whole of the fluid for his slab and without his integrator.
///
/// ```toml
/// [flow-control.bulk-velocity]
/// velocity = "1.35 m/s"
/// ```
#[plugin(FlowControlEntry [2, 3], "bulk-velocity", "holds the mean velocity over mass",
    source: "Issa 2004, Eq. 3.14–3.16", cfg(not(test)))]
#[derive(Copy)]
pub struct BulkVelocity {
    /// Mean velocity U₀ over mass.
    #[parameter(unit: "m/s")]
    pub velocity: f64,
    /// Along which axis.
    #[parameter(default)]
    pub axis: Axis,
}

impl<const D: usize> Contribution<D> for BulkVelocity {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let axis = self.axis as usize;
        if axis < D && setting.world.domain.periodic[axis] {
            let access = Access::none()
                .here((fields::MASS, fields::VELOCITY))
                .writes(fields::VELOCITY);
            let (bulk, phases) = (self.velocity, &[StepPhase::AfterKick]);
            let hold = move |world: &mut World<D>, _| held(world, bulk, axis);
            offer.hook(step_hook("bulk velocity", access, phases, hold));
            return Ok(());
        }
        let why = "the flow rate is held along an axis in which the scene is periodic: name another, or give \
                   `[numerics.periodic]` this one";
        Err(Refusal::at_key("flow-control", "axis", why))
    }
}

/// Pushes all particles until their mean velocity along an axis is `bulk`, m/s.
fn held<const D: usize>(world: &mut World<D>, bulk: f64, axis: usize) -> Result<(), StepError> {
    let (velocity, mass) = world.free.all((fields::VELOCITY, fields::MASS))?;
    let [total, momentum] = world.sums(|i: usize| [mass[i], mass[i] * velocity[i][axis]])?;
    let push = bulk - momentum / total;
    let velocity = world.free.get_mut(fields::VELOCITY)?;
    velocity.iter_mut().for_each(|u| u[axis] += push);
    Ok(())
}

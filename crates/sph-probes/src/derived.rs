//! Fields that follow from velocity and viscosity, for outputs and probes that name them.
//!
//! A scene without them has no column, no stage and no velocity gradient for their sake.

use nalgebra::SMatrix;
use sph_core::{Access, AnyField, Declares, Stage, StepError, fields};
use sph_neighbours::World;

sph_core::fields! {
    pub SPEED: Scalar = "speed", "m/s", "length of the velocity";
    /// ω = ∂v/∂x − ∂u/∂y in the plane, positive where the fluid turns to the left.
    pub VORTICITY: Scalar = "vorticity", "1/s", "curl of the velocity, ∂v/∂x − ∂u/∂y in the plane";
    /// ω = ∇×u in space.
    pub VORTICITY_IN_SPACE: Vector = "vorticity", "1/s", "curl of the velocity";
    /// Q = ½(|Ω|² − |S|²): positive in vortices. Source: Hunt, Wray & Moin 1988.
    pub Q_CRITERION: Scalar = "q_criterion", "1/s²",
        "half of the squared rotation rate less the squared strain rate, positive in vortices";
    /// τ = η γ̇ with the viscosity of law and eddies; of an elastic law the viscous part alone.
    pub SHEAR_STRESS: Scalar = "shear_stress", "Pa",
        "viscosity times the magnitude of the strain rate; the viscous part alone";
}

/// Fields of this page and of the core that are made from the velocity gradient.
const OF_GRADIENTS: [&str; 5] = [
    "velocity_gradient",
    "strain_rate",
    "vorticity",
    "q_criterion",
    "shear_stress",
];

/// True if a field of that name needs the gradient of the velocity.
pub fn needs_gradient(name: &str) -> bool {
    OF_GRADIENTS.contains(&name)
}

/// Derived quantities and their formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Derived {
    Speed,
    Vorticity,
    QCriterion,
    ShearStress,
}

const ALL: [(Derived, &str); 4] = [
    (Derived::Speed, SPEED.name),
    (Derived::Vorticity, VORTICITY.name),
    (Derived::QCriterion, Q_CRITERION.name),
    (Derived::ShearStress, SHEAR_STRESS.name),
];

/// Names of the fields on request besides those that the plugins of a scene write.
pub fn derived_fields() -> impl Iterator<Item = &'static str> {
    ALL.iter().map(|(_, name)| *name)
}

/// The stages of the fields that are `shown`, and no others.
pub fn derived_stages<const D: usize>(shown: &[String]) -> Vec<Box<dyn Stage<World<D>>>> {
    let wanted = ALL
        .iter()
        .filter(|(_, name)| shown.iter().any(|s| s == name));
    wanted
        .map(|(what, _)| Box::new(DerivedStage::<D>(*what)) as Box<dyn Stage<World<D>>>)
        .collect()
}

/// The stage of one field.
struct DerivedStage<const D: usize>(Derived);

impl<const D: usize> DerivedStage<D> {
    fn written(&self) -> AnyField {
        match (self.0, D) {
            (Derived::Speed, _) => SPEED.any(),
            (Derived::Vorticity, 2) => VORTICITY.any(),
            (Derived::Vorticity, _) => VORTICITY_IN_SPACE.any(),
            (Derived::QCriterion, _) => Q_CRITERION.any(),
            (Derived::ShearStress, _) => SHEAR_STRESS.any(),
        }
    }
}

impl<const D: usize> Declares for DerivedStage<D> {
    fn name(&self) -> String {
        self.written().name.replace('_', " ")
    }
    fn access(&self) -> Access {
        let mut access = match self.0 {
            Derived::Speed => Access::none().here(fields::VELOCITY),
            Derived::Vorticity | Derived::QCriterion => {
                Access::none().here(fields::VELOCITY_GRADIENT)
            }
            Derived::ShearStress => Access::none()
                .here(fields::VISCOSITY)
                .here(fields::STRAIN_RATE),
        };
        access.writes.push(self.written());
        access
    }
}

impl<const D: usize> Stage<World<D>> for DerivedStage<D> {
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        let free = &mut world.free;
        let gradients = |world: &sph_core::Store<D>, f: fn(&SMatrix<f64, D, D>) -> f64| {
            let all = world.get(fields::VELOCITY_GRADIENT)?;
            Ok::<Vec<f64>, StepError>(all.iter().map(f).collect())
        };
        match (self.0, D) {
            (Derived::Speed, _) => {
                let speed = free.get(fields::VELOCITY)?.iter().map(|u| u.norm());
                let speed = speed.collect();
                free.put(SPEED, speed)?;
            }
            (Derived::Vorticity, 2) => {
                let turning = gradients(free, |g| g[(1, 0)] - g[(0, 1)])?;
                free.put(VORTICITY, turning)?;
            }
            (Derived::Vorticity, _) => {
                let all = free.get(fields::VELOCITY_GRADIENT)?.iter();
                let turning = all.map(|g| {
                    let around =
                        |k: usize| (g[((k + 2) % 3, (k + 1) % 3)], g[((k + 1) % 3, (k + 2) % 3)]);
                    sph_core::Vect::from_fn(|k, _| around(k).0 - around(k).1)
                });
                let turning = turning.collect();
                free.put(VORTICITY_IN_SPACE, turning)?;
            }
            (Derived::QCriterion, _) => {
                // |Ω|² − |S|² = −Σ G_ij G_ji, since the mixed terms cancel.
                let q = gradients(free, |g| -0.5 * (g * g).trace())?;
                free.put(Q_CRITERION, q)?;
            }
            (Derived::ShearStress, _) => {
                let viscosity = free.get(fields::VISCOSITY)?.iter();
                let both = viscosity.zip(free.get(fields::STRAIN_RATE)?);
                let stress = both.map(|(eta, rate)| eta * rate).collect();
                free.put(SHEAR_STRESS, stress)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_nobody_asks_for_is_made() {
        assert!(derived_stages::<2>(&[]).is_empty());
        let shown = ["pressure", "vorticity", "speed"].map(String::from);
        let names: Vec<String> = derived_stages::<3>(&shown)
            .iter()
            .map(|s| s.name())
            .collect();
        assert_eq!(names, ["speed", "vorticity"]);
    }
}

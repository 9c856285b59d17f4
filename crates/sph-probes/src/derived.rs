//! Fields that follow from velocity and viscosity, for outputs and probes that name them.
//!
//! A scene without them has no column, no stage and no velocity gradient for their sake.

use sph_core::{Access, Field, Kind, Stage, Tensor, Vect, fields, stage};
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

/// Names of the fields on request besides those that the plugins of a scene write.
pub fn derived_fields() -> impl Iterator<Item = &'static str> {
    let all = [SPEED, VORTICITY, Q_CRITERION, SHEAR_STRESS];
    all.into_iter().map(|field| field.name)
}

/// The stages of the fields that are `shown`, and no others.
pub fn derived_stages<const D: usize>(shown: &[String]) -> Vec<Box<dyn Stage<World<D>>>> {
    let gradient = fields::VELOCITY_GRADIENT;
    let in_plane = |g: &Gradient<D>| g[(1, 0)] - g[(0, 1)];
    let in_space = |g: &Gradient<D>| {
        Vect::from_fn(|k, _| g[((k + 2) % 3, (k + 1) % 3)] - g[((k + 1) % 3, (k + 2) % 3)])
    };
    let vorticity = match D {
        2 => of_one("vorticity", gradient, VORTICITY, in_plane),
        _ => of_one("vorticity", gradient, VORTICITY_IN_SPACE, in_space),
    };
    let access = Access::none()
        .here((fields::VISCOSITY, fields::STRAIN_RATE))
        .writes(SHEAR_STRESS);
    let shear_stress = stage("shear stress", access, |world: &mut World<D>| {
        let rates = world.free.get(fields::STRAIN_RATE)?;
        let both = world.free.get(fields::VISCOSITY)?.iter().zip(rates);
        let stress = both.map(|(eta, rate)| eta * rate).collect();
        Ok(world.free.put(SHEAR_STRESS, stress)?)
    });
    let all: [Box<dyn Stage<World<D>>>; 4] = [
        of_one("speed", fields::VELOCITY, SPEED, |u: &Vect<D>| u.norm()),
        vorticity,
        // |Ω|² − |S|² = −Σ G_ij G_ji, since the mixed terms cancel.
        of_one("q criterion", gradient, Q_CRITERION, |g: &Gradient<D>| {
            -0.5 * (g * g).trace()
        }),
        Box::new(shear_stress),
    ];
    let all = all.into_iter();
    all.filter(|stage| shown.iter().any(|s| s == stage.access().writes[0].name))
        .collect()
}

/// ∇u, 1/s.
type Gradient<const D: usize> = <Tensor as Kind>::Item<D>;

/// The stage of a field that follows from one other.
fn of_one<const D: usize, F: Kind + Send, K: Kind + Send>(
    name: &'static str,
    from: Field<F>,
    field: Field<K>,
    formula: fn(&F::Item<D>) -> K::Item<D>,
) -> Box<dyn Stage<World<D>>> {
    let access = Access::none().here(from).writes(field);
    Box::new(stage(name, access, move |world: &mut World<D>| {
        let values = world.free.get(from)?.iter().map(formula).collect();
        Ok(world.free.put(field, values)?)
    }))
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

//! Equations of state: pressure from density, and strain rate where it counts, on slices.

use std::sync::{Arc, OnceLock};

/// The state at which a phase has its reference density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// ρ₀, kg/m³.
    pub density: f64,
    /// Numerical speed of sound c₀, m/s.
    pub sound_speed: f64,
}

/// A law with its reference state.
pub trait BoundState: Send + Sync + std::fmt::Debug {
    /// p(ρ), Pa.
    fn pressure(&self, density: &[f64], pressure: &mut [f64]);
    /// True if the pressure depends on the strain rate as well; p(ρ) is then that at rest.
    fn needs_strain_rate(&self) -> bool {
        false
    }
    /// p(ρ, γ̇), Pa, with γ̇ = √(2 D:D) in 1/s; the strain rates may be empty for laws that do not need
    /// them.
    fn sheared_pressure(&self, density: &[f64], _strain_rate: &[f64], pressure: &mut [f64]) {
        self.pressure(density, pressure);
    }
    /// ρ(p), kg/m³.
    fn density(&self, pressure: f64) -> f64;
    /// c(ρ) = √(dp/dρ), m/s.
    fn sound_speed(&self, density: f64) -> f64;
    /// Elastic energy ∫ p/ρ² dρ from the reference state, J/kg.
    fn internal_energy(&self, density: f64) -> f64;
    /// The reference state.
    fn reference(&self) -> Reference;
    /// Pressure at the reference density, Pa.
    fn background(&self) -> f64 {
        let mut pressure = [0.0];
        self.pressure(&[self.reference().density], &mut pressure);
        pressure[0]
    }
}

/// The equations of state of a scene with their reference states, in the order of the phase numbers.
pub type Laws = Arc<[Box<dyn BoundState>]>;

/// A law p(ρ), or p(ρ, γ̇), of one phase.
pub trait EquationOfState: Send + Sync {
    /// The law for a phase.
    fn bind(&self, reference: Reference) -> Box<dyn BoundState>;
}

#[cfg(feature = "plugins")]
sph_core::contract!(
    /// An equation of state that a phase may name.
    pub EquationOfStateEntry, "equation-of-state", InPhase, "pressure from density, per phase", EquationOfState,
    .by_default("tait")
);

/// Pressure that is added to all laws of a scene, Pa: set once at most, before the first of them is used.
#[derive(Clone, Debug, Default)]
pub struct Lift(Arc<OnceLock<f64>>);

impl Lift {
    /// Sets it, Pa; a second value is of no account.
    pub fn set(&self, pressure: f64) {
        let _ = self.0.set(pressure);
    }

    fn get(&self) -> f64 {
        self.0.get().copied().unwrap_or(0.0)
    }
}

/// A law with a background pressure P: p(ρ) + P, and the energy P (1/ρ₀ − 1/ρ) besides its own.
#[derive(Debug)]
pub struct Lifted {
    law: Box<dyn BoundState>,
    lift: Lift,
}

impl Lifted {
    /// A law with what lifts it.
    #[must_use]
    pub fn new(law: Box<dyn BoundState>, lift: &Lift) -> Self {
        let lift = lift.clone();
        Self { law, lift }
    }

    fn raise(&self, pressure: &mut [f64]) {
        let lift = self.lift.get();
        if lift != 0.0 {
            pressure.iter_mut().for_each(|p| *p += lift);
        }
    }
}

impl BoundState for Lifted {
    fn pressure(&self, density: &[f64], pressure: &mut [f64]) {
        self.law.pressure(density, pressure);
        self.raise(pressure);
    }

    fn needs_strain_rate(&self) -> bool {
        self.law.needs_strain_rate()
    }

    fn sheared_pressure(&self, density: &[f64], strain_rate: &[f64], pressure: &mut [f64]) {
        self.law.sheared_pressure(density, strain_rate, pressure);
        self.raise(pressure);
    }

    fn density(&self, pressure: f64) -> f64 {
        self.law.density(pressure - self.lift.get())
    }

    fn sound_speed(&self, density: f64) -> f64 {
        self.law.sound_speed(density)
    }

    fn internal_energy(&self, density: f64) -> f64 {
        let own = self.law.internal_energy(density);
        match self.lift.get() {
            0.0 => own,
            lift => own + lift * (1.0 / self.reference().density - 1.0 / density),
        }
    }

    fn reference(&self) -> Reference {
        self.law.reference()
    }
}

#[cfg(test)]
mod tests {
    use crate::state::Tait;

    use super::*;

    #[test]
    fn a_lifted_law_is_that_with_the_background_pressure() {
        let reference = Reference {
            density: 1000.0,
            sound_speed: 20.0,
        };
        let background_pressure = 3e4;
        let with = Tait {
            background_pressure,
            ..Tait::default()
        };
        let lift = Lift::default();
        let lifted = Lifted::new(Tait::default().bind(reference), &lift);
        let mut none = [1.0];
        lifted.pressure(&[1000.0], &mut none);
        assert_eq!(none, [0.0]);
        lift.set(background_pressure);
        let with = with.bind(reference);
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} for {b}");
        for density in [970.0, 1020.0] {
            let (mut a, mut b) = ([0.0], [0.0]);
            lifted.pressure(&[density], &mut a);
            with.pressure(&[density], &mut b);
            near(a[0], b[0]);
            near(lifted.density(a[0]), with.density(b[0]));
            let energy = |law: &dyn BoundState| law.internal_energy(density);
            near(energy(&lifted), energy(&*with));
        }
    }
}

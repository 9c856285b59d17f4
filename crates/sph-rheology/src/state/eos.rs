//! Equations of state: pressure from density, and strain rate where it counts, on slices.

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
}

/// The equations of state of a scene with their reference states, in the order of the phase numbers.
pub type Laws = std::sync::Arc<[Box<dyn BoundState>]>;

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

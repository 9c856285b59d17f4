//! The packing at which shear changes no volume.

use sph_core::parameters;

/// State of the grains at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainState {
    /// Volume φ of the grains per volume of the soil, 1.
    pub packing: f64,
    /// γ̇, 1/s.
    pub strain_rate: f64,
    /// Effective pressure p', Pa; not negative.
    pub pressure: f64,
}

/// Expansion of a soil by shear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dilation {
    /// Growth of the volume per volume, 1/s; negative where the soil contracts.
    pub rate: f64,
    /// Its derivative with respect to the effective pressure, 1/(Pa s); not positive.
    pub slope: f64,
}

/// Packing φ_eq of steady shear: φ̇ = −φ γ̇ K (φ − φ_eq).
#[parameters]
#[derive(Copy)]
pub struct CriticalState {
    /// Packing φ_c of slow steady shear.
    #[parameter(unit: "1", above: 0.0, below: 1.0)]
    pub critical_packing: f64,
    /// K: tan ψ = K (φ − φ_eq).
    #[parameter(unit: "1", min: 0.0, source: "Roux and Radjai 1998; Pailha and Pouliquen 2009")]
    pub slope: f64,
    /// Packing of faster shear: a table `viscous` (with `viscosity`), `viscous-linear` (`viscosity`, `decrease`) or
    /// `inertial` (`grain_diameter`, `grain_density`, `decrease`); φ_c at all rates if left out.
    #[parameter(default)]
    pub equilibrium: Equilibrium,
    /// Packing that no state exceeds; the run ends beyond.
    #[parameter(default: 0.74, unit: "1", above: 0.0, below: 1.0, source: "equal spheres")]
    pub densest_packing: f64,
}

/// Packing φ_eq of steady shear at a rate.
///
/// | choice | φ_eq | number |
/// |---|---|---|
/// | `viscous` | φ_c/(1 + √J) | J = ηγ̇/p' |
/// | `viscous-linear` | φ_c − b J | |
/// | `inertial` | φ_c − b I | I = γ̇ d √(ρ_g/p') |
///
/// Sources: Boyer et al. 2011; Pailha and Pouliquen 2009; da Cruz et al. 2005.
#[parameters]
#[derive(Copy, PartialEq)]
pub enum Equilibrium {
    /// φ_c.
    #[default]
    Slow,
    /// Grains in a viscous fluid.
    Viscous {
        /// Viscosity η of the fluid.
        #[parameter(unit: "Pa s", above: 0.0)]
        viscosity: f64,
    },
    /// The same, linear in J.
    ViscousLinear {
        /// Viscosity η of the fluid.
        #[parameter(unit: "Pa s", above: 0.0)]
        viscosity: f64,
        /// Decrease b.
        #[parameter(unit: "1", min: 0.0)]
        decrease: f64,
    },
    /// Dry grains.
    Inertial {
        /// Diameter d of the grains.
        #[parameter(unit: "m", above: 0.0)]
        grain_diameter: f64,
        /// Density ρ_g of the grains themselves.
        #[parameter(unit: "kg/m³", above: 0.0)]
        grain_density: f64,
        /// Decrease b.
        #[parameter(unit: "1", min: 0.0)]
        decrease: f64,
    },
}

/// Pressure below which quotients are those at it, Pa.
const LEAST_PRESSURE: f64 = 1e-9;

impl CriticalState {
    /// φ_eq and its derivative with respect to the pressure, 1/Pa.
    pub fn equilibrium(&self, strain_rate: f64, pressure: f64) -> (f64, f64) {
        let (critical, p) = (self.critical_packing, pressure.max(LEAST_PRESSURE));
        let linear = |decrease: f64, number: f64, exponent: f64| {
            let packing = critical - decrease * number;
            match packing > 0.0 {
                true => (packing, exponent * decrease * number / p),
                false => (0.0, 0.0),
            }
        };
        match self.equilibrium {
            Equilibrium::Slow => (critical, 0.0),
            Equilibrium::Viscous { viscosity } => {
                let root = (viscosity * strain_rate / p).sqrt();
                let packing = critical / (1.0 + root);
                (packing, packing * 0.5 * root / ((1.0 + root) * p))
            }
            Equilibrium::ViscousLinear {
                viscosity,
                decrease,
            } => linear(decrease, viscosity * strain_rate / p, 1.0),
            Equilibrium::Inertial {
                grain_diameter,
                grain_density,
                decrease,
            } => {
                let number = strain_rate * grain_diameter * (grain_density / p).sqrt();
                linear(decrease, number, 0.5)
            }
        }
    }

    /// tan ψ = K (φ − φ_eq).
    pub fn angle(&self, state: &GrainState) -> f64 {
        let (packing, _) = self.equilibrium(state.strain_rate, state.pressure);
        self.slope * (state.packing - packing)
    }

    /// γ̇ tan ψ.
    pub fn dilation(&self, state: &GrainState) -> Dilation {
        let (packing, derivative) = self.equilibrium(state.strain_rate, state.pressure);
        let strength = state.strain_rate * self.slope;
        Dilation {
            rate: strength * (state.packing - packing),
            slope: -strength * derivative,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beads(equilibrium: Equilibrium) -> CriticalState {
        CriticalState {
            critical_packing: 0.582,
            slope: 4.09,
            equilibrium,
            densest_packing: 0.64,
        }
    }

    fn all() -> [CriticalState; 4] {
        let viscosity = 0.096;
        [
            Equilibrium::Slow,
            Equilibrium::Viscous { viscosity },
            Equilibrium::ViscousLinear {
                viscosity,
                decrease: 25.0,
            },
            Equilibrium::Inertial {
                grain_diameter: 160e-6,
                grain_density: 2500.0,
                decrease: 0.2,
            },
        ]
        .map(beads)
    }

    fn dilation(law: &CriticalState, packing: f64, [strain_rate, pressure]: [f64; 2]) -> Dilation {
        law.dilation(&GrainState {
            packing,
            strain_rate,
            pressure,
        })
    }

    #[test]
    fn packings_are_those_by_hand() {
        // J = 0.096 · 2/30 = 0.0064, √J = 0.08; I = 2 · 160e-6 √(2500/30) = 2.921e-3.
        let packings = all().map(|law| law.equilibrium(2.0, 30.0).0);
        let inertial = 0.582 - 0.2 * 2.921_187e-3;
        let by_hand = [0.582, 0.582 / 1.08, 0.582 - 0.16, inertial];
        for (packing, by_hand) in packings.iter().zip(by_hand) {
            assert!((packing - by_hand).abs() < 1e-9, "{packing} for {by_hand}");
        }
    }

    #[test]
    fn slopes_are_those_of_differences() {
        for law in all() {
            for pressure in [3.0, 30.0, 300.0] {
                let at = |pressure: f64| dilation(&law, 0.57, [0.5, pressure]);
                let step = 1e-4 * pressure;
                let difference = at(pressure + step).rate - at(pressure - step).rate;
                let slope = at(pressure).slope;
                let error = difference / (2.0 * step) - slope;
                assert!(error.abs() < 1e-6 * slope.abs() + 1e-12, "{law:?} {error}");
            }
        }
    }

    #[test]
    fn loose_grains_contract_and_dense_ones_dilate() {
        for law in all() {
            let rate = |packing: f64| dilation(&law, packing, [0.01, 50.0]).rate;
            assert!(rate(0.55) < 0.0 && rate(0.60) > 0.0);
        }
    }

    #[test]
    fn grains_without_pressure_expand_at_any_packing() {
        let law = beads(Equilibrium::Viscous { viscosity: 0.096 });
        let found = dilation(&law, 0.3, [1.0, 0.0]);
        assert!(found.rate > 0.0 && found.rate.is_finite() && found.slope.is_finite());
    }
}

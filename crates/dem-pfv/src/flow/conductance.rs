//! Conductances of throats.

use std::f64::consts::PI;

use sph_core::{Registry, plugin};
use toml::Table;

use crate::flow::{FlowError, Throat};
use crate::require;

/// A law for the conductance of throats.
pub trait Conductance: Send + Sync {
    /// g µ (m⁴) with the flux q = g (p_i − p_j) / L. Zero closes a throat.
    fn conductance(&self, throat: &Throat) -> f64;

    /// Checks the parameters.
    ///
    /// # Errors
    /// The parameter and its value: [`require`].
    fn check(&self) -> Result<(), FlowError> {
        Ok(())
    }
}

sph_core::contract!(
    /// A law for the conductance of throats by its name.
    pub ConductanceEntry,
    "conductance",
    Elsewhere,
    "the conductance of a throat between two pores, in [fluid.conductance.LAW]",
    Conductance,
    .in_space()
);

/// The conductance of that name with these parameters.
///
/// # Errors
/// None or two of that name; an unknown parameter; a value out of range.
///
/// ```
/// use dem_pfv::flow::conductance;
///
/// let with = |parameters: &str| conductance("hydraulic-radius", &parameters.parse().expect("TOML"));
/// assert!(with("shape_factor = 0.5").is_ok());
/// assert!(with("shape_factor = -1.0").err().is_some_and(|e| e.to_string().contains("shape_factor")));
/// ```
pub fn conductance(name: &str, parameters: &Table) -> Result<Box<dyn Conductance>, FlowError> {
    let registry = Registry::<ConductanceEntry>::discovered()?;
    let law = (registry.find(name)?.build)(parameters)?;
    law.check()?;
    Ok(law)
}

/// g = α A R² / µ with the fluid area A of the facet and the hydraulic radius R = φ/γ; α = ½ is that of
/// a round tube of radius 2R. Source: Catalano 2012, Eqs. (3.4), (3.5).
#[plugin(
    ConductanceEntry,
    "hydraulic-radius",
    "a tube with the throat's ratio of fluid volume to wetted surface",
    source: "Catalano 2012, Eqs. (3.4), (3.5)"
)]
#[derive(PartialEq)]
pub struct HydraulicRadius {
    /// Shape factor α.
    #[parameter(default: 0.5, unit: "1", above: 0.0)]
    pub shape_factor: f64,
    /// Divides R by 2^¼ for each slip wall of a throat, as YADE 2023.02a does; not in the thesis, and it halves
    /// the conductance beside walls of symmetry. For comparison with YADE.
    #[parameter(default)]
    pub reduced_at_slip_walls: bool,
}

impl Conductance for HydraulicRadius {
    fn conductance(&self, throat: &Throat) -> f64 {
        let mut radius = throat.hydraulic_radius();
        if self.reduced_at_slip_walls {
            radius *= 2.0_f64.powf(-0.25 * throat.slip_walls as f64);
        }
        self.shape_factor * throat.fluid_area.max(0.0) * radius * radius
    }

    fn check(&self) -> Result<(), FlowError> {
        let what = "the shape factor of the conductance \"hydraulic-radius\" is";
        Ok(require(
            what,
            self.shape_factor,
            "positive",
            self.shape_factor > 0.0,
        )?)
    }
}

/// g = 2π R⁴ / µ with R = ¼ (√(A/π) + r), A the fluid area and r the radius of the inscribed circle.
/// Source: Bryant & Blunt 1992; Catalano 2012, Eq. (3.6).
#[plugin(
    ConductanceEntry,
    "effective-radius",
    "a tube between the throat's inscribed circle and the circle of its area; about half as permeable",
    source: "Bryant & Blunt 1992; Catalano 2012, Eq. (3.6)"
)]
#[derive(PartialEq)]
pub struct EffectiveRadius {}

impl EffectiveRadius {
    /// R, m.
    pub fn radius(throat: &Throat) -> f64 {
        0.25 * ((throat.fluid_area.max(0.0) / PI).sqrt() + throat.inscribed_radius)
    }
}

impl Conductance for EffectiveRadius {
    fn conductance(&self, throat: &Throat) -> f64 {
        2.0 * PI * Self::radius(throat).powi(4)
    }
}

//! The table `[phase.NAME]`: one material.

use sph_core::parameters;

use crate::reading::plugins::{AnyPlugins, Plugins};

/// A material: its density, how it resists compression and how it flows.
#[parameters]
pub struct Phase {
    /// Reference density, kg/m³.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Equation of state, `[phase.NAME.equation-of-state.PLUGIN]`; chosen by the solver if left out.
    #[serde(rename = "equation-of-state")]
    #[parameter(default)]
    #[schemars(with = "AnyPlugins", extend("maxProperties" = 1))]
    pub equation_of_state: Plugins,
    /// Rheology, `[phase.NAME.rheology.PLUGIN]`, exactly one.
    #[schemars(with = "AnyPlugins", extend("minProperties" = 1), extend("maxProperties" = 1))]
    pub rheology: Plugins,
    /// Numerical speed of sound, m/s; ten times the largest of `velocity_scale` and √(gH) if left out.
    #[parameter(unit: "m/s", above: 0.0, quantity: "speed of sound")]
    pub speed_of_sound: Option<f64>,
    /// Largest speed that is expected, m/s; used to choose the speed of sound.
    #[parameter(unit: "m/s", above: 0.0)]
    pub velocity_scale: Option<f64>,
}

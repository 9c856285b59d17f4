//! What lets water through the pores of soils.

use sph_contribution::StepHook;
use sph_core::{Field, Scalar, Vector, contract};
use sph_state::Laws;

/// Flux of the water through the pores, relative to the grains: volume per area and time. 0 outside of soils.
pub const SEEPAGE_VELOCITY: Field<Vector> = Field::new(
    "seepage_velocity",
    "m/s",
    "flux of the water through the pores, relative to the grains",
);

/// Pressure of the water that seeps, in the pores and beside the soil; 0 elsewhere.
pub const SEEPAGE_PRESSURE: Field<Scalar> = Field::new(
    "seepage_pressure",
    "Pa",
    "pressure of the water that seeps through a soil",
);

/// What a law of seepage learns of the phases.
pub struct SeepagePhases<'a> {
    /// Their names, in the order of their numbers.
    pub names: &'a [String],
    /// Their equations of state.
    pub laws: &'a Laws,
    /// The scalar that the formulation integrates for the density.
    pub density: Field<Scalar>,
}

/// A key of the plugin's table, and what is wrong with it.
pub type SeepageProblem = (&'static str, String);

/// A law of the flow through pores.
pub trait Seepage<const D: usize>: Send {
    /// The flow between the phases that the scene names, as a hook of every kick.
    ///
    /// # Errors
    /// The key whose value does not fit the scene.
    fn flow(&self, phases: &SeepagePhases<'_>) -> Result<Box<dyn StepHook<D>>, SeepageProblem>;
}

contract!(
    /// A law of seepage that a scene may name.
    pub SeepageEntry, "seepage", "the flow of water through the pores of a soil", Seepage<D>
);

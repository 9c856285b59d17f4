//! The blended quantity of a soil that yields.

use sph_core::parameters;

/// Blended quantities where a soil yields from a solid to a liquid.
#[parameters]
pub enum Blend {
    /// div(ζτ_l + (1 − ζ)τ_s): a stress, so that action is reaction.
    #[default]
    Stresses,
    /// ζ_a f_l + (1 − ζ_a) f_s, as printed: action is not reaction where ζ < 1. What water rubs off the soil is left
    /// out of the blend. Not with an implicit viscosity.
    Forces,
}

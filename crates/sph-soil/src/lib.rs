//! Soils and other materials with a constitutive law.
//!
//! * [`stress`]: velocity gradients, viscosities, elastic stresses and effective pressures for the laws.
//! * [`dilatancy`]: laws of soils that expand or contract by shear.
//! * [`pores`]: packing of soils, and the excess pressure in their pores.
//! * [`sediment`]: bed load, and the beds that it moves.
//! * [`seepage`]: water that moves through the pores of a soil.

// Unit tests name no plugin. Without registration they compile what they call, not all loops of the crate again.
#![cfg_attr(
    test,
    allow(
        unused_imports,
        dead_code,
        reason = "plugins are not registered in unit tests"
    )
)]

pub mod dilatancy;
pub mod pores;
pub mod sediment;
pub mod seepage;
pub mod stress;

//! Soils and other materials with a constitutive law.
//!
//! * [`stress`]: velocity gradients, viscosities, elastic stresses and effective pressures for the laws.
//! * [`sediment`]: bed load, and the beds that it moves.
//! * [`seepage`]: water that moves through the pores of a soil.

pub mod sediment;
pub mod seepage;
pub mod stress;

//! Soils and other materials with a constitutive law.
//!
//! * [`stress`]: velocity gradients, viscosities, elastic stresses and effective pressures for the laws.
//! * [`seepage`]: water that moves through the pores of a soil.

pub mod seepage;
pub mod stress;

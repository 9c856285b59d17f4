//! Constitutive laws on slices: no particles, no neighbours.
//!
//! A [`Rheology`] says what it [`Needs`] and turns it into an effective viscosity. The crate
//! knows nothing of kernels or walls; an embedder hands it slices and gets slices back.
//!
//! ```
//! use sph_rheology::{Inputs, Newtonian, Rheology};
//!
//! let water = Newtonian { viscosity: 1.0e-3 };
//! let mut viscosity = [0.0; 2];
//! water.viscosity(&Inputs::default(), &mut viscosity);
//! assert_eq!(viscosity, [1.0e-3; 2]);
//! ```

mod bingham;
mod carreau;
mod casson;
mod contract;
mod cross;
mod herschel_bulkley;
mod newtonian;
mod power_law;
mod regularisation;

pub use bingham::Bingham;
pub use carreau::Carreau;
pub use casson::Casson;
pub use contract::{Elastic, Inputs, Needs, Rheology, RheologyEntry};
pub use cross::Cross;
pub use herschel_bulkley::HerschelBulkley;
pub use newtonian::Newtonian;
pub use power_law::PowerLaw;
pub use regularisation::Regularisation;

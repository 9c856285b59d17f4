//! Constitutive laws on slices: no particles, no neighbours.
//!
//! A [`Rheology`] declares what it [`Needs`] and turns it into an effective viscosity; one that is
//! [`Elastic`] also advances a stress that it remembers. The crate has no kernels and no
//! walls; an embedder hands it slices and gets slices back. Equations of state are in [`state`].
//!
//! With the feature `plugins`, which is on unless it is turned off, scenes can name the laws. Without it they are the
//! same types, and all that comes along are the crates of derive macros.
//!
//! ```
//! use sph_rheology::{Bingham, Inputs, Newtonian, Regularisation, Rheology};
//!
//! let water = Newtonian { viscosity: 1.0e-3 };
//! let mut viscosity = [0.0; 2];
//! water.viscosity(&Inputs::default(), &mut viscosity);
//! assert_eq!(viscosity, [1.0e-3; 2]);
//!
//! let mud = Bingham {
//!     viscosity: 1.0,
//!     yield_stress: 25.0,
//!     regularisation: Regularisation::Papanastasiou { stress_growth: 10.0 },
//! };
//! let inputs = Inputs { strain_rate: &[0.0, 50.0], pressure: &[] };
//! mud.viscosity(&inputs, &mut viscosity);
//! assert_eq!(viscosity, [251.0, 1.5]);
//! ```

mod bingham;
mod carreau;
mod casson;
mod cone;
mod contract;
mod cross;
mod drucker_prager;
mod elastic;
mod herschel_bulkley;
pub mod jaumann;
mod mohr_coulomb;
mod mu_i;
#[cfg(feature = "plugins")]
mod nature;
mod newtonian;
mod power_law;
mod regularisation;
pub mod rheometer;
pub mod state;

pub use bingham::Bingham;
pub use carreau::Carreau;
pub use casson::Casson;
pub use cone::Cone;
#[cfg(feature = "plugins")]
pub use contract::RheologyEntry;
pub use contract::{Elastic, Gradient, Inputs, Needs, Rheology, Yielding};
pub use cross::Cross;
pub use drucker_prager::DruckerPrager;
pub use elastic::ElasticSolid;
pub use herschel_bulkley::HerschelBulkley;
pub use mohr_coulomb::MohrCoulomb;
pub use mu_i::{MuI, MuIRegularisation};
pub use newtonian::Newtonian;
pub use power_law::PowerLaw;
pub use regularisation::Regularisation;

#[cfg(feature = "plugins")]
use sph_core::{parameters, plugin};
#[cfg(not(feature = "plugins"))]
use sph_derive::{plain_parameters as parameters, plain_plugin as plugin};

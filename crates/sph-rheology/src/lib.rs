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

mod contract;
mod drucker_prager;
mod elastic;
mod generalised_newtonian;
pub mod jaumann;
mod mohr_coulomb;
mod mu_i;
#[cfg(feature = "plugins")]
mod nature;
mod newtonian;
mod regularisation;
pub mod rheometer;
pub mod state;
mod yield_stress;

#[cfg(feature = "plugins")]
pub use contract::RheologyEntry;
pub use contract::{Elastic, Gradient, Inputs, Needs, Rheology, Yielding};
pub use drucker_prager::{Cone, DruckerPrager};
pub use elastic::ElasticSolid;
pub use generalised_newtonian::{Carreau, Cross, GeneralisedNewtonian, PowerLaw};
pub use mohr_coulomb::MohrCoulomb;
pub use mu_i::{MuI, MuIRegularisation};
pub use newtonian::Newtonian;
pub use regularisation::Regularisation;
pub use yield_stress::{Bingham, Casson, HerschelBulkley};

#[cfg(feature = "plugins")]
use sph_core::{parameters, plugin};
#[cfg(not(feature = "plugins"))]
use sph_derive::{plain_parameters as parameters, plain_plugin as plugin};

//! Viscosities of eddies that particles do not resolve.

use sph_contribution::{Contribution, contribution_kind};
use sph_core::Work;

contribution_kind!(
    /// A turbulence model that acts as a viscosity η_t beside that of the laws: τ = 2 (η + η_t) D. Those of this project are in
    /// `sph-turbulence`.
    ///
    /// It offers a stage that writes [`EDDY_VISCOSITY`](sph_core::fields::EDDY_VISCOSITY), Pa s. The stage may read the
    /// velocity gradient and the strain rate, whether or not a law needs them, and writes zero where there is no turbulence, as
    /// within a soil. An implicit step takes η_t of its beginning.
    pub EddyViscosityEntry, "eddy-viscosity", One, "viscosity of eddies that particles do not resolve",
    .ordered(50).works(Work::Friction)
);

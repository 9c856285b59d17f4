//! Creeping flow between spheres, one pressure per pore: pressures, fluxes and forces on the grains.
//!
//! Each cell of the regular triangulation is a pore, each facet between two cells a throat. A throat's
//! conductance follows from the exact geometry of spheres cut by facets; the balance of every pore gives
//! one sparse symmetric positive definite system for the pressures (Catalano 2012, ch. 3 and 4):
//!
//! ```text
//! Σ_j k_ij (p_i − p_j) = −dV_i/dt + Q_i,     k_ij = g_ij / L_ij   (m³ Pa⁻¹ s⁻¹)
//! ```
//!
//! * [`PoreGeometry`]: cells and [`Throat`]s of spheres in a box, by signed [`SolidAngles`].
//! * [`Conductance`]: [`HydraulicRadius`], [`EffectiveRadius`], or a plugin of your own: [`ConductanceEntry`].
//! * [`Boundary`]: pressures and inflows on any part of a wall, in any cell.
//! * [`FlowSystem`]: the system, its [`Solver`], compressibility of the fluid, permeability.
//! * [`Forces`]: pressure and viscous forces on spheres and walls; [`Edge`]: neighbours and the faces between them.
//!
//! No grain moves here: the caller that moves them gives rates of the cells' volumes ([`cell_volumes`]).
//!
//! ```
//! use dem_pfv::flow::{Boundary, FlowSystem, SlipCondition, HydraulicRadius, PoreGeometry, SolidAngles, Solver};
//! use dem_pfv::triangulation::{Sphere, Triangulation, Wall};
//!
//! let mesh = Triangulation::within(&[Sphere::new([0.5; 3], 0.3)], &Wall::cuboid([0.0; 3], [1.0; 3]))?;
//! let geometry = PoreGeometry::new(mesh, &[SlipCondition::NoSlip; 6], SolidAngles::Signed)?;
//! let mut boundary = Boundary::closed(&geometry);
//! boundary.pressure(&geometry, 2, |_| Some(0.0)); // the wall y = 0, Pa
//! boundary.pressure(&geometry, 3, |_| Some(1.0)); // the wall y = 1
//! let mut system = FlowSystem::new(&geometry, &boundary, &HydraulicRadius::default(), 1e-3, None, Solver::Direct)?;
//! let pressures = system.solve(&boundary, &[])?;
//! let inflow = system.inflow(&geometry, 3, &pressures); // m³/s
//! assert!(inflow > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod assembly;
mod facet;
mod forces;
mod geometry;
mod system;
mod throat;

pub use crate::error::FlowError;
pub use assembly::Boundary;
pub use facet::solid_angle;
pub use forces::Forces;
pub(crate) use forces::UnitForces;
pub use geometry::{Edge, PoreGeometry, cell_volumes};
pub use system::{FlowSystem, Solver, Storage};
pub use throat::{Conductance, ConductanceEntry, EffectiveRadius, HydraulicRadius};
pub use throat::{SlipCondition, SolidAngles, Throat};

//! Grains that move and the fluid in their pores: discrete elements coupled both ways to a pore-scale flow.
//!
//! Each step, pores that shrink press their fluid out, pressures push grains, grains move (Catalano 2012, ch. 4).
//!
//! * [`CoupledSystem`]: steps grains and flow together; [`FlowSetup`], [`Fluid`], [`WallBoundary`] and [`FlowCondition`] are what
//!   it starts from, [`Wave`] the load of waves on a bed.
//! * [`Fluid::shear`], [`Lubrication`]: forces between neighbours besides the pores' pressures, if chosen.
//! * [`Remeshing`]: when pores are found anew. [`StepLimit`]: the largest stable step, of contacts and drag.
//! * [`CoupledSystem::layer_pressure`], [`CoupledSystem::gradient`], [`GrainSystem::effective_stress`](crate::grains::GrainSystem::effective_stress),
//!   [`CoupledSystem::mobility`]: measures.
//! * [`State`]: saved, and resumed to the same bits. [`CoupledError`]: refusals, by grain, wall or cell.
//! * [`Terzaghi`]: the exact consolidation that a loaded packing is compared with.
//!
//! ```
//! use dem_pfv::coupled::{CoupledSystem, FlowSetup, Fluid, WallBoundary};
//! use dem_pfv::grains::{Grain, GrainSystem, LinearElastic, Setup, Wall};
//!
//! // A ball sinks in a closed box under a free surface, slower than it would fall.
//! let ball = Grain::new([0.5, 0.5, 0.5], 0.2, 2600.0);
//! let walls = Wall::cuboid([0.0; 3], [1.0; 3]);
//! let setup = Setup::new(vec![ball], LinearElastic::new(1e6, 0.5, 0.3)).walls(walls);
//! let grains = GrainSystem::new(setup.gravity([0.0, 0.0, -9.81]))?;
//! let water = FlowSetup::new(Fluid::new(100.0, 1000.0)).side(5, WallBoundary::drained(0.0));
//! let mut system = CoupledSystem::new(grains, water)?;
//! system.run_to(0.05, 0.8)?;
//! let speed = -system.grains().grains.velocity[0].z;
//! assert!(speed > 0.0 && speed < 9.81 * 0.05 * (1.0 - 1.0 / 2.6));
//! # Ok::<(), dem_pfv::coupled::CoupledError>(())
//! ```

mod condition;
mod limit;
mod measure;
mod pores;
mod setup;
mod system;

pub use crate::Vector;
pub use crate::error::{CoupledError, StepLimit};
pub use condition::{FlowCondition, Recorded, WallBoundary, Wave};
pub use measure::{State, Terzaghi};
pub use setup::{FlowSetup, Fluid, Lubrication, Remeshing};
pub use system::{CoupledSystem, PoreState};

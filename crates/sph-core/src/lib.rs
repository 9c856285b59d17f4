//! The shared vocabulary of the workspace: what a field, a plugin, a stage and an error are.
//! There is no physics here.
//!
//! * [`Field`] and [`Store`]: one column per field, allocated only when a stage or term declared it.
//! * [`contract!`] and [`plugin`]: how a crate offers plugins of a kind, with typed
//!   parameters whose unit, default, meaning and source travel with them.
//! * [`Declares`], [`Stage`] and [`plan()`]: stages declare what they read at the particle, what
//!   they read at its neighbours and what they write; the planner prunes and orders them.
//! * [`StepLimit`]: a plugin's own largest stable time step, with its reason.
//! * [`number`]: how numbers are written for people.
//!
//! ```
//! use sph_core::{Field, Role, Scalar, Store};
//!
//! const DENSITY: Field<Scalar> = Field::new("density", "kg/m³", "mass per volume");
//! let mut store = Store::<2>::new(3);
//! store.add(DENSITY, Role::State);
//! store.get_mut(DENSITY).unwrap().fill(1000.0);
//! assert_eq!(store.get(DENSITY).unwrap(), [1000.0; 3]);
//! ```

mod axis;
mod boxes;
pub mod course;
mod duct;
mod error;
mod evolve;
mod field;
pub mod fields;
mod insertion;
mod kinds;
mod limit;
mod parcel;
mod plan;
mod plugin_choice;
mod plugin_info;
mod pool;
mod registry;
mod removal;
mod saved;
mod slots;
mod stage;
mod store;
mod symmetric;
mod turnover;
mod watch;

pub use axis::Axis;
pub use boxes::{BoxTree, Corners, bounds};
pub use duct::rectangular_duct;
pub use error::{FieldError, PlanError, RegistryError, StepError};
pub use evolve::{Evolved, Recall, System};
pub use field::{AnyField, Field, Index, Kind, Scalar, Shape, SymmetricTensor, Tensor, Vector};
pub use kinds::{Place, PluginKind, Work, kind_of, kinds};
pub use limit::StepLimit;
pub use plan::{Plan, plan};
pub use plugin_choice::PluginChoice;
pub use plugin_info::PluginInfo;
pub use pool::{Pool, PoolGuard};
pub use registry::{
    Contract, Makes, Parameter, Registry, node_of, parameters, plugins_of, schema_of, typed,
};
pub use saved::Saved;
pub use scene_text::{
    Dimensions, MOST_PROBLEMS, SceneProblem, conform, defaults, nearest, number, parse_quantity,
    parse_unit, plausible, suggestion, unit_factor,
};
pub use slots::Slots;
pub use sph_derive::{parameters, plugin};
pub use stage::{Access, Declares, Stage};
pub use store::{Plain, Role, Store};
pub use symmetric::Symmetric;
pub use turnover::{Inserted, Removed};

/// Crates that the registration macros name; use them through the macros only.
#[doc(hidden)]
pub mod reexport {
    pub use inventory;
    pub use schemars;
    pub use serde;
    pub use toml;
}

/// A vector of D components, SI units of whatever it holds.
pub type Vect<const D: usize> = nalgebra::SVector<f64, D>;

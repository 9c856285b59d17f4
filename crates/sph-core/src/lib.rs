//! The shared vocabulary of the workspace: fields, plugins, stages and errors. There is no physics here.
//!
//! * [`Field`] and [`Store`]: one column per field, allocated only when a stage or term declared it.
//! * [`contract!`] and [`plugin`]: how a crate offers plugins of a kind, with typed
//!   parameters whose unit, default, meaning and source travel with them.
//! * [`Declares`], [`Stage`] and [`plan()`]: stages declare what they read at the particle, what
//!   they read at its neighbours and what they write; the planner prunes and orders them.
//! * [`StepLimit`]: a plugin's own largest stable time step, with its reason.
//! * [`number`]: how numbers are written for people.
//!
//! Without the feature `plugins` there are only the parts that need no other crate: [`BoxTree`], [`Winding`],
//! [`Symmetric`], [`course`], [`rectangular_duct`], [`nearest_place`], [`Pool`] and [`Slots`].
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

// Attributes of parameters name this crate.
#[cfg(feature = "plugins")]
extern crate self as sph_core;

#[cfg(feature = "plugins")]
mod axis;
pub mod bed;
mod boxes;
pub mod course;
mod duct;
#[cfg(feature = "plugins")]
pub mod editors;
#[cfg(feature = "plugins")]
mod error;
#[cfg(feature = "plugins")]
mod evolve;
#[cfg(feature = "plugins")]
mod field;
#[cfg(feature = "plugins")]
mod field_list;
#[cfg(feature = "plugins")]
pub mod fields;
#[cfg(feature = "plugins")]
mod kinds;
#[cfg(feature = "plugins")]
mod parcel;
pub mod place_cells;
#[cfg(feature = "plugins")]
mod plan;
mod pool;
mod random;
#[cfg(feature = "plugins")]
mod registry;
#[cfg(feature = "plugins")]
mod saved;
mod sets;
mod simplex;
mod slots;
#[cfg(feature = "plugins")]
mod stage;
#[cfg(feature = "plugins")]
mod store;
mod symmetric;
#[cfg(feature = "plugins")]
mod turnover;
#[cfg(feature = "plugins")]
mod walls;
#[cfg(feature = "plugins")]
mod watch;
mod winding;

pub use boxes::{BoxTree, Corners, bounds};
pub use duct::rectangular_duct;
pub use pool::{Pool, PoolGuard};
pub use random::SplitMix;
pub use sets::Sets;
pub use simplex::{Feature, nearest_place};
pub use slots::Slots;
pub use symmetric::Symmetric;
pub use winding::Winding;

#[cfg(feature = "plugins")]
pub use crate::{
    axis::Axis,
    error::{FieldError, PlanError, RegistryError, StepError},
    evolve::{Evolved, Recall, StepLimit, System},
    field::{
        AnyField, Field, Index, Kind, Scalar, Shape, SymmetricTensor, Tensor, Vector, labelled,
        some_unit, unit_suffix,
    },
    field_list::FieldList,
    kinds::{
        FlowNature, LawNature, LawNatures, Place, PluginInfo, PluginKind, SuitedPlugin, Suits,
        Work, kind_of, kinds,
    },
    plan::{Plan, plan},
    registry::{
        Build, Contract, Makes, Parameter, PluginChoice, Registry, node_of, parameters, plugins_of,
        schema_of, typed,
    },
    stage::{Access, Declares, Stage, stage},
    store::{Inserted, Plain, Removed, Role, Store},
    walls::{Erodible, FrictionForm, SlipCondition, WallCondition},
};
#[cfg(feature = "plugins")]
pub use scene_text::{
    Dimensions, MOST_PROBLEMS, SceneProblem, comma_list, conform, defaults, is_within, nearest,
    number, parse_quantity, parse_unit, plausible, suggestion, unit_factor,
};
#[cfg(feature = "plugins")]
pub use sph_derive::{parameters, plugin};

/// Crates that the registration macros name; use them through the macros only.
#[cfg(feature = "plugins")]
#[doc(hidden)]
pub mod reexport {
    pub use inventory;
    pub use schemars;
    pub use serde;
    pub use toml;
}

/// A vector of D components, SI units of its quantity.
#[cfg(feature = "plugins")]
pub type Vect<const D: usize> = nalgebra::SVector<f64, D>;

//! Scene files: from a TOML text to plain validated data and particle positions.
//!
//! A scene is data. This crate knows no kernel, no wall treatment and no rheology: every table
//! that names a plugin is kept as it stands ([`PluginChoice`]) and handed to whoever builds
//! plugins. What it does know is the form of a scene, its units, its geometry, and how to say
//! where a mistake is.
//!
//! The way of a scene:
//! 1. [`load`] reads a file (or [`parse`] a text), puts [`Override`]s on top (`--set`), holds
//!    the result against the schema of [`Scene`], converts "10 kPa" to pascals, and checks what
//!    a schema cannot say: names that must exist, lengths of vectors, shapes, overlaps.
//! 2. Every mistake becomes a [`Diagnostic`] with file, line, column and span, all of them at
//!    once, sorted by position. Problems found later (a plugin refuses a parameter) become
//!    diagnostics through the same [`Source`].
//! 3. [`Scene::regions`] gives the bodies as [`Region`]s; [`estimate`] counts their particles
//!    without allocating any, [`fill`] places them, [`disturb`] displaces them.
//! 4. [`schema`] is the JSON schema of scenes with all plugins of the binary, for editors.
//!
//! ```
//! let text = r#"
//! title = "Still water"
//! dimension = 2
//! [run]
//! end = "1 s"
//! [numerics]
//! spacing = "10 cm"
//! gravity = [0.0, -9.81]
//! [phase.water]
//! density = "1 g/cm^3"
//! [phase.water.rheology.newtonian]
//! viscosity = "1e-3 Pa s"
//! [body.pool]
//! phase = "water"
//! box = [[0, 0], [1, 1]]
//! "#;
//! let loaded = sph_scene::parse(text, "still.toml", &[]).unwrap();
//! assert_eq!(loaded.scene.phase["water"].density, 1000.0);
//! let bodies = loaded.scene.regions::<2>();
//! let filled = sph_scene::fill(&bodies, 0.1, sph_scene::Offset::Half, &[None; 2]);
//! assert_eq!(filled[0].positions.len(), 100);
//!
//! let bad = text.replace("spacing", "spcing");
//! let refused = sph_scene::parse(&bad, "still.toml", &[]).unwrap_err();
//! assert!(refused.to_string().contains("still.toml:7:1: numerics.spcing: "));
//! ```

mod body;
mod check;
mod check_bounds;
mod check_geometry;
mod check_names;
mod check_time;
mod diagnostic;
mod disorder;
mod estimate;
mod fill;
mod limits;
mod load;
mod locate;
mod nodes;
mod numerics;
mod output;
mod overlap;
mod overrides;
mod paths;
mod phase;
mod place;
mod plugins;
mod polygon;
mod reference;
mod scene;
mod schema;
mod shapes;
mod source;
mod vector;
mod wall;

pub use body::{Body, Cutout, Pressure, Round};
pub use diagnostic::{Diagnostic, Origin};
pub use disorder::disturb;
pub use estimate::estimate;
pub use fill::{Filled, Offset, fill};
pub use load::{LoadError, Loaded, Refused, load, parse};
pub use numerics::{Numerics, Periodic, Run};
pub use output::Output;
pub use overrides::Override;
pub use paths::PathProblem;
pub use phase::Phase;
pub use plugins::{PluginChoice, Plugins};
pub use polygon::Polygon;
pub use reference::{Norm, Reference};
pub use scene::Scene;
pub use schema::schema;
pub use shapes::{Region, Shape};
pub use source::Source;
pub use wall::{Condition, Motion, Wall};

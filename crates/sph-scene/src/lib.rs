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
//!    without allocating any, [`fill`] places them, [`disturb`] displaces them, [`noise`] gives them random velocities.
//! 4. [`Wall::lines`] and [`Wall::facets`] give the walls, from shapes and from files;
//!    [`Motion::courses`] gives how they move.
//! 5. [`schema`] is the JSON schema of scenes with all plugins of the binary, for editors.
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
mod body_shapes;
mod check;
mod check_bounds;
mod check_geometry;
mod check_motion;
mod check_names;
mod check_shapes;
mod check_time;
mod check_walls;
mod check_wave;
mod columns;
mod course;
mod diagnostic;
mod disorder;
mod divide;
mod drawing;
mod ellipse;
mod estimate;
mod facets;
mod files;
mod fill;
mod geometry;
mod level;
mod limits;
mod load;
mod locate;
mod motion;
mod nodes;
mod numerics;
mod outlet;
mod outlines;
mod output;
mod overlap;
mod overrides;
mod paths;
mod phase;
mod place;
mod placing;
mod plugins;
mod polygon;
mod reference;
mod region;
mod remarks;
mod rows;
mod scene;
mod schema;
mod shapes;
mod solid;
mod source;
mod stl;
mod svg;
mod svg_path;
mod triangulate;
mod vector;
mod wall;
mod wall_shapes;
mod wave;

pub use body::{Body, Cutout, Filling, Pressure};
pub use body_shapes::{Cone, Cylinder, Ellipse, Extrusion, Round};
pub use course::{Course, Courses, Turning};
pub use diagnostic::{Diagnostic, Origin};
pub use disorder::{SplitMix, disturb, noise};
pub use drawing::DrawingError;
pub use estimate::estimate;
pub use facets::Facets;
pub use files::DataFile;
pub use fill::{Filled, Offset, fill};
pub use level::LevelSurface;
pub use load::{LoadError, Loaded, Refused, load, load_allowing, parse, read, read_text};
pub use motion::{AngularRamp, AngularSine, Motion, Ramp, Rotation, Sine, Translate};
pub use numerics::{Numerics, Periodic, PressureOf, ReferencePressure, Relax, Run};
pub use outlet::Outlet;
pub use outlines::Line;
pub use output::Output;
pub use overrides::Override;
pub use paths::{PathProblem, within};
pub use phase::Phase;
pub use plugins::{PluginChoice, Plugins};
pub use polygon::Polygon;
pub use reference::{Norm, Reference};
pub use region::Region;
pub use scene::Scene;
pub use schema::{schema, unit};
pub use shapes::Shape;
pub use source::Source;
pub use wall::{Condition, FrictionForm, Side, Wall};
pub use wall_shapes::{
    Axis, ConeWall, CylinderWall, DiscWall, ExtrusionWall, Face, Rotate, SphereWall, Wedge,
};
pub use wave::{Heading, Wave, WaveKind};

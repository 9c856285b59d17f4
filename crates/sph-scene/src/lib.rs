//! Scene files: from a TOML text to plain validated data and particle positions.
//!
//! A scene is data. This crate has no kernel, no wall treatment and no rheology: every table
//! that names a plugin is kept as it stands ([`PluginChoice`](sph_core::PluginChoice)) and handed to the code that
//! builds plugins. It has the form of a scene, its units, its geometry, and how to say where a mistake is.
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

mod checks;
mod drawings;
mod filling;
mod geometry;
mod reading;
mod tables;

pub use filling::{BodyParticles, Offset, disturb, estimate, fill, noise};
pub use geometry::outlines::Line;
pub use geometry::polygon::Polygon;
pub use geometry::region::Region;
pub use geometry::shapes::Shape;
pub use geometry::surround::Surround;
pub use geometry::wall_geometry::sense;
pub use reading::load::{LoadError, Loaded, Refused, load, parse, read};
pub use reading::plugins::Plugins;
pub use reading::schema::{schema, unit};
pub use scene_text::surface::{Facets, Topology};
pub use scene_text::{
    Diagnostic, Origin, Override, PictureRange, Source, given, named_files, read_text, within,
};
pub use tables::body::{
    Body, BodyShape, Cone, Cylinder, Ellipse, Extrusion, Filling, Phase, Pressure, Round,
};
pub use tables::motion::{
    AngularRamp, AngularSine, CourseRows, Levels, Motion, Oscillation, Ramp, Rotation, Sine,
    Translate,
};
pub use tables::numerics::{
    GravityOverTime, GravitySine, Numerics, Periodic, PressureOf, ReferencePressure, Relax, Run,
};
pub use tables::outlet::{NearWall, Outlet, Zone};
pub use tables::output::Output;
pub use tables::reference::{Norm, Reference};
pub use tables::scene::{OFF_LATTICE, Scene};
pub use tables::wall::{
    ConeWall, CylinderWall, DiscWall, ExtrusionWall, Face, FluidSide, Rotate, SphereWall, Wall,
    Wedge,
};
pub use tables::wave::{Heading, LevelSurface, Wave, WaveKind};

//! Scenes of grains: read, assembled, run, measured and written.
//!
//! A scene is a TOML text with a table `[grains]`. It has no particles of a fluid, and carries no column of
//! theirs.
//!
//! 1. [`read`] turns a [`scene_text::Source`] into a [`Loaded`] scene ([`Scene`] and its tables), or into all its mistakes
//!    with their places; [`is_grain_scene`] distinguishes such scenes from those of particles.
//! 2. [`examine`] lists its parts without preparing its grains.
//! 3. [`run()`] prepares the grains and lets `sph-run` drive them: it steps, measures ([`Probe`]), writes and compares ([`Reference`]);
//!    [`assemble`] alone gives the [`Model`].
//! 4. [`Summary`] is what a run leaves; [`DemError`] what keeps it from its end, with the grain at fault ([`Failure`]).
//!
//! ```
//! let text = r#"
//! title = "A ball on the floor"
//! [run]
//! end = "0.2 s"
//! [grains]
//! count = 1
//! radius = ["10 cm", "10 cm"]
//! density = "2.6 g/cm^3"
//! gravity = [0, 0, "-9.81 m/s^2"]
//! [grains.contact.linear-elastic]
//! modulus = "1 MPa"
//! stiffness_ratio = 0.5
//! friction = 0.5
//! [start.cloud]
//! [box]
//! low = [0, 0, 0]
//! high = [0.3, 0.3, 0.3]
//! "#;
//! let source = scene_text::Source::new(text, "ball.toml", &[]);
//! let loaded = dem_pfv::scene::read(source).expect("a scene");
//! let model = dem_pfv::scene::assemble(&loaded, &mut |_| {})?.model;
//! assert_eq!(model.grains().grains.radius, [0.1]);
//!
//! let source = scene_text::Source::new(&text.replace("friction", "fricton"), "ball.toml", &[]);
//! let (_, mistakes) = dem_pfv::scene::read(source).unwrap_err();
//! let told: Vec<_> = mistakes.iter().map(|m| m.to_string()).collect();
//! assert!(told.iter().any(|m| m.contains("did you mean `friction`?")), "{told:?}");
//! # Ok::<(), dem_pfv::scene::DemError>(())
//! ```

mod assemble;
mod check;
mod compare;
mod error;
mod examine;
mod frames;
mod laws;
mod measure;
mod model;
mod prepare;
mod read;
mod run;
mod summary;
mod tables;

pub(crate) use assemble::loads;
pub use assemble::{Assembled, assemble};
pub use compare::Compared;
pub use error::{DemError, Failure};
pub(crate) use examine::plugins;
pub use examine::{Cost, Examination, PluginInForce, examine};
pub(crate) use frames::{displacements, names, strain_deviators, values};
pub(crate) use laws::{Laws, throats};
pub(crate) use measure::{headings, row};
pub(crate) use model::{CheckpointState, Progress};
pub use model::{Model, Origin, Saved};
pub(crate) use prepare::{FAR, POURED, control, from_file, named, setup, volume};
pub use read::{Loaded, editor_schema, is_grain_scene, read};
pub use run::{DiscreteElements, identity, run};
pub use summary::Summary;
pub use tables::{
    Axis, Box, Cloud, Fluid, Grains, Grown, Lattice, Oedometer, Output, Piston, Plugins, Probe,
    Rained, Reference, Run, Scene, Servo, Start as StartTable, Statistic, Wall, Wave, Weight,
};
pub(crate) use tables::{BOX, RecordedLoad};

//! The commands as functions: they write the files that the commands write, print nothing, and return the printed text.
//!
//! ```no_run
//! use sph_cli::library::{SceneArguments, check, open};
//!
//! let named = SceneArguments { scene: "dam-break-koshizuka".into(), ..SceneArguments::default() };
//! let scene = open(&named).map_err(|t| t.text(false))?;
//! let told = check(&scene, Some(4)).map_err(|t| t.text(false))?;
//! println!("{}: {} particles", told.text, told.json["particles"]);
//! # Ok::<(), String>(())
//! ```

pub use crate::app::command_line;
pub use crate::arguments::{RunArguments, SceneArguments, StudyArguments};
pub use crate::commands::check::output as check;
pub use crate::commands::compare::output as compare;
pub use crate::commands::explain::output as explain;
pub use crate::commands::measure::{MeasuredTable, table_of_json as measure};
pub use crate::commands::run::{execute as run, folder};
pub use crate::commands::study::conduct as study;
pub use crate::scene_file::{AnyScene, OpenScene, open, open_text};
pub use crate::terminal::{CommandOutput, Ended, Trouble};
/// A scene of particles.
pub use sph_scene::Scene as ParticleScene;

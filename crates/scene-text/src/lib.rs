//! Scenes of any method as texts: units, schemas, overrides, and mistakes with their place.
//!
//! The subject of a scene is not known here. A reader of scenes
//!
//! 1. makes a [`Source`] of a text, its file name and the [`Override`]s on top ([`read_text`], `--set`);
//! 2. holds its table against a JSON schema with [`conform`], which turns "10 kPa" into pascals ([`parse_quantity`])
//!    and names unknown keys with the nearest valid one ([`suggestion`]);
//! 3. reports mistakes as [`SceneProblem`]s, by key, which [`Source::diagnose`] turns into [`Diagnostic`]s with
//!    file, line, column and span.
//!
//! With the feature `surface`, the module of that name reads the STL files that scenes name.
//!
//! ```
//! use scene_text::{SceneProblem, Source};
//!
//! let source = Source::new("[run]\nend = 1", "scene.toml", &[]);
//! let problem = SceneProblem::new("run.end", "is too early");
//! let told = source.diagnose(&[problem])[0].to_string();
//! assert_eq!(told, "scene.toml:2:1: run.end: is too early");
//! ```

mod conform;
mod diagnostic;
mod files;
pub mod number;
mod overrides;
mod picture_range;
pub mod plausible;
mod problem;
mod quantity;
mod source;
#[cfg(feature = "surface")]
pub mod surface;

pub use conform::{conform, defaults, for_editors, resolved};
pub use diagnostic::{Diagnostic, Origin};
pub use files::{decoded, named_files, read_bytes, read_text, within};
pub use overrides::{OnePlugin, Override};
pub use picture_range::{PictureRange, falling};
pub use problem::{
    MOST_PROBLEMS, Problems, SceneProblem, comma_list, given, is_within, nearest, suggestion,
};
pub use quantity::{Dimensions, parse_quantity, parse_unit, unit_factor};
pub use source::Source;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

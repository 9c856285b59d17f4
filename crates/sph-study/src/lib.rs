//! Studies: which error a choice reaches in which time.
//!
//! A study file names a scene, what is varied and the error that is judged. The way of a study:
//! 1. [`Study::read`] crosses or pairs its axes into variants, reads the scene of each, and finds
//!    every mistake before anything runs; [`Study::assemble`] puts a variant's plugins together.
//! 2. [`execute`] runs what no [`Record`] settles; it can be stopped at any time and goes on where
//!    it was.
//! 3. [`Results`] has errors, times and orders of convergence; [`publish`] writes them as JSON,
//!    CSV, plots and a page.
//!    A study of axes that are gone along until they break has a [`Frontier`] for each, from the [`verdict()`]
//!    on every run of its [`Ladder`].
//!    Costs against the number of particles, and which choice is the fastest at which size, are a [`Scale`].
//! 4. [`compare`] tells what changed between two [`Results`].

mod axis;
mod combine;
mod compare;
mod cost;
mod execute;
mod file;
mod fingerprint;
mod frontier;
mod grid;
mod ladder;
mod machine;
mod matrix;
mod matrix_plots;
mod mistake;
mod options;
mod order;
mod pareto;
mod plan;
mod plots;
mod publish;
mod reader;
mod record;
mod repeat;
mod report;
mod results;
mod rung;
mod scaling;
mod scene_text;
mod table;
mod variant;
mod variant_result;
mod verdict;
mod watcher;

pub use axis::{Axis, Choice, Set};
pub use compare::{Change, Comparison, Pair, compare};
pub use cost::{Cost, Scaling, SolveCost};
pub use execute::{Outcome, execute, to_run};
pub use file::{Combine, StudyFile};
pub use frontier::Frontier;
pub use machine::{Machine, Origin};
pub use mistake::{Mistake, Refused};
pub use options::Options;
pub use order::Orders;
pub use plan::{ReadError, Study};
pub use publish::publish;
pub use record::{Error, Health, Record, Status};
pub use results::Results;
pub use rung::{Ladder, Rung};
pub use scaling::{Reign, Scale, SeriesCost};
pub use scene_text::{FindScene, SceneText};
pub use table::{rows, write_csv};
pub use variant::Variant;
pub use variant_result::{SeriesResult, VariantResult, WallSeconds};
pub use verdict::{Colour, QUANTITIES, Verdict, verdict};
pub use watcher::Watcher;

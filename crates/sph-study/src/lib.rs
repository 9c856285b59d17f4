//! Studies: which error a choice reaches in which time.
//!
//! A study file names a scene, the variation and the error that is judged. The way of a study:
//! 1. [`Study::read`] crosses or pairs its axes into variants, reads the scene of each, and finds
//!    every mistake before anything runs; [`Study::assemble`] puts a variant's plugins together.
//!    A scene is a [`Subject`](sph_run::Subject) of any [`Method`](sph_run::Method): a study has no physics.
//! 2. [`execute`] runs what no [`Record`] settles; it can be stopped at any time and goes on where
//!    it was.
//! 3. [`Results`] has errors, times and orders of convergence; [`publish`] writes them as JSON,
//!    CSV, plots and a page.
//!    A study of axes that are gone along until they break has a `Frontier` for each, from the [`verdict()`]
//!    on every run of its `Ladder`.
//!    Costs against the number of particles, and which choice is the fastest at which size, are a [`Scale`].
//! 4. [`compare`] lists the changes between two [`Results`].

mod pages;
mod reading;
mod results;
mod running;

pub use pages::report::publish;
pub use pages::table::rows;
pub use reading::file::StudyFile;
pub use reading::mistake::{Mistake, Refused};
pub use reading::plan::{ReadError, Study};
pub use reading::variant::{FindScene, SceneText, Variant};
pub use results::Results;
pub use results::compare::compare;
pub use results::scaling::Scale;
pub use results::variant_result::{Orders, VariantResult};
pub use running::execute::{execute, to_run};
pub use running::machine::Origin;
pub use running::record::{Record, Status};
pub use running::repeat::{Options, Watcher};
pub use running::verdict::verdict;

use reading::axis::{Choice, Set, StudyAxis};
use reading::file::{Bounds, Combine, MeansPlot};
use reading::variant::{Frontier, Ladder, Rung};
use results::scaling::SeriesCost;
use results::variant_result::SeriesResult;
use running::record::{Cost, Error, Health, RunSize, Scaling, SolveCost};
use running::verdict::{Colour, QUANTITIES, Verdict};

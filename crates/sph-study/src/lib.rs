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
//!    A study of axes that are gone along until they break has a [`Frontier`] for each, from the [`verdict()`]
//!    on every run of its [`Ladder`].
//!    Costs against the number of particles, and which choice is the fastest at which size, are a [`Scale`].
//! 4. [`compare`] lists the changes between two [`Results`].

mod pages;
mod reading;
mod results;
mod running;

pub use pages::publish::publish;
pub use pages::table::{rows, write_csv};
pub use reading::axis::{Choice, Set, StudyAxis};
pub use reading::file::{Bounds, Combine, MeansPlot, StudyFile};
pub use reading::mistake::{Mistake, Refused};
pub use reading::options::Options;
pub use reading::plan::{ReadError, Study};
pub use reading::variant::{FindScene, Ladder, Rung, SceneText, Variant};
pub use results::Results;
pub use results::compare::{Change, Comparison, Pair, compare};
pub use results::frontier::Frontier;
pub use results::order::Orders;
pub use results::scaling::{FastestRange, Scale, SeriesCost};
pub use results::variant_result::{SeriesResult, VariantResult, WallSeconds};
pub use running::cost::{Cost, Scaling, SolveCost};
pub use running::execute::{Outcome, execute, to_run};
pub use running::machine::{Machine, Origin};
pub use running::record::{Error, Health, Record, RunSize, Status};
pub use running::repeat::Watcher;
pub use running::verdict::{Colour, QUANTITIES, Verdict, verdict};

//! One scene of a study.

use std::sync::Arc;

use sph_run::Subject;

use crate::reading::rung::Rung;

/// One scene of a study.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Name, which is that of its folder too.
    pub name: String,
    /// Label on every axis.
    pub labels: Vec<String>,
    /// Value of the refinement's key.
    pub refinement: Option<f64>,
    /// Names of the references that are judged.
    pub errors: Vec<String>,
    /// Its place on an axis that is gone along until it breaks.
    pub rung: Option<Rung>,
    /// True if it is to be run, false if only an earlier run is shown.
    pub wanted: bool,
    /// The scene.
    pub subject: Arc<dyn Subject>,
    /// Data on which its result depends.
    pub fingerprint: String,
    /// For every override of the scene the path in the study file that gives it, if it does.
    pub(crate) given_by: Vec<Option<String>>,
}

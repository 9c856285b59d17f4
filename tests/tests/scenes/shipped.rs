//! Runs of shipped scenes in temporary folders.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use sph_particles::Summary;
use sph_run::Status;
use sph_scene::{Scene, parse};
use sph_tests::{Ran, below, changes, ran, shipped, shipped_file};

/// A finished run.
pub struct Finished(Ran);

impl Deref for Finished {
    type Target = Ran;
    fn deref(&self) -> &Ran {
        &self.0
    }
}

/// What is left of a run without its folder.
pub struct Whole {
    pub summary: Summary,
}

/// A scene as it is shipped, run once for all tests that ask for it.
pub fn whole(name: &'static str) -> Arc<Whole> {
    static RUNS: Mutex<BTreeMap<&str, Arc<OnceLock<Arc<Whole>>>>> = Mutex::new(BTreeMap::new());
    let cell = {
        let mut runs = RUNS.lock().unwrap_or_else(PoisonError::into_inner);
        runs.entry(name).or_default().clone()
    };
    let run = || {
        let summary = finished(name, &[]).0.summary;
        Arc::new(Whole { summary })
    };
    cell.get_or_init(run).clone()
}

impl Whole {
    /// The error against a reference, which must be at most `bound`.
    pub fn error(&self, reference: &str, bound: f64, measured: f64) -> f64 {
        error(&self.summary, reference, bound, measured)
    }
}

/// The error of a run against a reference, which must be at most `bound`.
fn error(summary: &Summary, reference: &str, bound: f64, measured: f64) -> f64 {
    let value = summary.errors[reference].value;
    let value = value.expect("something was compared");
    assert!(
        value <= bound,
        "{}: {reference} is {value}, at most {bound} is allowed, {measured} was measured",
        summary.scene
    );
    // A reference that is met exactly compares nothing.
    assert!(value > 0.0, "{reference} compares nothing");
    value
}

/// Runs a scene of the `scenes` folder to its end.
pub fn finished(name: &str, overrides: &[&str]) -> Finished {
    let another_spacing = overrides.iter().any(|o| o.contains("numerics.spacing="));
    let finished = to_the_end(&shipped(name, overrides));
    finished.is_sound(another_spacing);
    finished
}

/// Runs a scene to its end.
fn to_the_end(scene: &Scene) -> Finished {
    Finished(ran(scene, 1).unwrap_or_else(|e| panic!("{e}")))
}

/// Runs a shipped scene with its smoother, shifting, surfaces, walls, smoothing length, step and relaxation left out.
pub fn by_default(name: &str, overrides: &[&str]) -> Finished {
    let path = shipped_file(name);
    let text = std::fs::read_to_string(&path).expect("a shipped scene");
    let mut table: toml::Table = text.parse().expect("a scene");
    for kind in [
        "smoother",
        "shifting",
        "surface",
        "walls",
        "kernel",
        "integrator",
        "formulation",
    ] {
        table.remove(kind);
    }
    if let Some(toml::Value::Table(numerics)) = table.get_mut("numerics") {
        for key in ["smoothing_ratio", "relax", "jitter"] {
            numerics.remove(key);
        }
    }
    let file = path.display().to_string();
    let stripped = parse(&table.to_string(), &file, &changes(overrides));
    to_the_end(&stripped.unwrap_or_else(|e| panic!("{e}")).scene)
}

impl Finished {
    /// What holds for every run. Bodies that fit each other at the scene's spacing need not do so at `another_spacing`.
    fn is_sound(&self, another_spacing: bool) {
        let summary = &self.summary;
        assert_eq!(summary.status, Status::Done);
        let misfit = |w: &String| another_spacing && w.contains("start whole spacings from");
        let warnings: Vec<&String> = summary.warnings.iter().filter(|w| !misfit(w)).collect();
        assert!(warnings.is_empty(), "{warnings:?}");
        assert_eq!(summary.steps_rolled_back, 0);
        assert_eq!(summary.escaped, 0, "particles behind a wall");
        // No mass changes, but the sum is taken in another order after every sort: measured up
        // to 5e-16 for 2600 particles.
        below(summary.drift.mass, 1e-14, "mass drift");
    }

    /// The error against a reference, which must be at most `bound`: the error budget of the case, from its spacing and
    /// order or from its reference's own spread. `measured` is what it was once, for the reader.
    pub fn error(&self, reference: &str, bound: f64, measured: f64) -> f64 {
        error(&self.summary, reference, bound, measured)
    }

    /// Where a file of the run is.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// A file of the run.
    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }
}

/// The budget of a second-order scheme with `n` spacings over the length on which the flow changes: n⁻².
pub fn second_order(n: f64) -> f64 {
    n.powi(-2)
}

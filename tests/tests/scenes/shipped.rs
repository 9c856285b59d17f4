//! Runs of shipped scenes in temporary folders.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use sph_io::{Table, read_table};
use sph_particles::{Summary, run};
use sph_run::{RunOptions, Status};
use sph_scene::{Override, Scene, load, parse};
use tempfile::TempDir;

/// A finished run.
pub struct Finished {
    pub summary: Summary,
    folder: TempDir,
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
        let summary = finished(name, &[]).summary;
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
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
    let another_spacing = overrides.iter().any(|o| o.starts_with("numerics.spacing"));
    let overrides: Vec<_> = overrides
        .iter()
        .map(|text| Override::parse(text).unwrap_or_else(|e| panic!("{text}: {e}")))
        .collect();
    let loaded = load(&path, &overrides).unwrap_or_else(|e| panic!("{e}"));
    let finished = to_the_end(name, &loaded.scene);
    finished.is_sound(another_spacing);
    finished
}

/// Runs a scene to its end.
fn to_the_end(name: &str, scene: &Scene) -> Finished {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let options = RunOptions::new(folder.path(), sph_run::Identity::of_text(name)).threads(1);
    let summary = run(scene, &options, &mut ()).unwrap_or_else(|e| panic!("{name}: {e}"));
    Finished { summary, folder }
}

/// Runs a shipped scene with its smoother, shifting, surfaces, walls, smoothing length, step and relaxation left out.
pub fn by_default(name: &str, overrides: &[&str]) -> Finished {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
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
    let overrides = overrides.iter().map(|text| Override::parse(text));
    let overrides: Vec<_> = overrides.map(|o| o.expect("an override")).collect();
    let stripped = parse(&table.to_string(), &path.display().to_string(), &overrides);
    to_the_end(name, &stripped.unwrap_or_else(|e| panic!("{e}")).scene)
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
        assert!(
            summary.drift.mass.abs() < 1e-14,
            "mass drift {:e}",
            summary.drift.mass
        );
    }

    /// The error against a reference, which must be at most `bound`: the error budget of the case, from its spacing and
    /// order or from its reference's own spread. `measured` is what it was once, for the reader.
    pub fn error(&self, reference: &str, bound: f64, measured: f64) -> f64 {
        error(&self.summary, reference, bound, measured)
    }

    /// Where a file of the run is.
    pub fn path(&self, name: &str) -> std::path::PathBuf {
        self.folder.path().join(name)
    }

    /// A file of the run.
    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.folder.path().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// The time series.
    pub fn series(&self) -> Table {
        read_table(self.folder.path().join("series.csv")).expect("a series")
    }
}

/// The budget of a second-order scheme with `n` spacings over the length on which the flow changes: n⁻².
pub fn second_order(n: f64) -> f64 {
    n.powi(-2)
}

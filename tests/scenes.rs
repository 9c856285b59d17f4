//! Scenes through the library: read, assembled, stepped, run.

use std::path::{Path, PathBuf};

use sph_core::{System, Vect, fields};
use sph_particles::setup::{Assembled, assemble};
use sph_particles::{RunError, Summary, run};
use sph_run::{Identity, RunOptions, Start};
use sph_scene::{Override, Scene, load, parse};
use tempfile::TempDir;

use crate::{FinalState, Series};

/// Changes as `--set` has them; blanks outside of brackets stand between several in one text.
#[track_caller]
pub fn changes(all: &[&str]) -> Vec<Override> {
    let mut depth = 0;
    let between = |c: char| {
        depth += i32::from("[{".contains(c)) - i32::from("]}".contains(c));
        c == ' ' && depth == 0
    };
    let all = all.join(" ");
    let each = all.split(between).filter(|text| !text.is_empty());
    let read = |text: &str| Override::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    each.map(read).collect()
}

/// A scene from its text.
#[track_caller]
pub fn scene(text: &str, set: &[&str]) -> Scene {
    let loaded = parse(text, "scene.toml", &changes(set));
    loaded.unwrap_or_else(|e| panic!("{e}")).scene
}

/// The file of a shipped scene.
pub fn shipped_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"))
}

/// A shipped scene.
#[track_caller]
pub fn shipped(name: &str, set: &[&str]) -> Scene {
    let loaded = load(&shipped_file(name), &changes(set));
    loaded.unwrap_or_else(|e| panic!("{name}: {e}")).scene
}

/// The particles of a scene with its plugins.
#[track_caller]
pub fn assembled<const D: usize>(scene: &Scene) -> Assembled<D> {
    assemble::<D>(scene).unwrap_or_else(|e| panic!("{e}"))
}

/// The same with the rates of the start.
#[track_caller]
pub fn evaluated<const D: usize>(scene: &Scene) -> Assembled<D> {
    let mut parts = assembled(scene);
    parts.flow.evaluate().expect("a state");
    parts
}

/// A step with the rates of its end.
#[track_caller]
pub fn step<const D: usize>(parts: &mut Assembled<D>, dt: f64) {
    parts.flow.world.dt = dt;
    parts.integrator.step(&mut parts.flow, dt).expect("a step");
    parts.flow.evaluate().expect("a state");
}

/// Gives every particle the velocity of its place.
pub fn move_as<const D: usize>(parts: &mut Assembled<D>, velocity: impl Fn(&Vect<D>) -> Vect<D>) {
    let free = &mut parts.flow.world.free;
    let places = free.get(fields::POSITION).expect("places");
    let velocities = places.iter().map(velocity).collect();
    free.put(fields::VELOCITY, velocities).expect("a column");
}

/// Σ m u and Σ m |u|, kg m/s.
pub fn momentum<const D: usize>(parts: &Assembled<D>) -> (Vect<D>, f64) {
    let free = &parts.flow.world.free;
    let mass = free.get(fields::MASS).expect("masses");
    let velocity = free.get(fields::VELOCITY).expect("velocities");
    let pairs = || mass.iter().zip(velocity);
    let sum = pairs().map(|(m, u)| u * *m).sum();
    (sum, pairs().map(|(m, u)| m * u.norm()).sum())
}

/// Σ m x × u, kg m²/s.
pub fn spin(parts: &Assembled<2>) -> f64 {
    let free = &parts.flow.world.free;
    let mass = free.get(fields::MASS).expect("masses").iter();
    let place = free.get(fields::POSITION).expect("places");
    let all = mass
        .zip(place)
        .zip(free.get(fields::VELOCITY).expect("velocities"));
    all.map(|((m, x), u)| m * (x[0] * u[1] - x[1] * u[0])).sum()
}

/// What reading or assembling a scene is refused with.
#[track_caller]
pub fn refusal<const D: usize>(text: &str) -> String {
    match parse(text, "scene.toml", &[]) {
        Err(refused) => refused.to_string(),
        Ok(loaded) => match assemble::<D>(&loaded.scene) {
            Err(refused) => refused.to_string(),
            Ok(_) => panic!("accepted:\n{text}"),
        },
    }
}

/// Runs a scene into a folder. All have one identity, so that one may go on where another one stopped.
///
/// # Errors
///
/// Those of the run.
pub fn run_into(
    folder: &Path,
    scene: &Scene,
    threads: usize,
    start: Start,
) -> Result<Summary, RunError> {
    let options = RunOptions::new(folder, Identity::of_text("a test"))
        .start(start)
        .threads(threads);
    run(scene, &options, &mut ())
}

/// A run in a folder of its own.
pub struct Ran {
    /// What the run says of itself.
    pub summary: Summary,
    folder: TempDir,
}

/// Runs a scene in a folder of its own.
///
/// # Errors
///
/// Those of the run.
pub fn ran(scene: &Scene, threads: usize) -> Result<Ran, RunError> {
    let folder = tempfile::tempdir().expect("a folder");
    let summary = run_into(folder.path(), scene, threads, Start::Afresh)?;
    Ok(Ran { summary, folder })
}

/// Runs a scene in a folder of its own to a good end.
#[track_caller]
pub fn finished(text: &str, threads: usize) -> Ran {
    ran(&scene(text, &[]), threads).unwrap_or_else(|e| panic!("{e}"))
}

impl Ran {
    /// The folder of the results.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// The state in which it ended.
    pub fn state(&self) -> FinalState {
        FinalState::read(self.folder())
    }

    /// The time series.
    #[track_caller]
    pub fn series(&self) -> Series {
        Series::read(self.folder())
    }

    /// A column of the time series.
    #[track_caller]
    pub fn column(&self, name: &str) -> Vec<f64> {
        self.series().column(name).to_vec()
    }

    /// The last value of a column.
    #[track_caller]
    pub fn last(&self, name: &str) -> f64 {
        self.series().last(name)
    }
}

/// Runs a scene with one thread, with more, and in two parts, of which the first ends after some steps: all must end
/// with the same bits. What the first part ends with is looked `at`.
#[track_caller]
pub fn same_bits(text: &str, steps: u32, threads: &[usize], at: impl FnOnce(&FinalState)) {
    let whole = finished(text, 1).state();
    for threads in threads {
        let told = format!("one thread and {threads}");
        whole.assert_same(&finished(text, *threads).state(), &told);
    }
    let part = format!("run.max_steps={steps}");
    let parts = ran(&scene(text, &[&part]), 1).unwrap_or_else(|e| panic!("{e}"));
    at(&parts.state());
    let rest = run_into(parts.folder(), &scene(text, &[]), 2, Start::Resumed);
    rest.unwrap_or_else(|e| panic!("{e}"));
    whole.assert_same(&parts.state(), "whole and in two parts");
}

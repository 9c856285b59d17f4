//! Scenes of users that failed or misled: each is run as the user would, and the right value is the test.

mod buoyancy;
mod courses;
mod faces;
mod grains;
mod guards;
mod impacts;
mod lightness;
mod meshes;
mod motion;
mod plates;
mod rests;
mod reversing;
mod seams;
mod smoothers;
mod words;

use serde_json::Value as Json;
use sph_io::{Table, read_table};
use sph_tests::{Bench, Outcome};

/// A folder with all inputs, in which the program is called.
struct Field(Bench);

impl Field {
    /// A folder of its own.
    fn new() -> Self {
        let bench = Bench::new(env!("CARGO_BIN_EXE_sph-under-test"));
        let inputs = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/field/inputs");
        for folder in [inputs, &format!("{inputs}/attack")] {
            let all = std::fs::read_dir(folder).expect("the inputs");
            let paths = all.map(|entry| entry.expect("an input").path());
            for path in paths.filter(|path| path.is_file()) {
                let name = path.file_name().expect("a name");
                std::fs::copy(&path, bench.folder().join(name)).expect("a copy");
            }
        }
        Field(bench)
    }

    /// `sph run INPUT.toml` with more words; results lie in `r`.
    fn run(&self, input: &str, more: &str) -> Outcome {
        self.0
            .call(&format!("run {input}.toml --quiet --out r {more}"))
    }

    /// `sph check INPUT.toml` with more words.
    fn check(&self, input: &str, more: &str) -> Outcome {
        self.0.call(&format!("check {input}.toml {more}"))
    }

    /// `summary.json` of the last run.
    fn summary(&self) -> Json {
        serde_json::from_str(&self.0.read("r/summary.json")).expect("a summary")
    }

    /// `series.csv` of the last run.
    fn series(&self) -> Table {
        read_table(self.0.path("r/series.csv")).expect("a series")
    }
}

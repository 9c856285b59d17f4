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

use std::ops::Deref;

use serde_json::Value as Json;
use sph_tests::{Bench, Outcome, Series, bench};

/// A folder with all inputs, in which the program is called.
struct Field(Bench);

impl Deref for Field {
    type Target = Bench;
    fn deref(&self) -> &Bench {
        &self.0
    }
}

impl Field {
    /// A folder of its own.
    fn new() -> Self {
        let bench = bench!();
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
        self.call(&format!("run {input}.toml --quiet --out r {more}"))
    }

    /// `series.csv` of the last run.
    fn series(&self) -> Series {
        self.0.series("r")
    }

    /// A run to a good end.
    #[track_caller]
    fn ran(&self, input: &str, more: &str) -> Series {
        self.run(input, more).ended(0);
        self.series()
    }

    /// `sph check INPUT.toml` with more words.
    fn check(&self, input: &str, more: &str) -> Outcome {
        self.call(&format!("check {input}.toml {more}"))
    }

    /// What `sph check` says of a good scene, as JSON.
    #[track_caller]
    fn examined(&self, input: &str, more: &str) -> Json {
        let outcome = self.check(input, &format!("--json {more}"));
        outcome.ended(0).json()
    }

    /// `sph check` refuses a scene and says all of these words; ` | ` stands between two.
    #[track_caller]
    fn refuses(&self, input: &str, more: &str, words: &str) {
        self.check(input, more).ended(2).says(words);
    }

    /// `summary.json` of the last run.
    fn summary(&self) -> Json {
        self.0.summary("r")
    }
}

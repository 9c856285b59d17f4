//! A folder with a scene in it, and the program that runs it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::{FinalState, Says, Series, refusals};

/// A folder for the program of the tests, with `scene.toml` in it if a scene is given.
#[macro_export]
macro_rules! bench {
    () => {
        $crate::Bench::new(env!("CARGO_BIN_EXE_sph-under-test"))
    };
    ($scene:expr $(,)?) => {
        $crate::Bench::with(env!("CARGO_BIN_EXE_sph-under-test"), $scene)
    };
}

/// The calls that read a scene.
pub const CHECK_AND_RUN: [&str; 2] = ["check scene.toml", "run scene.toml"];

/// A temporary folder in which the program is called.
pub struct Bench {
    program: &'static str,
    folder: TempDir,
}

/// What a call of the program gave.
#[derive(Debug)]
pub struct Outcome {
    /// The words of the call.
    pub words: String,
    /// Exit code; none if a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Bench {
    /// A folder for a program, which the macro `bench` names.
    pub fn new(program: &'static str) -> Self {
        Bench {
            program,
            folder: tempfile::tempdir().expect("a temporary folder"),
        }
    }

    /// A folder with `scene.toml` in it.
    pub fn with(program: &'static str, scene: &str) -> Self {
        let bench = Self::new(program);
        bench.write("scene.toml", scene);
        bench
    }

    /// The folder.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A path in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    /// Writes a file into the folder.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).expect("a file in a temporary folder");
    }

    /// A file of the folder as text.
    pub fn read(&self, name: &str) -> String {
        let path = self.path(name);
        std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    }

    /// The call, not yet made; words are separated by spaces.
    pub fn command(&self, words: &str) -> Command {
        let mut command = Command::new(self.program);
        command
            .args(words.split_whitespace())
            .current_dir(self.folder())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// Calls the program and waits.
    pub fn call(&self, words: &str) -> Outcome {
        let output = self.command(words).output().expect("the program starts");
        Outcome::new(words.to_owned(), &output)
    }

    /// Calls the program, which must succeed.
    #[track_caller]
    pub fn done(&self, words: &str) -> Outcome {
        self.call(words).ended(0)
    }

    /// Calls the program, which must refuse what it is asked.
    #[track_caller]
    pub fn refused(&self, words: &str) -> Outcome {
        self.call(words).ended(2)
    }

    /// Calls the program, which must end with a run that failed.
    #[track_caller]
    pub fn failed(&self, words: &str) -> Outcome {
        self.call(words).ended(1)
    }

    /// These calls refuse a file with each change of a list of [`refusals`], at the line that it names, and write nothing.
    #[track_caller]
    pub fn refuses(&self, file: &str, calls: &[&str], text: &str, changes: &'static str) {
        for case in refusals(changes) {
            let changed = case.of(text);
            self.write(file, &changed);
            let names = self.names();
            for call in calls {
                let refused = self.refused(call);
                case.is_told(&refused.err, file, &changed);
                assert_eq!(self.names(), names, "something was written");
            }
        }
    }

    /// `check` accepts a scene with each change of a list of [`refusals`] and remarks on it.
    #[track_caller]
    pub fn remarks(&self, scene: &str, changes: &'static str) {
        for case in refusals(changes) {
            let changed = case.of(scene);
            self.write("scene.toml", &changed);
            let told = self.done("check scene.toml").out;
            case.is_told(&told, "scene.toml", &changed);
        }
    }

    /// A file of the folder as JSON.
    #[track_caller]
    pub fn json(&self, name: &str) -> Json {
        parsed(&self.read(name))
    }

    /// `summary.json` of a folder of results.
    #[track_caller]
    pub fn summary(&self, results: &str) -> Json {
        self.json(&format!("{results}/summary.json"))
    }

    /// `series.csv` of a folder of results.
    #[track_caller]
    pub fn series(&self, results: &str) -> Series {
        Series::read(&self.path(results))
    }

    /// The state that a folder of results ends with.
    pub fn state(&self, results: &str) -> FinalState {
        FinalState::read(&self.path(results))
    }

    /// Runs the scene with one, two and four threads: all must end with the same bits.
    #[track_caller]
    pub fn same_on_threads(&self, set: &str) {
        let state = |threads: u32| {
            let run = format!("run scene.toml --quiet {set} --threads {threads}");
            self.done(&format!("{run} --out r{threads}"));
            self.state(&format!("r{threads}"))
        };
        let one = state(1);
        for threads in [2, 4] {
            one.assert_same(&state(threads), &format!("1 and {threads} threads"));
        }
    }

    /// Runs the scene with one and with two threads, in `one` and `two`, and in two parts, in `parts`: all must end
    /// with the same bits, which are returned.
    #[track_caller]
    pub fn same_bits(&self, set: &str, steps: u32) -> FinalState {
        let run = |words: &str| format!("run scene.toml --quiet {set} --out {words}");
        self.done(&run("one --threads 1"));
        self.done(&run("two --threads 2"));
        let one = self.state("one");
        one.assert_same(&self.state("two"), "one and two threads");
        let part = format!("parts --threads 1 --set run.max_steps={steps}");
        let stopped = self.call(&run(&part));
        assert!(stopped.code.is_some(), "{}", stopped.err);
        self.done(&run("parts --threads 2 --resume --changed"));
        one.assert_same(&self.state("parts"), "whole and in two parts");
        one
    }

    /// What is in the folder, sorted by its names.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder()).expect("the folder");
        let names = entries.map(|e| e.expect("an entry").file_name().into_string());
        let mut names: Vec<_> = names.map(|name| name.expect("a plain name")).collect();
        names.sort();
        names
    }
}

impl Outcome {
    /// That of a call with these words.
    pub fn new(words: String, output: &Output) -> Self {
        let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
        Outcome {
            words,
            code: output.status.code(),
            out: text(&output.stdout),
            err: text(&output.stderr),
        }
    }

    /// It must have ended with this code.
    #[track_caller]
    pub fn ended(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "sph {}\n{}", self.words, self.err);
        self
    }

    /// All of these words must be in standard error; ` | ` stands between two.
    #[track_caller]
    pub fn says(&self, words: &str) {
        self.err.says(words);
    }

    /// Standard output as JSON.
    #[track_caller]
    pub fn json(&self) -> Json {
        parsed(&self.out)
    }
}

#[track_caller]
fn parsed(text: &str) -> Json {
    serde_json::from_str(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

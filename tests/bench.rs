//! A folder with a scene in it, and the program that runs it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

/// A temporary folder in which the program is called.
pub struct Bench {
    program: &'static str,
    folder: TempDir,
}

/// What a call of the program gave.
#[derive(Debug)]
pub struct Outcome {
    /// Exit code; none if a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Bench {
    /// A folder for a program, given as `env!("CARGO_BIN_EXE_sph-under-test")`.
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
    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("a file in a temporary folder");
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
        Outcome {
            code: output.status.code(),
            out: String::from_utf8_lossy(&output.stdout).into_owned(),
            err: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }

    /// Calls the program, which must succeed.
    pub fn done(&self, words: &str) -> Outcome {
        let outcome = self.call(words);
        assert_eq!(outcome.code, Some(0), "sph {words}\n{}", outcome.err);
        outcome
    }
}

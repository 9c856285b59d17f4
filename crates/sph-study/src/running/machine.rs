//! Machine and program of a study.

use std::path::Path;
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

/// Version of the program, part of every fingerprint.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A computer, as far as run times depend on it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    pub cpu: String,
    /// Cores that this process may use.
    pub cores: usize,
    pub os: String,
}

impl Machine {
    /// This computer.
    pub fn this_machine() -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        Machine {
            cpu: cpu().unwrap_or_else(|| std::env::consts::ARCH.to_string()),
            cores,
            os: format!("{} {}", system(), std::env::consts::ARCH),
        }
    }
}

/// Origin of run times and last digits.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Origin {
    /// The machine.
    pub machine: Machine,
    pub(crate) version: String,
    /// Commit of the program's repository, if it is known.
    pub(crate) commit: Option<String>,
    pub(crate) built_with: String,
}

impl Origin {
    /// Of this program and machine, at present.
    pub fn new(built_with: &str) -> Self {
        Origin {
            machine: Machine::this_machine(),
            version: VERSION.into(),
            commit: commit(),
            built_with: built_with.into(),
        }
    }
}

impl std::fmt::Display for Machine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let cores = if self.cores == 1 { "core" } else { "cores" };
        write!(f, "{}, {} {cores}, {}", self.cpu, self.cores, self.os)
    }
}

fn cpu() -> Option<String> {
    if let Ok(text) = std::fs::read_to_string("/proc/cpuinfo") {
        let line = text.lines().find(|l| l.starts_with("model name"))?;
        return Some(line.split_once(':')?.1.trim().to_string());
    }
    output_of(Command::new("sysctl").args(["-n", "machdep.cpu.brand_string"]))
}

fn system() -> String {
    let release = std::fs::read_to_string("/etc/os-release").unwrap_or_default();
    let name = release.lines().find_map(|l| l.strip_prefix("PRETTY_NAME="));
    match name {
        Some(name) => name.trim_matches('"').to_string(),
        None => std::env::consts::OS.to_string(),
    }
}

/// Output of a program, if it is there and succeeds.
fn output_of(command: &mut Command) -> Option<String> {
    let command = command.stdin(Stdio::null()).stderr(Stdio::null());
    let output = command.output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let text = text.trim();
    (output.status.success() && !text.is_empty()).then(|| text.to_string())
}

/// Commit of the repository that this program was built in, with `-dirty` if files were changed.
///
/// Taken from the build (`SPH_COMMIT`) if it has it, else from the repository around the
/// executable or the working folder, provided it is the one with this crate.
fn commit() -> Option<String> {
    if let Some(commit) = option_env!("SPH_COMMIT") {
        return Some(commit.to_string());
    }
    let beside = std::env::current_exe().ok();
    let beside = beside.as_deref().and_then(Path::parent);
    let here = std::env::current_dir().ok();
    let mut folders = beside.into_iter().chain(here.as_deref());
    folders.find_map(|folder| {
        let git = |words: &str| {
            let words = words.split(' ');
            output_of(Command::new("git").current_dir(folder).args(words))
        };
        let root = git("rev-parse --show-toplevel")?;
        let manifest = Path::new(&root).join("crates/sph-study/Cargo.toml");
        let describe = "describe --always --dirty --abbrev=12 --exclude=*";
        manifest.exists().then(|| git(describe))?
    })
}

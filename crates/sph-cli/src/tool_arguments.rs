//! What the commands around a run take.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

/// Arguments of `sph compare`.
#[derive(Debug, Args)]
pub struct CompareArguments {
    /// Folder of the results of a run
    #[arg(value_name = "A")]
    pub first: PathBuf,
    /// Folder of those of another
    #[arg(value_name = "B")]
    pub second: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `sph view`.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// Folder of the results of a run, which may be going on
    pub results: PathBuf,
    /// Port on 127.0.0.1; 0 for one that is free
    #[arg(long, default_value_t = 8377)]
    pub port: u16,
}

/// Arguments of `sph completions`.
#[derive(Debug, Args)]
pub struct CompletionArguments {
    /// The shell
    pub shell: Shell,
}

/// Arguments of `sph man`.
#[derive(Debug, Args)]
pub struct ManArguments {
    /// The command whose page is printed; that of `sph` if left out
    pub of: Option<String>,
    /// Write the pages of all commands into a folder instead
    #[arg(long, value_name = "DIR", conflicts_with = "of")]
    pub out: Option<PathBuf>,
}

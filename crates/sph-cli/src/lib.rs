//! The command line as a library, so that a binary with plugins of its own is two lines:
//!
//! ```no_run
//! // use my_plugin as _;
//! fn main() -> std::process::ExitCode {
//!     sph_cli::main()
//! }
//! ```
//!
//! [`library`] has the commands as functions, for programs without a terminal.
//!
//! Subcommands are the files of `commands`; none of them names a plugin. Exit codes: 0 done, 1 the run failed or was
//! interrupted, 2 bad usage or a bad scene. With code 2 nothing has been written.

mod app;
mod arguments;
mod commands;
mod interrupt;
pub mod library;
mod ranks;
mod scene_file;
mod shipped;
mod terminal;
mod tool_arguments;

// Their plugins are in this binary.
use sph_multiphase as _;
use sph_open as _;
use sph_turbulence as _;

pub use app::main;
pub use scene_file::method;

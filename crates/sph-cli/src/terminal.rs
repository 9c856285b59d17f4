//! Output in a terminal: texts, tables, progress and errors.

pub mod console;
pub mod diagnostics;
pub mod display;
mod layout;
mod output;
pub mod progress;
pub mod shell;
pub mod study_progress;
mod trouble;

pub use layout::*;
pub use output::{CommandOutput, Ended};
pub use trouble::{ModelError, Trouble};

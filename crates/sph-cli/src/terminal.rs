//! Output in a terminal: texts, tables, progress and errors.

pub mod console;
pub mod diagnostics;
mod layout;
pub mod progress;
pub mod shell;
pub mod study_progress;
mod trouble;

pub use console::CommandOutput;
pub use layout::*;
pub use trouble::{Ended, ModelError, Trouble};

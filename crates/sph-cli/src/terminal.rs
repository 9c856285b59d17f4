//! Output in a terminal: texts, tables, progress and errors.

pub mod console;
pub mod diagnostics;
pub mod display;
pub mod layout;
pub mod output;
pub mod progress;
pub mod shell;
pub mod study_progress;
pub mod trouble;

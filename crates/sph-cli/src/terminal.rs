//! What is said: words, tables and progress in a terminal, and what went wrong.

pub mod console;
pub mod diagnostics;
pub mod layout;
pub mod output;
pub mod progress;
pub mod shell;
pub mod study_progress;
pub mod trouble;

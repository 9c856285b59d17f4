//! Results as tables, plots and a page.

pub mod matrix;
pub mod plots;
pub mod report;
pub mod table;

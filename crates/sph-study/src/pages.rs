//! Results as tables, plots and a page.

pub mod matrix_plots;
pub mod plots;
pub mod publish;
pub mod report;
pub mod table;

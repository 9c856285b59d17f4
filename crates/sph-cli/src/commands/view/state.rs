//! Present files of a run for its page.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value as Json, json};

use crate::commands::file_list::names;

/// Pictures by field, plots, whether there is a series and its first shown column, the summary if there is one.
pub fn folder_state(folder: &Path) -> Json {
    let summary = std::fs::read_to_string(folder.join("summary.json")).ok();
    let summary: Option<Json> = summary.and_then(|text| serde_json::from_str(&text).ok());
    let name = folder.file_name().map(|n| n.to_string_lossy().into_owned());
    json!({
        "name": name,
        "pictures": numbered(&folder.join("pictures")),
        "plots": names(&folder.join("plots"), "png"),
        "animations": names(&folder.join("animations"), "gif"),
        "bad": names(folder, "png"),
        "series": folder.join("series.csv").is_file(),
        "column": super::series::first_shown(&folder.join("series.csv")),
        "running": folder.join(".lock").exists(),
        "summary": summary,
    })
}

/// `pressure_0003.png` as the numbers of `pressure`.
fn numbered(folder: &Path) -> BTreeMap<String, Vec<String>> {
    let mut all: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for name in names(folder, "png") {
        if let Some((field, _)) = name.rsplit_once('_') {
            all.entry(field.to_string()).or_default().push(name);
        }
    }
    all
}

//! Everything a run needs to go on bit for bit.

use std::path::Path;

use serde::{Deserialize, Serialize};
use sph_io::{Checkpoint, Column, ColumnData};

use crate::error::DemError;
use crate::model::Saved;
use crate::origin::Origin;

/// Name of the checkpoint in a run's folder.
pub const FILE: &str = "checkpoint.sph";
/// Column with the state as JSON, four bytes a number.
const STATE: &str = "state";

/// How far a run has come.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Progress {
    /// Rows of the series written.
    pub rows: u64,
    /// Time of the last row, s.
    pub last_row: Option<f64>,
    /// Time of the last output of fields, s.
    pub last_output: Option<f64>,
    /// Bytes of the series.
    pub series: u64,
    /// Outputs of fields made.
    pub outputs: u64,
    /// Frames in the list for ParaView.
    pub frames: usize,
    /// Checkpoints made.
    pub checkpoints: u64,
    /// Ranges of the colours of pictures.
    #[serde(default)]
    pub colours: sph_io::ColourRanges,
    /// The last step, s.
    pub dt: f64,
    /// Steps by what limited them.
    pub limited: std::collections::BTreeMap<String, u64>,
    /// Wall-clock time so far, s. Kept beside the state, which has the same bits in equal runs.
    #[serde(skip)]
    pub wall_seconds: f64,
    /// That of the preparation, s.
    #[serde(skip)]
    pub preparation_seconds: f64,
}

/// The state itself.
#[derive(Debug, Deserialize, Serialize)]
pub struct Kept {
    /// The system.
    pub model: Saved,
    /// What measurements refer to.
    pub origin: Origin,
    /// How far it has come.
    pub progress: Progress,
}

/// Writes a checkpoint; `scene` tells later whether it is one of the same scene.
///
/// # Errors
/// If it cannot be written.
pub fn save(kept: &Kept, scene: &str, path: &Path) -> Result<(), DemError> {
    let bytes = serde_json::to_vec(kept).map_err(|e| DemError::Resume(e.to_string()))?;
    let words = bytes.chunks(4).map(|four| {
        let mut word = [b' '; 4];
        word[..four.len()].copy_from_slice(four);
        u32::from_le_bytes(word)
    });
    let checkpoint = Checkpoint {
        meta: serde_json::json!({
            "method": "grains",
            "scene": scene,
            "wall_seconds": kept.progress.wall_seconds,
            "preparation_seconds": kept.progress.preparation_seconds,
        }),
        columns: vec![Column {
            name: STATE.into(),
            components: 1,
            data: ColumnData::U32(words.collect()),
        }],
    };
    Ok(checkpoint.save(path)?)
}

/// Reads a checkpoint; with `changed` also one of another scene.
///
/// # Errors
/// A file that cannot be read; one of another scene or of particles.
pub fn load(scene: &str, changed: bool, path: &Path) -> Result<Kept, DemError> {
    let checkpoint = Checkpoint::load(path)?;
    let refused = |why: &str| DemError::Resume(format!("{}: {why}", path.display()));
    if checkpoint.meta["method"] != "grains" {
        return Err(refused("it is the checkpoint of a scene of particles"));
    }
    if checkpoint.meta["scene"] != scene && !changed {
        return Err(refused(
            "the scene has changed since; --changed goes on all the same, or start without --resume",
        ));
    }
    let column = checkpoint.column(STATE).map(|c| &c.data);
    let Some(ColumnData::U32(words)) = column else {
        return Err(refused("it holds no state"));
    };
    let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
    let kept = serde_json::from_slice(&bytes);
    let mut kept: Kept = kept.map_err(|e| refused(&e.to_string()))?;
    let seconds = |name: &str| checkpoint.meta[name].as_f64().unwrap_or_default();
    kept.progress.wall_seconds = seconds("wall_seconds");
    kept.progress.preparation_seconds = seconds("preparation_seconds");
    Ok(kept)
}

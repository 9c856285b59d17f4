//! Everything a run needs to go on bit for bit.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sph_run::{RunCounters, SavedState, save_state};

use crate::scene::error::DemError;
use crate::scene::model::Saved;
use crate::scene::origin::Origin;

/// Progress of a run.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct Progress {
    /// Counts of the driver. Their wall-clock time is kept beside the state, which has the same bits in equal runs.
    pub books: RunCounters,
    /// The last step, s.
    pub dt: f64,
    /// Steps by their limits.
    pub limited: BTreeMap<String, u64>,
    /// Wall-clock time of the preparation, s; kept beside the state as well.
    #[serde(skip)]
    pub preparation_seconds: f64,
}

/// The state itself.
#[derive(Debug, Deserialize, Serialize)]
pub struct CheckpointState {
    /// The system.
    pub model: Saved,
    /// Reference values of measurements.
    pub origin: Origin,
    /// Its progress.
    pub progress: Progress,
}

/// Writes a checkpoint; `scene` identifies the scene for a resume.
///
/// # Errors
/// If it cannot be written.
pub fn save(mut kept: CheckpointState, scene: &str, path: &Path) -> Result<(), DemError> {
    let meta = serde_json::json!({
        "method": "grains",
        "scene": scene,
        "wall_seconds": std::mem::take(&mut kept.progress.books.wall_seconds),
        "preparation_seconds": kept.progress.preparation_seconds,
    });
    Ok(save_state(path, meta, &kept)?)
}

/// Reads a checkpoint; with `changed` also one of another scene.
///
/// # Errors
/// A file that cannot be read; one of another scene or of particles.
pub fn load(scene: &str, changed: bool, path: &Path) -> Result<CheckpointState, DemError> {
    let saved = SavedState::load(path)?;
    let refused = |why: &str| DemError::Resume(format!("{}: {why}", path.display()));
    if saved.meta["method"] != "grains" {
        return Err(refused("it is the checkpoint of a scene of particles"));
    }
    if saved.meta["scene"] != scene && !changed {
        return Err(refused(
            "the scene has changed since; --changed goes on all the same, or start without --resume",
        ));
    }
    let mut kept: CheckpointState = saved.state().map_err(|e| refused(&e))?;
    let seconds = |name: &str| saved.meta[name].as_f64().unwrap_or_default();
    kept.progress.books.wall_seconds = seconds("wall_seconds");
    kept.progress.preparation_seconds = seconds("preparation_seconds");
    Ok(kept)
}

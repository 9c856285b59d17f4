//! Checkpoints of states with `serde`.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use sph_io::{Checkpoint, Column, ColumnData, IoError};

/// Column with the state as JSON, four bytes a number.
const STATE: &str = "state";

/// Writes a state as JSON, whose numbers come back bit for bit; `meta` is kept beside it, and is no part of it.
///
/// # Errors
/// If it cannot be written.
pub fn save_state(path: &Path, meta: Json, state: &impl Serialize) -> Result<(), IoError> {
    let bytes =
        serde_json::to_vec(state).map_err(|e| IoError::Input(path.into(), e.to_string()))?;
    let words = bytes.chunks(4).map(|four| {
        let mut word = [b' '; 4];
        word[..four.len()].copy_from_slice(four);
        u32::from_le_bytes(word)
    });
    let columns = vec![Column {
        name: STATE.into(),
        components: 1,
        data: ColumnData::U32(words.collect()),
    }];
    Checkpoint { meta, columns }.save(path)
}

/// A checkpoint of a state that [`save_state`] wrote.
pub struct SavedState {
    /// Content besides the state.
    pub meta: Json,
    words: Option<Vec<u32>>,
}

impl SavedState {
    /// Reads a checkpoint.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn load(path: &Path) -> Result<Self, IoError> {
        let checkpoint = Checkpoint::load(path)?;
        let mut columns = checkpoint.columns.into_iter();
        let words = match columns.find(|c| c.name == STATE).map(|c| c.data) {
            Some(ColumnData::U32(words)) => Some(words),
            _ => None,
        };
        let meta = checkpoint.meta;
        Ok(SavedState { meta, words })
    }

    /// The state.
    ///
    /// # Errors
    /// The fault of the state.
    pub fn state<T: DeserializeOwned>(&self) -> Result<T, String> {
        let words = self.words.as_ref().ok_or("it holds no state")?;
        let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
        serde_json::from_slice(&bytes).map_err(|e| e.to_string())
    }
}

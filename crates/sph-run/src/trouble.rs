//! The first sign that a run is in trouble.

use serde::{Deserialize, Serialize};

/// When, where and in which quantity a step first failed, whether or not a shorter one helped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trouble {
    /// Time of the state that was bad, s.
    pub time: f64,
    /// Steps taken before it.
    pub step: u64,
    /// The quantity, or the stage that reported it.
    pub quantity: String,
    /// The particle, where it is one's.
    pub particle: Option<u32>,
    /// Its place, m; empty if of no particle, or not finite.
    pub position: Vec<f64>,
    /// The value, if it is finite.
    pub value: Option<f64>,
    /// Reason.
    pub reason: String,
}

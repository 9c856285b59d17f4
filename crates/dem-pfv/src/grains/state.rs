//! The state of a system of grains.

use serde::{Deserialize, Serialize};

use crate::grains::{Grains, Mesh, Period, Table, Vector, Wall};

/// A step and the grain that sets it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct Limit {
    pub step: f64,
    pub grain: usize,
}

/// Everything a run needs to go on bit for bit, but for the contact laws: columns of the grains, walls,
/// meshes, and the memory of contacts. For any serde format that keeps every bit of a number.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub struct State {
    /// The grains; the next evaluation finds the contacts of those that were moved.
    pub grains: Grains,
    /// The walls.
    pub walls: Vec<Wall>,
    /// The meshes.
    pub meshes: Vec<Mesh>,
    /// Axes along which the box repeats itself.
    pub period: Period,
    /// Gravity, m/s².
    pub gravity: Vector,
    pub(crate) damping: f64,
    pub(crate) skin: f64,
    /// Time, s.
    pub time: f64,
    /// Steps made.
    pub steps: u64,
    /// Motion since the last evaluation, s.
    pub(crate) last_step: f64,
    pub(crate) limit: Option<Limit>,
    /// Step at which the limit is found anew.
    pub(crate) limit_due: u64,
    #[serde(rename = "contacts")]
    pub(crate) table: Table,
    /// Number of times that the lists of neighbours were made.
    pub renewals: u64,
}

//! Axes by name.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An axis.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// From left to right.
    #[default]
    X,
    /// From front to back.
    Y,
    /// Upwards.
    Z,
}

impl Axis {
    /// 0, 1 or 2.
    #[must_use]
    pub fn number(self) -> usize {
        self as usize
    }
}

//! An axis of space, as scenes name it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An axis of space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// The first.
    #[default]
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// 0, 1 or 2.
    pub fn number(self) -> usize {
        self as usize
    }
}

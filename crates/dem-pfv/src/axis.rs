//! Axes by name.

use serde::Serialize;
use sph_core::parameters;

/// An axis.
#[parameters]
#[derive(PartialEq, Serialize)]
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
    pub fn number(self) -> usize {
        self as usize
    }
}

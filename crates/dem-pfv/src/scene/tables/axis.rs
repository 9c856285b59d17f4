//! Axes by name.

use sph_core::parameters;

/// An axis.
#[parameters]
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

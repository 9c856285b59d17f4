//! An axis of space, as scenes name it.

use sph_derive::parameters;

/// An axis of space.
#[parameters(crate: crate::reexport)]
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

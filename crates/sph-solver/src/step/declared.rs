//! Declared columns of a flow's stages, gates and forces.

use sph_core::{Access, AnyField};

/// The columns of all parts of a flow, in its order: collected once, since each list takes memory.
#[derive(Default)]
pub(crate) struct Columns {
    pub stages: Vec<Access>,
    pub gates: Vec<Access>,
    /// Terms of the sweep, and those outside of it.
    pub forces: Vec<Access>,
}

/// True if one of these columns is written.
pub(crate) fn writes_any(access: &Access, fields: &[AnyField]) -> bool {
    fields.iter().any(|f| access.writes.contains(f))
}

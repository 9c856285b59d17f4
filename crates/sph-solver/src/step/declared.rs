//! What a flow's stages, gates and forces declare.

use sph_core::{Access, AnyField};

/// The columns of everybody at work, in the order of the flow: asked once, since each answer asks for memory.
#[derive(Default)]
pub(crate) struct Columns {
    pub stages: Vec<Access>,
    pub gates: Vec<Access>,
    /// Terms of the sweep, and those outside of it.
    pub forces: Vec<Access>,
}

/// Whether somebody writes one of these columns.
pub(crate) fn writes_any(access: &Access, fields: &[AnyField]) -> bool {
    fields.iter().any(|f| access.writes.contains(f))
}

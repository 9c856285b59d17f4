//! What a flow's stages, works and forces declare.

use sph_core::{Access, AnyField};

use crate::step::flow::Flow;

/// The columns of everybody at work, in the order of the flow: asked once, since each answer asks for memory.
#[derive(Default)]
pub(crate) struct Columns {
    pub stages: Vec<Access>,
    pub works: Vec<Access>,
    /// Terms of the sweep, and those outside of it.
    pub forces: Vec<Access>,
}

/// Whether somebody writes one of these columns.
pub(crate) fn writes_any(access: &Access, fields: &[AnyField]) -> bool {
    fields.iter().any(|f| access.writes.contains(f))
}

impl<const D: usize> Flow<D> {
    /// Asks everybody what they declare; after a change of who is at work.
    pub(crate) fn ask_all(&mut self) {
        let sweep = self.terms.iter().map(|term| term.access());
        let outside = self.outside.iter().map(|force| force.access());
        self.columns = Columns {
            stages: self.stages.iter().map(|stage| stage.access()).collect(),
            works: self.works.iter().map(|work| work.access()).collect(),
            forces: sweep.chain(outside).collect(),
        };
    }
}

//! Plugins as they are listed.

use serde_json::Value as Json;

/// Description of a plugin that is not built.
#[derive(Clone, Copy)]
pub struct PluginInfo {
    /// Name in scene files.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Publication and equation.
    pub source: &'static str,
    /// Crate and version that registered it.
    pub provider: &'static str,
    /// Dimensions it can be built in.
    pub dimensions: &'static [usize],
    /// JSON schema of its parameters.
    pub schema: fn() -> Json,
}

//! Plugins of a scene with their parameters.

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

/// A plugin with the parameters in force.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PluginInForce {
    /// Kind of plugin.
    pub kind: String,
    /// Name.
    pub name: String,
    /// Where in the scene it was asked for.
    pub path: String,
    /// Crate and version it comes from.
    pub provider: String,
    /// Given parameters and defaults.
    pub parameters: Json,
}

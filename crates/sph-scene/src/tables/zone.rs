//! The table `[zone.NAME]`: where the flow is computed with finer particles.

use sph_core::parameters;

/// A box in which the flow is computed with finer particles, too.
///
/// The scene's own particles stay everywhere; within the box they follow the finer ones, and finer ones in a band around
/// the box follow the scene's.
#[parameters]
pub struct Zone {
    /// Lower and upper corner of the box, m. It may reach beyond walls, and span a whole period.
    #[serde(rename = "box")]
    #[parameter(unit: "m")]
    pub bounds: [Vec<f64>; 2],
    /// Spacing in the zone over that of the scene: 1/2, or 1/4 and 1/8 within a zone of twice that.
    #[parameter(default: 0.5, above: 0, below: 1)]
    pub ratio: f64,
    /// Probes and gauges that are measured with the particles of the zone.
    #[parameter(default)]
    pub probes: Vec<String>,
}

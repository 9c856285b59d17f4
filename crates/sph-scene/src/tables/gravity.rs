//! The table `[numerics.gravity_over_time]`: the change of gravity over time.

use std::path::PathBuf;

use sph_core::parameters;

/// Acceleration that is added to `gravity` over time, m/s²; exactly one of `sine`, `table` and `file`.
///
/// In the frame of a tank that moves it is the acceleration of the tank with the other sign.
#[parameters]
pub struct GravityOverTime {
    /// Oscillation.
    pub sine: Option<GravitySine>,
    /// Rows of time, s, and one entry per dimension, m/s²; times rise, entries are linear between rows and constant before the first and after the last.
    #[parameter(unit: "1", min_items: 1)]
    pub table: Option<Vec<Vec<f64>>>,
    /// CSV file of such rows, relative to the scene's folder; units may stand in its first line, `ax[mm/s²]`.
    pub file: Option<String>,
    /// Names of the file's columns of time and of the entries; the first ones if left out.
    pub columns: Option<Vec<String>>,
    /// Factor that turns the file's entries into m/s²: 9.81 where they are in g.
    #[parameter(default: 1.0, unit: "1")]
    pub scale: f64,
    /// The file with its folder, set when the scene is read.
    #[serde(skip)]
    pub path: Option<PathBuf>,
}

/// Oscillation: a·r(t)·sin(2πt/T + φ).
#[parameters]
pub struct GravitySine {
    /// Amplitude a, m/s², one entry per dimension.
    #[parameter(unit: "m/s²")]
    pub amplitude: Vec<f64>,
    /// Period T, s.
    #[parameter(unit: "s", above: 0.0)]
    pub period: f64,
    /// Phase φ, rad.
    #[parameter(default, unit: "rad")]
    pub phase: f64,
    /// Time, s, over which r rises smoothly from 0 to 1; at once if 0.
    #[parameter(default, unit: "s", min: 0.0)]
    pub ramp: f64,
}

//! The table `[output]`.

use scene_text::PictureRange;
use sph_core::parameters;

/// Files of a run, and the times of writing.
#[parameters]
pub struct Output {
    /// Simulated time between pictures and files for ParaView, s; a twentieth of the end if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub every: Option<f64>,
    /// Simulated time between rows of the series, s; a five-hundredth of the end if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub series_every: Option<f64>,
    /// Fields of which pictures are drawn; none if left out.
    #[parameter(default)]
    pub picture: Vec<String>,
    /// Values at the ends of the pictures' colours, SI: `[low, high]` for all pictures, or a table of fields with such
    /// pairs. Where none is given, round numbers that hold 98 % of the values of the first picture in which they differ.
    #[parameter(unit: "1")]
    pub picture_range: Option<PictureRange>,
    /// Pictures per second of the film of every field that has pictures, `animations/NAME.gif`; 10 if left out, 0 for no film.
    #[parameter(unit: "1/s", min: 0.0, max: 50.0)]
    pub animation: Option<f64>,
    /// True if files for ParaView are left out.
    #[parameter(default)]
    pub no_vtk: bool,
}

impl Output {
    /// Simulated time between outputs in force, s, for a run of `end` seconds.
    pub fn interval(&self, end: f64) -> f64 {
        self.every.unwrap_or(end / 20.0)
    }

    /// Simulated time between rows in force, s.
    pub fn series_interval(&self, end: f64) -> f64 {
        self.series_every.unwrap_or(end / 500.0)
    }
}

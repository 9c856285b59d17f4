//! The table `[output]`: files of a run, and the times of writing.

use scene_text::PictureRange;
use sph_core::parameters;

use crate::tables::motion::{OneOrMany, one_or_many};

/// Files of a run, and the times of writing.
#[parameters]
pub struct Output {
    /// Simulated time between outputs of fields, s; a hundredth of the end if neither this nor `times` is given.
    #[parameter(default, unit: "s", above: 0.0)]
    pub every: Option<f64>,
    /// Times of the outputs of fields, s, rising.
    #[parameter(default, unit: "s")]
    pub times: Option<Vec<f64>>,
    /// Simulated time between rows of the series, s; a thousandth of the end if left out.
    #[parameter(default, unit: "s", above: 0.0)]
    pub series_every: Option<f64>,
    /// Names of the fields that are written.
    #[parameter(default: ["velocity", "pressure", "density"].map(String::from).to_vec())]
    pub fields: Vec<String>,
    /// Name of a field, or a list of names, of which pictures are drawn.
    #[serde(deserialize_with = "one_or_many")]
    #[schemars(with = "OneOrMany<String>")]
    #[parameter(default)]
    pub picture: Vec<String>,
    /// Values at the ends of the pictures' colours, SI: `[low, high]` for all pictures, or a table of fields with such
    /// pairs. Where none is given: pressure of the fluid at rest and `velocity_scale`, for other fields round numbers that hold
    /// 98 % of the values of the first picture in which they differ.
    #[parameter(default, unit: "1")]
    pub picture_range: Option<PictureRange>,
    /// Pictures per second of the film of every field that has pictures, `animations/NAME.gif`; 10 if left out, 0 for no film.
    #[parameter(default, unit: "1/s", min: 0.0, max: 50.0)]
    pub animation: Option<f64>,
    /// True if files for ParaView are written.
    #[parameter(default: true)]
    pub vtk: bool,
}

impl Output {
    /// Pictures per second of films; none where there are none.
    pub fn pictures_per_second(&self) -> Option<f64> {
        Some(self.animation.unwrap_or(10.0)).filter(|speed| *speed > 0.0)
    }

    /// Simulated time between rows of the series in force, s, for a run of `end` seconds.
    pub fn series_interval(&self, end: f64) -> f64 {
        self.series_every.unwrap_or(end / 1000.0)
    }

    /// The first output time after `time`, s, if there is one up to `end`.
    ///
    /// The start is an output where outputs are at intervals; ask with a negative time.
    pub fn next_after(&self, time: f64, end: f64) -> Option<f64> {
        if let Some(times) = &self.times {
            return times.iter().copied().find(|t| *t > time);
        }
        let every = self.every.unwrap_or(end / 100.0);
        if time < 0.0 {
            return Some(0.0);
        }
        if time >= end {
            return None;
        }
        let k = (time / every * (1.0 + 1e-12)).floor() + 1.0;
        Some((k * every).min(end))
    }
}

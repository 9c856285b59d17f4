//! The table `[wall.NAME.motion]`: rigid motion over time.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use sph_core::course::Course;
use sph_core::parameters;

/// Rigid motion of a wall: translations, added up, and a rotation about a centre that they carry.
///
/// Courses count their time from `start` and hold the values reached at `stop`.
#[parameters]
pub struct Motion {
    /// Constant velocity, m/s; none if left out.
    #[parameter(unit: "m/s")]
    pub velocity: Option<Vec<f64>>,
    /// Constant angular velocity, rad/s, anticlockwise; in 3D right-handed about `axis`.
    #[parameter(default, unit: "rad/s")]
    pub angular_velocity: f64,
    /// Centre of the rotation at the start, m; needed where there is an `angular_velocity`.
    #[parameter(unit: "m")]
    pub centre: Option<Vec<f64>>,
    /// Axis of the `angular_velocity`; its length does not matter. Three dimensions only, and needed there.
    #[parameter(unit: "1")]
    pub axis: Option<Vec<f64>>,
    /// Translation, or a list of translations that are added up.
    #[serde(deserialize_with = "one_or_many")]
    #[parameter(default)]
    #[schemars(with = "OneOrMany<Translate>")]
    pub translate: Vec<Translate>,
    /// Rotation.
    pub rotate: Option<Rotation>,
    /// Levels that the wall follows instead, place by place: a floor on a bed that settles. Two dimensions only.
    pub levels: Option<Levels>,
    /// Time at which the motion starts, s.
    #[parameter(default, unit: "s", min: 0.0)]
    pub start: f64,
    /// Time at which the motion stops, s; never if left out.
    #[parameter(unit: "s", min: 0.0)]
    pub stop: Option<f64>,
}

/// Places of the wall are lifted by the rise of a level since the start, linear between places along x; courses of
/// levels are smooth between the rows of the table, at rest before the first and after the last.
#[parameters]
pub struct Levels {
    /// A table with a column `time` (s) and one of levels (m) for each place, relative to the scene's folder: `series.csv` of a
    /// run, for example.
    pub file: String,
    /// Places of the levels, ascending along x, m.
    #[parameter(unit: "m", min_items: 1)]
    pub places: Vec<f64>,
    /// The columns of these places.
    #[parameter(min_items: 1)]
    pub columns: Vec<String>,
    /// Unit of the levels, such as "mm"; that in the head of each column, else metres, if left out.
    pub unit: Option<String>,
    /// Time of the table at which the run starts, s; the wall is drawn as it is then.
    #[parameter(default, unit: "s")]
    pub start: f64,
    /// The file with its folder, set when the scene is read.
    #[serde(skip)]
    pub path: Option<PathBuf>,
}

/// Translation along a direction; exactly one of `speed`, `ramp`, `sine`, `table` and `file`.
#[parameters]
pub struct Translate {
    /// Direction; its length does not matter.
    #[parameter(unit: "1")]
    pub along: Vec<f64>,
    /// Constant speed, m/s.
    #[parameter(unit: "m/s")]
    pub speed: Option<f64>,
    /// From rest to a speed with constant acceleration.
    pub ramp: Option<Ramp>,
    /// Oscillation.
    pub sine: Option<Sine>,
    /// Its rows.
    #[serde(flatten)]
    pub rows: CourseRows,
}

/// Rotation about a centre; exactly one of `speed`, `ramp`, `sine`, `table` and `file`.
#[parameters]
pub struct Rotation {
    /// Centre at the start, m.
    #[parameter(unit: "m")]
    pub centre: Vec<f64>,
    /// Axis, right-handed; its length does not matter. Three dimensions only, and needed there.
    #[parameter(unit: "1")]
    pub axis: Option<Vec<f64>>,
    /// Constant angular speed, rad/s.
    #[parameter(unit: "rad/s")]
    pub speed: Option<f64>,
    /// From rest to an angular speed with constant acceleration.
    pub ramp: Option<AngularRamp>,
    /// Oscillation.
    pub sine: Option<AngularSine>,
    /// Its rows.
    #[serde(flatten)]
    pub rows: CourseRows,
}

/// A course as rows of time and displacement, m, or angle, rad: in the scene or in a file.
#[parameters]
pub struct CourseRows {
    /// Pairs of time, s, and displacement, m, or angle, rad; times rise, and the wall is where it is drawn until the first, from which they count.
    #[parameter(unit: "1")]
    pub table: Option<Vec<[f64; 2]>>,
    /// CSV file of time and displacement or angle, relative to the scene's folder.
    pub file: Option<String>,
    /// Unit of the displacements or angles in the `file`, such as "mm" or "deg"; that in the head of the column, else metres or radians, if left out.
    pub unit: Option<String>,
    /// Factor that turns the file's numbers into metres or radians, instead of a unit.
    #[parameter(unit: "1")]
    pub scale: Option<f64>,
    /// Unit of the times in the `file`; that in the head of the column, else seconds, if left out.
    pub time_unit: Option<String>,
    /// Names of the file's columns of time and displacement or angle, or their numbers from 1; the only two if left out.
    #[parameter(min_items: 2, max_items: 2)]
    pub columns: Option<Vec<String>>,
    /// The file with its folder, set when the scene is read.
    #[serde(skip)]
    pub path: Option<PathBuf>,
}

/// From rest to a speed with constant acceleration.
#[parameters]
pub struct Ramp {
    /// Speed that is reached, m/s.
    #[parameter(unit: "m/s")]
    pub speed: f64,
    /// Time in which it is reached, s.
    #[parameter(unit: "s", above: 0.0)]
    pub over: f64,
}

/// From rest to an angular speed with constant acceleration.
#[parameters]
pub struct AngularRamp {
    /// Angular speed that is reached, rad/s.
    #[parameter(unit: "rad/s")]
    pub speed: f64,
    /// Time in which it is reached, s.
    #[parameter(unit: "s", above: 0.0)]
    pub over: f64,
}

/// Oscillation: a·r(t)·sin(2πt/T + φ), less its value at t = 0.
#[parameters]
pub struct Sine {
    /// Amplitude a of the displacement, m.
    #[parameter(unit: "m")]
    pub amplitude: f64,
    /// Its times.
    #[serde(flatten)]
    pub oscillation: Oscillation,
}

/// Oscillation: a·r(t)·sin(2πt/T + φ), less its value at t = 0.
#[parameters]
pub struct AngularSine {
    /// Amplitude a of the angle, rad.
    #[parameter(unit: "rad")]
    pub amplitude: f64,
    /// Its times.
    #[serde(flatten)]
    pub oscillation: Oscillation,
}

/// Times of an oscillation a·r(t)·sin(2πt/T + φ).
#[parameters]
pub struct Oscillation {
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

impl Oscillation {
    /// The course of an amplitude a.
    pub fn course(&self, amplitude: f64) -> Course {
        Course::sine(amplitude, self.period, self.phase, self.ramp)
    }
}

impl Motion {
    /// Key of a translation; a single table has no number.
    pub(crate) fn translate_key(&self, k: usize) -> String {
        match self.translate.len() {
            1 => "translate".to_string(),
            _ => format!("translate[{k}]"),
        }
    }
}

/// One value or a list.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum OneOrMany<T> {
    /// One.
    One(T),
    /// Several.
    Many(Vec<T>),
}

pub(crate) fn one_or_many<'de, T, D>(from: D) -> Result<Vec<T>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    OneOrMany::deserialize(from).map(|given| match given {
        OneOrMany::One(one) => vec![one],
        OneOrMany::Many(many) => many,
    })
}

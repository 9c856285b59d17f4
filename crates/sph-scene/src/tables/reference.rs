//! The table `[reference.NAME]`: the reference of a result, and the norm of the difference.

use std::path::PathBuf;

use sph_core::parameters;
use toml::Table;

use crate::reading::plugins::AnyTable;

/// A comparison of a probe or a field with data or with a closed form.
#[parameters]
pub struct Reference {
    /// Name of the probe or gauge that is compared; with the suffix of the column where it has several, `drop.highest`.
    pub probe: Option<String>,
    /// Name of the field that is compared at the particles.
    pub field: Option<String>,
    /// CSV file of the reference, relative to the scene's folder.
    pub file: Option<String>,
    /// Name of a reference solution in closed form.
    pub solution: Option<String>,
    /// Parameters of the reference solution.
    #[parameter(default)]
    #[schemars(with = "AnyTable")]
    pub parameters: Table,
    /// Names of the file's columns of time (or place) and value; the first two columns if left out.
    #[parameter(min_items: 2, max_items: 2)]
    pub columns: Option<Vec<String>>,
    /// Column of the lower limit, for the norm `band`.
    pub lower: Option<String>,
    /// Column of the upper limit, for the norm `band`.
    pub upper: Option<String>,
    /// Factor that turns the file's first column into SI.
    #[parameter(default: 1.0, unit: "1")]
    pub scale_time: f64,
    /// Factor that turns the file's values into SI.
    #[parameter(default: 1.0, unit: "1")]
    pub scale_value: f64,
    /// Added to the first column after scaling.
    #[parameter(default, unit: "1")]
    pub offset_time: f64,
    /// Added to the values after scaling.
    #[parameter(default, unit: "1")]
    pub offset_value: f64,
    /// Width of the centred moving mean taken of the probe before it is compared, s: it removes the sound that a weakly compressible fluid adds. None if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub average: Option<f64>,
    /// First and last time that counts, s; all times if left out.
    #[parameter(unit: "s")]
    pub window: Option<[f64; 2]>,
    /// First and last time that does not count, s.
    #[parameter(unit: "s")]
    pub exclude: Option<[f64; 2]>,
    /// Value of the reference in SI, for the norm `mean`.
    pub value: Option<f64>,
    /// Period of the reference, s, for the norms `lag` and `period`.
    #[parameter(unit: "s", above: 0.0)]
    pub period: Option<f64>,
    /// Norm of the difference; `rms-over-range` for probes and `l2` for fields if left out.
    pub norm: Option<Norm>,
    /// The file with its folder, set when the scene is read.
    #[serde(skip)]
    pub path: Option<PathBuf>,
}

/// Norm of a difference.
///
/// `u` is the result and `e` the reference; over particles the sums weigh with the volume V.
#[parameters]
pub enum Norm {
    /// Root-mean-square of u − e at the reference's times over the range of e.
    RmsOverRange,
    /// √(Σ V|u − e|² / Σ V|e|²).
    L2,
    /// Mean of `l2` over the rows of the series in `window`; the series has it as `error.NAME`.
    L2Mean,
    /// Σ |‖u‖ − ‖e‖| / Σ ‖e‖.
    L1,
    /// max |u − e| / max |e|.
    Linf,
    /// |Σ V u·e / Σ V e² − 1|: the amplitude of e in u, whatever else u has.
    Amplitude,
    /// √(Σ V|u − e|² / Σ V) over `scale_value`: for fields at rest.
    Rms,
    /// |u − e| / |e| at the last time.
    Final,
    /// Largest |u − e|, in the unit of the result.
    Absolute,
    /// Relative difference of the slopes of ln u and ln e over time: rates of decay.
    DecayRate,
    /// Relative difference of the ranges of u and e: wave heights.
    Range,
    /// Size of the delay at which u correlates best with e, over `period`: phases.
    Lag,
    /// |mean of u over `window` − `value`| / |`value`|.
    Mean,
    /// Mean of u over `window`, in its unit: for a probe that is an error itself.
    ErrorMean,
    /// Relative difference of the period of u, from where it crosses its mean, and `period`.
    Period,
    /// Relative difference of the times at which u and e are largest.
    PeakTime,
    /// Share of the time, as the reference samples it, that u lies outside the columns `lower` and `upper`.
    Band,
}

impl Norm {
    /// Name in scenes and summaries.
    pub fn name(self) -> String {
        let name = serde_json::to_value(self).unwrap_or_default();
        name.as_str().unwrap_or_default().to_string()
    }
}

impl Reference {
    /// True if the norm compares with nothing but a number of the reference, or with nothing at all.
    pub fn stands_alone(&self) -> bool {
        matches!(self.norm(), Norm::Mean | Norm::ErrorMean | Norm::Period)
    }

    /// The norm in force.
    pub fn norm(&self) -> Norm {
        let default = match self.field {
            Some(_) => Norm::L2,
            None => Norm::RmsOverRange,
        };
        self.norm.unwrap_or(default)
    }
}

//! The table `[reference.NAME]`.

use sph_core::parameters;

/// A comparison of the `kind`.
#[parameters]
#[serde(tag = "kind")]
pub enum Reference {
    /// Consolidation in one dimension after Terzaghi, drained at top and bottom, with the C_v of `[oedometer]`: root mean
    /// square of the difference, in terms of the load.
    Terzaghi {
        /// Name of a probe of the kind `consolidation`, or of a pressure in the middle divided by the load.
        probe: String,
        /// Mean diameters by which the way to the drained walls is shorter than half the height.
        #[parameter(default, unit: "1", min: 0.0)]
        shorter_by: f64,
        /// Time factor T_v at which it begins.
        #[parameter(default: 0.1, unit: "1", min: 0.0)]
        from: f64,
        /// Time factor at which it ends.
        #[parameter(default: 1.0, unit: "1", above: 0.0)]
        to: f64,
    },
    /// A number: |x / value − 1|, or |x| where the value is zero.
    Value {
        /// Name of the probe.
        probe: String,
        /// The number, in the unit of the probe.
        value: f64,
        /// Statistic of the rows.
        #[parameter(default)]
        of: Statistic,
        /// Time of the first row, s.
        #[parameter(unit: "s")]
        from: Option<f64>,
        /// Time of the last row, s.
        #[parameter(unit: "s")]
        to: Option<f64>,
    },
    /// A law C aⁿ of a = H₀/L₀ from a table with the columns geometry, quantity, range, C, n: |x / law − 1| of the last row.
    Scaling {
        /// Name of a probe of the kind `run-out`.
        probe: String,
        /// The table.
        file: String,
        /// Geometry of the rows.
        geometry: String,
        /// Quantity of the rows.
        quantity: String,
    },
    /// A straight line through the rows of two probes: 1 − R².
    Line {
        /// Name of the probe along the line.
        along: String,
        /// Name of the probe that should be linear.
        probe: String,
        /// Time of the first row, s.
        #[parameter(unit: "s")]
        from: Option<f64>,
        /// Time of the last row, s.
        #[parameter(unit: "s")]
        to: Option<f64>,
    },
    /// A curve from a table: root mean square of the difference at its rows, over its range.
    Curve {
        /// Name of the probe.
        probe: String,
        /// The table, with a column `time[s]`, or `time_factor` with `[oedometer]`.
        file: String,
        /// Its column.
        column: String,
    },
}

/// Statistic of the rows of a probe.
#[parameters]
#[serde(rename_all = "lowercase")]
pub enum Statistic {
    /// Their mean, by time.
    #[default]
    Mean,
    /// The last one.
    Last,
    /// The largest.
    Largest,
    /// The smallest.
    Smallest,
}

//! The tables `[probe.NAME]` and `[reference.NAME]`.

use sph_core::parameters;

use super::Axis;

/// A measurement of the `kind`.
#[parameters]
#[serde(tag = "kind")]
pub enum Probe {
    /// Total normal stress on a wall, Pa: that of the grains and that of the fluid.
    Stress {
        /// Name of the wall.
        wall: String,
    },
    /// Load of the grains on a wall over the buoyant weight of all grains: contacts alone, not the fluid.
    Borne {
        /// Name of the wall.
        wall: String,
    },
    /// Share of the buoyant weight of all grains that the fluid carries: the sum of its forces without buoyancy.
    Carried {},
    /// Mean pressure of a layer of pores, Pa.
    Pressure {
        /// Axis across the layer.
        axis: Axis,
        /// Its begin, m.
        #[parameter(unit: "m")]
        from: f64,
        /// Its end, m.
        #[parameter(unit: "m")]
        to: f64,
        /// Pressure by which it is divided, Pa.
        #[parameter(unit: "Pa", above: 0.0)]
        over: Option<f64>,
    },
    /// −dp/dx of a layer over the buoyant weight of the grains in it, per volume: 1 where nothing is left of the effective
    /// stress (page §5.21, Eq. 6.28).
    Gradient {
        /// Axis across the layer.
        axis: Axis,
        /// Its begin, m.
        #[parameter(unit: "m")]
        from: f64,
        /// Its end, m.
        #[parameter(unit: "m")]
        to: f64,
        /// Part of the box along x in which it is taken, m; all of it if left out.
        #[parameter(unit: "m")]
        between: Option<[f64; 2]>,
    },
    /// Normal contact force across a plane over its area, Pa: the effective stress.
    EffectiveStress {
        /// Axis across the plane.
        axis: Axis,
        /// Coordinate of the place, m.
        #[parameter(unit: "m")]
        at: f64,
    },
    /// Logarithmic strain of the box along an axis since the start, positive in compression.
    Strain {
        /// The axis.
        axis: Axis,
    },
    /// Logarithmic strain of the volume of the box since the start, positive in dilation.
    VolumetricStrain {},
    /// Stress of the two walls across an axis less that of the others, Pa.
    Deviator {
        /// The axis.
        axis: Axis,
    },
    /// Mean normal stress, Pa: of all walls, or that of the contacts where the box is periodic.
    MeanStress {},
    /// K₀ of a layer: mean of the two normal stresses of the grains across an axis over that along it, 1 where it is
    /// isotropic. Grains count by their centres.
    K0 {
        /// Axis of the load.
        axis: Axis,
        /// Begin of the layer along it, m.
        #[parameter(unit: "m")]
        from: f64,
        /// Its end, m.
        #[parameter(unit: "m")]
        to: f64,
    },
    /// Share of the contacts between grains that are at the limit of friction.
    Sliding {},
    /// Mean over the grains of √(2/3 e : e), e the deviator of the strain around a grain since the start. Catalano 2012,
    /// Eqs. (2.20), (2.21).
    StrainDeviator {},
    /// Porosity of a layer, grains cut by its planes.
    Porosity {
        /// Axis across the layer.
        axis: Axis,
        /// Its begin, m.
        #[parameter(unit: "m")]
        from: f64,
        /// Its end, m.
        #[parameter(unit: "m")]
        to: f64,
    },
    /// Highest point of a grain, m.
    Top {},
    /// Mean height of the bed's surface in a strip, m: of the grains as seen from above, and of the floor between them. Water
    /// of another scene follows it (`[wall.NAME.motion.levels]` there).
    Level {
        /// Axis along which the strip is cut out, x or y.
        #[parameter(default)]
        axis: Axis,
        /// Its begin, m.
        #[parameter(unit: "m")]
        from: f64,
        /// Its end, m.
        #[parameter(unit: "m")]
        to: f64,
    },
    /// Decrease of the mean height of the grains since the start, m.
    Settlement {},
    /// Share of the final dry strain that is reached, with `[oedometer]`.
    Consolidation {},
    /// (L − L₀)/L₀ of a deposit: L is where it is first thinner than a grain, so grains that roll on ahead do not count.
    RunOut {
        /// Axis along which it spreads.
        axis: Axis,
        /// L₀, m.
        #[parameter(unit: "m", above: 0.0)]
        length: f64,
    },
    /// Mean displacement since the start of the grains that were in a part of the space, m.
    Displacement {
        /// Axis along which it is taken.
        axis: Axis,
        /// Lower corner of that part, m.
        #[parameter(unit: "m")]
        low: [f64; 3],
        /// Upper corner, m.
        #[parameter(unit: "m")]
        high: [f64; 3],
    },
    /// Flow into the pores through a wall, m³/s, negative if out of them, at the last step.
    Flux {
        /// Name of a wall of the box.
        wall: String,
    },
    /// Permeability κ of the packing along an axis, m²: κ = µ Q L/(A Δp) with a pressure Δp between the two walls
    /// across the axis, others closed, and the grains held, for any conditions of the scene at its walls. Every row
    /// solves for it.
    Permeability {
        /// The axis.
        axis: Axis,
    },
    /// Pressure amplitude of the wave on a wall, Pa, without its swing.
    Amplitude {
        /// Name of the wall.
        wall: String,
    },
}

impl Probe {
    /// Number of the axis across a layer or a strip, and its ends, m.
    pub(crate) fn layer(&self) -> Option<(usize, [f64; 2])> {
        use Probe::{Gradient, K0, Level, Porosity, Pressure};
        let (Pressure { axis, from, to, .. }
        | Gradient { axis, from, to, .. }
        | Level { axis, from, to }
        | K0 { axis, from, to }
        | Porosity { axis, from, to }) = self
        else {
            return None;
        };
        Some((axis.number(), [*from, *to]))
    }
}

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

impl Reference {
    /// First and last time, s, or time factor of the rows that are compared.
    pub(crate) fn window(&self) -> [Option<f64>; 2] {
        match self {
            Self::Terzaghi { from, to, .. } => [*from, *to].map(Some),
            Self::Value { from, to, .. } | Self::Line { from, to, .. } => [*from, *to],
            Self::Scaling { .. } | Self::Curve { .. } => [None; 2],
        }
    }

    /// Name of the probe that is compared.
    pub(crate) fn probe(&self) -> &str {
        match self {
            Self::Terzaghi { probe, .. } | Self::Value { probe, .. } | Self::Line { probe, .. } => {
                probe
            }
            Self::Scaling { probe, .. } | Self::Curve { probe, .. } => probe,
        }
    }
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

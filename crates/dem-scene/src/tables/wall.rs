//! The tables `[box]` and `[wall.NAME]`.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{AnyPlugins, Axis, Plugins, Triple};

/// A box of six walls, `left`, `right` (x), `front`, `back` (y), `bottom`, `top` (z).
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Box {
    /// Lower corner, m.
    #[schemars(extend("unit" = "m"))]
    pub low: Triple,
    /// Upper corner, m.
    #[schemars(extend("unit" = "m"))]
    pub high: Triple,
    /// Axes along which it repeats itself instead of having two walls.
    #[serde(default)]
    pub periodic: Vec<Axis>,
    /// Walls that it does not have.
    #[serde(default)]
    pub open: Vec<String>,
    /// The law of contacts with its walls, `[box.contact.LAW]`; that of the grains if left out.
    #[serde(default)]
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
}

/// What more there is to a wall of the box; or a plane with `point` and `normal`; or a surface of triangles from a
/// `file`.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Wall {
    /// A point of the plane, m.
    #[schemars(extend("unit" = "m"))]
    pub point: Option<Triple>,
    /// Its normal, towards the grains, of any length.
    pub normal: Option<Triple>,
    /// An STL file.
    pub file: Option<String>,
    /// Unit of the coordinates of the `file`, such as "mm"; metres if left out.
    pub unit: Option<String>,
    /// Factor on the coordinates of the `file`, instead of a unit.
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0))]
    pub scale: Option<f64>,
    /// Shift of what is in the `file`, after it is scaled, m.
    #[schemars(extend("unit" = "m"))]
    pub translate: Option<Triple>,
    /// Velocity, m/s.
    #[schemars(extend("unit" = "m/s"))]
    pub velocity: Option<Triple>,
    /// Angular velocity of a surface of triangles about `point`, rad/s.
    #[schemars(extend("unit" = "1/s"))]
    pub spin: Option<Triple>,
    /// The law of contacts with it, `[wall.NAME.contact.LAW]`.
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
    /// Lets it move freely along its normal under a load.
    pub piston: Option<Piston>,
    /// Holds a stress.
    pub servo: Option<Servo>,
    /// Rate of strain between this wall and the one that faces it, 1/s, positive when they approach; give it to both.
    #[schemars(extend("unit" = "1/s"))]
    pub strain_rate: Option<f64>,
    /// Whether it is there during the preparation only: a gate.
    pub removed: bool,
    /// Pressure of the fluid there, Pa.
    #[schemars(extend("unit" = "Pa"))]
    pub pressure: Option<f64>,
    /// Even inflow of fluid, m/s; negative lets it out.
    #[schemars(extend("unit" = "m/s"))]
    pub inflow: Option<f64>,
    /// Pressure of waves.
    pub wave: Option<WaveLoad>,
    /// Pressure from a table, such as the series of a scene with a free surface.
    pub recorded: Option<RecordedLoad>,
    /// Whether fluid sticks to it.
    pub sticks: bool,
}

/// A wall that is a body: M dv/dt = σ A − F. σ = stress + ramp · t + amplitude · sin(2π t / period).
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Piston {
    /// Stress σ from outside, Pa, positive in compression.
    #[schemars(extend("unit" = "Pa"))]
    pub stress: f64,
    /// Stress while the grains settle before the run, Pa; the same if left out.
    #[schemars(extend("unit" = "Pa"))]
    pub prepared: Option<f64>,
    /// Its mass over that of the grains.
    #[serde(default = "twentieth")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0))]
    pub mass_share: f64,
    /// Growth of the stress, Pa/s.
    #[serde(default)]
    #[schemars(extend("unit" = "Pa/s"))]
    pub ramp: f64,
    /// Amplitude of a stress that swings, Pa.
    #[serde(default)]
    #[schemars(extend("unit" = "Pa"))]
    pub amplitude: f64,
    /// Its period, s.
    #[schemars(extend("unit" = "s", "exclusiveMinimum" = 0.0))]
    pub period: Option<f64>,
}

/// A wall that is moved so that it bears a stress.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Servo {
    /// Stress, Pa, positive in compression.
    #[schemars(extend("unit" = "Pa"))]
    pub stress: f64,
    /// Largest speed, m/s.
    #[schemars(extend("unit" = "m/s", "exclusiveMinimum" = 0.0))]
    pub speed: f64,
}

/// p = (amplitude + ramp · t) cos(π (x − crest) / half_length), times sin(2π t / period) if there is one. Catalano 2012,
/// §6.3.2 and §6.4.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WaveLoad {
    /// Axis along which it runs.
    #[serde(default)]
    pub axis: Axis,
    /// Place of the crest, m.
    #[serde(default)]
    #[schemars(extend("unit" = "m"))]
    pub crest: f64,
    /// Half the length of the wave, m.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub half_length: f64,
    /// Amplitude of the pressure at the start, Pa.
    #[serde(default)]
    #[schemars(extend("unit" = "Pa"))]
    pub amplitude: f64,
    /// Growth of the amplitude, Pa/s.
    #[serde(default)]
    #[schemars(extend("unit" = "Pa/s"))]
    pub ramp: f64,
    /// Period, s; the load stands still if left out.
    #[schemars(extend("unit" = "s", "exclusiveMinimum" = 0.0))]
    pub period: Option<f64>,
}

/// p(x, t) less `less`, linear between places and rows, constant before the first and after the last. The pressure is
/// piezometric: take off that of still water.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordedLoad {
    /// A table with a column `time` (s) and one of pressures (Pa) for each place: `series.csv` of `sph run`, for example.
    pub file: String,
    /// Axis along which the places are.
    #[serde(default)]
    pub axis: Axis,
    /// Where the pressures were taken, m.
    #[schemars(extend("unit" = "m", "minItems" = 1))]
    pub places: Vec<f64>,
    /// The columns of these places.
    pub columns: Vec<String>,
    /// Time of the table at which the run starts, s.
    #[serde(default)]
    #[schemars(extend("unit" = "s"))]
    pub start: f64,
    /// What is taken off all pressures, Pa.
    #[serde(default)]
    #[schemars(extend("unit" = "Pa"))]
    pub less: f64,
}

fn twentieth() -> f64 {
    0.05
}

//! The tables `[box]` and `[wall.NAME]`.

use sph_core::parameters;

use super::{AnyPlugins, Axis, Plugins, Wave};

/// A box of six walls, `left`, `right` (x), `front`, `back` (y), `bottom`, `top` (z).
#[parameters]
pub struct Box {
    /// Lower corner, m.
    #[parameter(unit: "m")]
    pub low: [f64; 3],
    /// Upper corner, m.
    #[parameter(unit: "m")]
    pub high: [f64; 3],
    /// Axes along which it repeats itself instead of having two walls.
    #[parameter(default)]
    pub periodic: Vec<Axis>,
    /// Walls that it does not have.
    #[parameter(default)]
    pub open: Vec<String>,
    /// The law of contacts with its walls, `[box.contact.LAW]`; that of the grains if left out.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
}

/// Further properties of a wall of the box; or a plane with `point` and `normal`; or a surface of triangles from a
/// `file`.
#[parameters]
pub struct Wall {
    /// A point of the plane, m.
    #[parameter(unit: "m")]
    pub point: Option<[f64; 3]>,
    /// Its normal, towards the grains, of any length.
    pub normal: Option<[f64; 3]>,
    /// An STL file.
    pub file: Option<String>,
    /// Unit of the coordinates of the `file`, such as "mm"; metres if left out.
    pub unit: Option<String>,
    /// Factor on the coordinates of the `file`, instead of a unit.
    #[parameter(unit: "1", above: 0.0)]
    pub scale: Option<f64>,
    /// Shift of the surface of the `file`, after scaling, m.
    #[parameter(unit: "m")]
    pub translate: Option<[f64; 3]>,
    /// Velocity, m/s.
    #[parameter(unit: "m/s")]
    pub velocity: Option<[f64; 3]>,
    /// Angular velocity of a surface of triangles about `point`, rad/s.
    #[parameter(unit: "1/s")]
    pub spin: Option<[f64; 3]>,
    /// The law of contacts with it, `[wall.NAME.contact.LAW]`.
    #[schemars(with = "AnyPlugins")]
    #[parameter(default)]
    pub contact: Plugins,
    /// Lets it move freely along its normal under a load.
    pub piston: Option<Piston>,
    /// Holds a stress.
    pub servo: Option<Servo>,
    /// Rate of strain between this wall and the one that faces it, 1/s, positive when they approach; give it to both.
    #[parameter(unit: "1/s")]
    pub strain_rate: Option<f64>,
    /// True for a wall that gives way as much as others press in, so that the volume of the box stays: an undrained test
    /// without a fluid.
    #[parameter(default)]
    pub keeps_volume: bool,
    /// True for a gate, which is there during the preparation only.
    #[parameter(default)]
    pub removed: bool,
    /// Pressure of the fluid there, Pa.
    #[parameter(unit: "Pa")]
    pub pressure: Option<f64>,
    /// Even inflow of fluid, m/s; negative lets it out.
    #[parameter(unit: "m/s")]
    pub inflow: Option<f64>,
    /// Pressure of waves.
    pub wave: Option<Wave>,
    /// Pressure from a table, such as the series of a scene with a free surface.
    pub recorded: Option<RecordedLoad>,
    /// True if fluid sticks to it.
    #[parameter(default)]
    pub sticks: bool,
}

/// A wall that is a body: M dv/dt = σ A − F. σ = stress + ramp · t + amplitude · sin(2π t / period).
#[parameters]
pub struct Piston {
    /// Stress σ from outside, Pa, positive in compression.
    #[parameter(unit: "Pa")]
    pub stress: f64,
    /// Stress while the grains settle before the run, Pa; the same if left out.
    #[parameter(unit: "Pa")]
    pub prepared: Option<f64>,
    /// Its mass over that of the grains.
    #[parameter(default: 0.05, unit: "1", above: 0.0)]
    pub mass_share: f64,
    /// Growth of the stress, Pa/s.
    #[parameter(default, unit: "Pa/s")]
    pub ramp: f64,
    /// Amplitude of a stress that swings, Pa.
    #[parameter(default, unit: "Pa")]
    pub amplitude: f64,
    /// Its period, s.
    #[parameter(unit: "s", above: 0.0)]
    pub period: Option<f64>,
}

impl Piston {
    /// σ at a time (s), Pa.
    pub(crate) fn stress_at(&self, time: f64) -> f64 {
        let turn = |period: f64| (2.0 * std::f64::consts::PI * time / period).sin();
        let swing = self
            .period
            .map_or(0.0, |period| self.amplitude * turn(period));
        self.stress + self.ramp * time + swing
    }
}

/// A wall that is moved so that it bears a stress.
#[parameters]
pub struct Servo {
    /// Stress, Pa, positive in compression.
    #[parameter(unit: "Pa")]
    pub stress: f64,
    /// Largest speed, m/s.
    #[parameter(unit: "m/s", above: 0.0)]
    pub speed: f64,
}

/// p(x, t) less `less`, linear between places and rows, constant before the first and after the last. The pressure is
/// piezometric: take off that of still water.
#[parameters]
pub struct RecordedLoad {
    /// A table with a column `time` (s) and one of pressures (Pa) for each place: `series.csv` of `sph run`, for example.
    pub file: String,
    /// Axis along which the places are.
    #[parameter(default)]
    pub axis: Axis,
    /// Coordinates of the measured pressures, m.
    #[schemars(extend("minItems" = 1))]
    #[parameter(unit: "m")]
    pub places: Vec<f64>,
    /// The columns of these places.
    pub columns: Vec<String>,
    /// Time of the table at which the run starts, s.
    #[parameter(default, unit: "s")]
    pub start: f64,
    /// Pressure that is subtracted from all pressures, Pa.
    #[parameter(default, unit: "Pa")]
    pub less: f64,
}

//! A scene of grains as plain data; the files below hold its larger tables.

mod grains;
mod probe;

pub use crate::Axis;
pub use crate::coupled::Wave;
pub use crate::grains::Grown;
pub use grains::{Cloud, Grains, Lattice, Rained, Start, Weight};
pub use probe::{Probe, Reference, Statistic};

use std::collections::BTreeMap;

use scene_text::PictureRange;
use sph_core::parameters;

use crate::coupled;

/// Parameter tables by plugin name.
pub type Plugins = BTreeMap<String, toml::Table>;

/// The schema of [`Plugins`], whose keys are those of a plugin.
pub(crate) type AnyPlugins = BTreeMap<String, serde_json::Map<String, serde_json::Value>>;

/// Grains, walls, fluid, times and output of a scene.
#[parameters]
pub struct Scene {
    /// The scene in one line, with its publication.
    pub title: String,
    /// Subject of the scene and its results.
    pub description: Option<String>,
    /// Duration and accuracy of the run.
    pub run: Run,
    /// The grains and the law of their contacts.
    pub grains: Grains,
    /// Positions of the grains at the start, and their preparation.
    pub start: Start,
    /// A box of six walls, `left`, `right`, `front`, `back`, `bottom`, `top`.
    pub r#box: Option<Box>,
    /// Walls by name, `[wall.NAME]`: more about those of the box, further planes, and surfaces of triangles.
    #[parameter(default)]
    pub wall: BTreeMap<String, Wall>,
    /// The fluid in the pores; dry if left out.
    pub fluid: Option<Fluid>,
    /// Makes an oedometer test of it.
    pub oedometer: Option<Oedometer>,
    /// Measurements by name, `[probe.NAME]`; `kind` chooses it, the other keys are its parameters.
    #[parameter(default)]
    pub probe: BTreeMap<String, Probe>,
    /// Comparisons by name, `[reference.NAME]`; their errors are in the summary.
    #[parameter(default)]
    pub reference: BTreeMap<String, Reference>,
    /// Files of a run, and the times of writing.
    #[parameter(default)]
    pub output: Output,
}

/// The walls of a box, in the order of `dem_pfv::grains::Wall::cuboid`.
pub(crate) const BOX: [&str; 6] = ["left", "right", "front", "back", "bottom", "top"];

impl Scene {
    /// True if the box repeats itself along an axis.
    pub(crate) fn periodic(&self, axis: usize) -> bool {
        let mut given = self.r#box.iter().flat_map(|b| &b.periodic);
        given.any(|a| a.number() == axis)
    }

    /// Names of the planes in the order in which the system has them: those of the box, then further ones.
    pub(crate) fn planes(&self) -> Vec<String> {
        let stands = |(k, name): (usize, &&str)| {
            let given = self.r#box.as_ref()?;
            let open = self.periodic(k / 2) || given.open.iter().any(|open| open == *name);
            (!open).then(|| (*name).to_string())
        };
        let boxed = BOX.iter().enumerate().filter_map(stands);
        let further =
            |(name, wall): &(&String, &Wall)| !BOX.contains(&name.as_str()) && wall.file.is_none();
        let more = self.wall.iter().filter(further);
        boxed.chain(more.map(|(name, _)| name.clone())).collect()
    }

    /// Numbers, and tables in the scene, of the planes that have one.
    pub(crate) fn planes_with_tables(&self) -> impl Iterator<Item = (usize, &Wall)> {
        let all = self.planes().into_iter().enumerate();
        all.filter_map(|(number, name)| Some((number, self.wall.get(&name)?)))
    }

    /// Names and tables of the surfaces of triangles.
    pub(crate) fn surfaces(&self) -> impl Iterator<Item = (&String, &Wall)> {
        self.wall.iter().filter(|(_, wall)| wall.file.is_some())
    }
}

/// Duration and accuracy of the run.
#[parameters]
pub struct Run {
    /// Simulated time at which the run ends, s, counted from the end of the preparation.
    #[parameter(unit: "s", above: 0.0)]
    pub end: f64,
    /// Share of the largest stable step.
    #[parameter(default: 0.8, unit: "1", above: 0.0, max: 1.0, quantity: "safety factor")]
    pub safety: f64,
    /// Coefficient of non-viscous damping D_a; leave it at zero where a fluid damps. Catalano 2012, Eq. (2.15).
    #[parameter(default, unit: "1", min: 0.0, below: 1.0)]
    pub damping: f64,
    /// Largest number of steps; no limit if left out.
    #[parameter(min: 1)]
    pub max_steps: Option<u64>,
    /// Simulated time between checkpoints, s; a tenth of `end` if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub checkpoint_every: Option<f64>,
}

/// A sudden load on a piston, and the measures of its answer: the strain under the same load when it comes slowly and
/// dry, and the consolidation coefficient C_v = K Δσ / ε that follows with the mobility K of the packing.
#[parameters]
pub struct Oedometer {
    /// Name of the wall that is the piston; its load is the step from `prepared` to `stress`.
    pub wall: String,
    /// Parts in which the dry load comes, each left to settle.
    #[parameter(default: 40, min: 1, max: 1000)]
    pub parts: u32,
}

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

/// The fluid that fills the pores of the box.
#[parameters]
pub struct Fluid {
    /// Its properties.
    #[serde(flatten)]
    pub given: coupled::Fluid,
    /// Strain of a pore, summed over steps, at which pores are found anew. Catalano 2012, Eq. (5.14).
    #[parameter(default: 0.01, unit: "1", min: 0.0)]
    pub remesh_strain: f64,
    /// Steps after which they are found anew at any strain.
    #[parameter(min: 1)]
    pub remesh_steps: Option<u64>,
    /// The law for the conductance of throats, `[fluid.conductance.LAW]`; hydraulic radii if left out.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub conductance: Plugins,
}

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
        let swing = self.period.map_or(0.0, |t| self.amplitude * turn(t));
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

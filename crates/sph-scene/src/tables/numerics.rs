//! The tables `[run]` and `[numerics]`: how long, how fine, under which forces.

use std::path::PathBuf;

use serde::Serialize;
use sph_core::parameters;

use crate::{Motion, Oscillation};

/// Duration and accuracy of the run.
#[parameters]
pub struct Run {
    /// Simulated time at which the run ends, s.
    #[parameter(unit: "s", above: 0.0)]
    pub end: f64,
    /// Factor on the largest stable time step of the plugins.
    #[parameter(default: 1.0, unit: "1", above: 0.0, max: 1.0, quantity: "safety factor")]
    pub safety: f64,
    /// Number of retries of a failing step with half the time step before the run stops.
    #[parameter(default: 8, min: 0, max: 60)]
    pub retries: u32,
    /// Largest number of steps; no limit if left out.
    #[parameter(min: 1)]
    pub max_steps: Option<u64>,
    /// Simulated time between checkpoints, s; a tenth of `end` if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub checkpoint_every: Option<f64>,
    /// Wall-clock time after which the run stops with a checkpoint, s; no limit if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub max_wall: Option<f64>,
}

impl Run {
    /// Simulated time between checkpoints in force, s.
    pub fn checkpoint_interval(&self) -> f64 {
        self.checkpoint_every.unwrap_or(self.end / 10.0)
    }
}

/// Resolution, forces, periodic directions and bounds.
#[parameters]
pub struct Numerics {
    /// Distance of neighbouring particles at the start, m.
    #[parameter(unit: "m", above: 0.0, quantity: "spacing")]
    pub spacing: f64,
    /// Smoothing length of the kernel over the spacing.
    #[parameter(default: 2.0, unit: "1", above: 0.0, max: 20.0, quantity: "smoothing ratio")]
    pub smoothing_ratio: f64,
    /// Gravity, m/s², one entry per dimension; it is in balance with the pressure of walls. None if left out.
    #[parameter(unit: "m/s²")]
    pub gravity: Option<Vec<f64>>,
    /// Acceleration that is added to `gravity` over time.
    pub gravity_over_time: Option<GravityOverTime>,
    /// Motion of the frame that the scene is drawn in, as that of a wall but without rotation: its acceleration is taken from `gravity`, and walls, levels and velocities count in the frame.
    pub frame: Option<Motion>,
    /// Force per mass that drives a flow, m/s², one entry per dimension; unlike gravity it does not enter the pressure of walls.
    #[parameter(unit: "m/s²")]
    pub driving: Option<Vec<f64>>,
    /// Lower and upper bound of every periodic direction.
    #[parameter(default)]
    pub periodic: Periodic,
    /// ρ₀c₀² of all phases, Pa, which gives each its speed of sound c₀ = √(p_r/ρ₀); or "equal": that of the lightest phase. Phases keep their own speeds if left out (Krimi et al. 2018, Eq. 5 and 6).
    pub reference_pressure: Option<ReferencePressure>,
    /// Skin of the neighbour lists as a fraction of the kernel's support; chosen by the solver if left out.
    #[parameter(unit: "1", min: 0.0, max: 2.0)]
    pub skin: Option<f64>,
    /// Lower and upper corner of the space that particles may be in, m; a particle outside stops the run.
    #[parameter(unit: "m")]
    pub domain: Option<[Vec<f64>; 2]>,
    /// Least and largest density over the reference density; a particle outside fails the step. A particle alone in a splash sums 0.14 of the reference density, one folded into the bulk up to 1.5.
    #[parameter(default: [0.01, 3.0], unit: "1")]
    #[schemars(inner(range(min = 0.0)))]
    pub density_bounds: [f64; 2],
    /// True if more than a tenth of the mass may be faster than its sound; the run ends if not.
    #[parameter(default)]
    pub supersonic: bool,
    /// True if a solve for stresses of the end of the step may bear more than a twentieth of a soil's weight beyond its
    /// strength; the run fails at its end if not.
    #[parameter(default)]
    pub delayed_yield: bool,
    /// Largest random displacement of a particle at the start along each axis, as a fraction of the spacing; if left out 0, and 0.01 in a scene that shifts particles, which a perfect lattice keeps from doing so.
    #[parameter(unit: "1", min: 0.0, below: 0.5)]
    pub jitter: Option<f64>,
    /// Largest random velocity of a particle at the start along each axis, m/s, on top of its own.
    #[parameter(default, unit: "m/s", min: 0.0)]
    pub velocity_noise: f64,
    /// Seed of the random displacement and velocity.
    #[parameter(default: 1, min: 0)]
    pub seed: u64,
    /// Settling of the particles before the start. If left out 400 steps to 0.001 where water starts at rest under its
    /// weight beside walls, else none.
    pub relax: Option<Relax>,
}

/// The pressure ρ₀c₀² that all phases have in common: they are equally compressible, and ρ/ρ₀ has
/// no jump where the pressure has none.
#[parameters]
#[derive(Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ReferencePressure {
    /// Its value, Pa.
    Value(#[parameter(unit: "Pa", above: 0.0)] f64),
    /// That of one of the phases.
    Of(PressureOf),
}

/// Phase whose reference pressure all phases have.
#[parameters]
pub enum PressureOf {
    /// That of the phase with the least density.
    Equal,
}

/// Settling of the first particles until their density is even.
#[parameters]
#[derive(PartialEq, Serialize)]
pub struct Relax {
    /// Largest number of steps; 0 for none.
    #[parameter(default: 200, min: 0, max: 1_000_000)]
    pub steps: u32,
    /// Largest error of the density, relative to the reference density, at which it ends.
    #[parameter(default: 0.01, unit: "1", above: 0.0, below: 1.0)]
    pub tolerance: f64,
}

/// Lower and upper bound of every periodic direction, m.
#[parameters]
#[derive(Serialize)]
pub struct Periodic {
    /// Lower and upper bound along x, m.
    #[parameter(unit: "m")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<[f64; 2]>,
    /// Lower and upper bound along y, m.
    #[parameter(unit: "m")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<[f64; 2]>,
    /// Lower and upper bound along z, m.
    #[parameter(unit: "m")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<[f64; 2]>,
}

impl Periodic {
    /// Name and bounds of all three axes.
    pub fn axes(&self) -> [(&'static str, Option<[f64; 2]>); 3] {
        [("x", self.x), ("y", self.y), ("z", self.z)]
    }

    /// Bounds per axis of D dimensions, m.
    pub fn bounds<const D: usize>(&self) -> [Option<[f64; 2]>; D] {
        let all = self.axes();
        std::array::from_fn(|k| all.get(k).and_then(|a| a.1))
    }
}

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
    /// Its times.
    #[serde(flatten)]
    pub oscillation: Oscillation,
}

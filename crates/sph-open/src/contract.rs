//! The trait of laws of open faces.

use std::collections::BTreeMap;

use sph_boundary::MoverRefusal;
use sph_core::{Vect, contract};

/// An element of an open face.
#[derive(Clone, Copy, Debug)]
pub struct FaceElement<const D: usize> {
    /// Centre, m.
    pub centre: Vect<D>,
    /// Unit normal into the fluid.
    pub normal: Vect<D>,
    /// Length or area, m^(d−1).
    pub measure: f64,
    /// Coordinate of its centre along the face, 0 to 1: in two dimensions from the first corner of the drawing, in
    /// three along the first axis in a [rectangle](Self::rectangle).
    pub along: f64,
    /// The same along the second axis in a rectangle; ½ elsewhere.
    pub across: f64,
    /// Sides of the face along these axes, m, where it is a plane rectangle in three dimensions whose sides go along axes of
    /// space (but for a tilt).
    pub rectangle: Option<[f64; 2]>,
}

/// The fluid in front of an element, as a mean over its support.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluidMean<const D: usize> {
    /// True if there is enough fluid for a mean.
    pub wet: bool,
    /// Pressure at the element, over that of the reference density, Pa.
    pub pressure: f64,
    /// Share of the element that has fluid before it.
    pub filled: f64,
    /// Velocity, m/s; of the little fluid there is, where it is not wet.
    pub velocity: Vect<D>,
    /// ρc, kg/(m² s).
    pub impedance: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Running mean of the velocity over the [memory](OpenBoundary::memory), m/s.
    pub mean: Vect<D>,
    /// That of the pressure, Pa.
    pub mean_pressure: f64,
}

impl<const D: usize> FluidMean<D> {
    pub(crate) fn nothing() -> Self {
        FluidMean {
            wet: false,
            pressure: 0.0,
            filled: 0.0,
            velocity: Vect::zeros(),
            impedance: 1.0,
            density: 0.0,
            mean: Vect::zeros(),
            mean_pressure: 0.0,
        }
    }
}

/// Values of the face for the fluid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceValues<const D: usize> {
    /// Velocity with which fluid passes, m/s.
    pub velocity: Vect<D>,
    /// Pressure, over that of the reference density, Pa; of no account where the velocity is imposed.
    pub pressure: f64,
    /// True if the velocity is imposed, and the pressure follows from the characteristic that leaves the fluid:
    /// p = p_i + ρc (u − u_i), with the mean of u over the support for u. If not, fluid passes with its own velocity,
    /// changed by the difference of `velocity` from that inside.
    pub imposed: bool,
    /// Share of the element through which fluid comes in; the share with fluid before it if left out. Outflow
    /// passes at most the part with fluid before it, unless the share is 1.
    pub share: Option<f64>,
}

impl<const D: usize> FaceValues<D> {
    /// Values where there is no fluid: nothing passes.
    pub fn dry() -> Self {
        FaceValues {
            velocity: Vect::zeros(),
            pressure: 0.0,
            imposed: true,
            share: Some(1.0),
        }
    }
}

/// The scene for a law before the start.
#[derive(Clone, Copy, Debug)]
pub struct OpenSetting<'a> {
    /// Names of the phases, in the order of their numbers.
    pub phases: &'a [String],
    /// The least speed of sound of all phases, m/s.
    pub sound_speed: f64,
    /// End of the run, s.
    pub end: f64,
    /// Gravity, m/s²; its size.
    pub gravity: f64,
    /// Dimension of space.
    pub dimension: usize,
}

/// The conditions of a moment before a face.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a, const D: usize> {
    /// Elements of the face.
    pub places: &'a [FaceElement<D>],
    /// The fluid in front of each.
    pub inside: &'a [FluidMean<D>],
    /// Time, s.
    pub time: f64,
    /// Gravity, m/s².
    pub gravity: Vect<D>,
}

impl<const D: usize> Moment<'_, D> {
    /// Values of every element, in their order.
    pub fn each(
        &self,
        values: impl Fn(&FaceElement<D>, &FluidMean<D>) -> FaceValues<D>,
    ) -> Vec<FaceValues<D>> {
        let all = self.places.iter().zip(self.inside);
        all.map(|(place, inside)| values(place, inside)).collect()
    }

    /// Height of a place against gravity, m.
    pub fn height(&self, place: &Vect<D>) -> f64 {
        match self.gravity.norm() {
            g if g > 0.0 => -self.gravity.dot(place) / g,
            _ => 0.0,
        }
    }
}

/// A key of a law's table, and its fault: of the same form as that of a mover.
pub type OpenRefusal = MoverRefusal;

pub(crate) fn refuse<T>(key: &str, why: impl Into<String>) -> Result<T, OpenRefusal> {
    Err(OpenRefusal::at_key(key, why))
}

/// The fluid that comes in.
#[derive(Clone, Debug, Default)]
pub struct Entering {
    /// Name of the phase; that of the fluid in front of the face if none is given.
    pub phase: Option<String>,
    /// Values of columns with which particles begin, by the names of the columns.
    pub values: BTreeMap<String, f64>,
}

impl Entering {
    /// Particles of a phase that begin with the values of the fluid in front of the face.
    pub fn in_phase(phase: &Option<String>) -> Self {
        Entering {
            phase: phase.clone(),
            ..Entering::default()
        }
    }
}

/// The law of an open face. It has no memory: the past of the flow is in [`FluidMean::mean`].
pub trait OpenBoundary<const D: usize>: Send + Sync + std::fmt::Debug {
    /// Checks its table against the scene.
    ///
    /// # Errors
    /// The key that does not fit.
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal>;
    /// Checks it against the elements of its face, which are not known before the walls are built.
    ///
    /// # Errors
    /// The key that does not fit.
    fn fit(&self, _places: &[FaceElement<D>]) -> Result<(), OpenRefusal> {
        Ok(())
    }
    /// The fluid that comes in.
    fn entering(&self) -> Entering {
        Entering::default()
    }
    /// True if fluid can leave by it where more comes in elsewhere.
    fn lets_out(&self) -> bool {
        true
    }
    /// True if rows that pass are kept even by slow pressures, as those that stay are. This makes a barrier of some per
    /// cent of the pressure for a current, and lets waves of the surface pass that are thrown back otherwise.
    fn keeps_rows_even(&self) -> bool {
        false
    }
    /// Volume into the fluid per time that it requests at the reference density, m³/s, for any fluid in front of the
    /// face; none where the velocity follows. The velocities of such a law are those at the reference density, too.
    fn asked(&self, _places: &[FaceElement<D>], _time: f64) -> Option<f64> {
        None
    }
    /// Time of the [means](FluidMean::mean) of velocity and pressure, s, if it does.
    fn memory(&self) -> Option<f64> {
        None
    }
    /// Velocity and pressure of every element, in their order.
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>>;
}

contract!(
    /// The law of an open face that a wall may name.
    pub OpenBoundaryEntry, "open-boundary", InWall, "the condition at a wall that fluid passes", OpenBoundary<D>,
    .advises("outflow")
);

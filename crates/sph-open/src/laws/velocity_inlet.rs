//! A velocity, or a flow rate, that is imposed.

use std::collections::BTreeMap;

use sph_core::plugin;

use crate::laws::imposed_velocity;
use crate::profile::{FactorTable, check_course, factor, turns_negative};
use crate::{
    Entering, FaceElement, FaceValues, Moment, OpenBoundary, OpenBoundaryEntry, OpenRefusal,
    OpenSetting, Profile,
};

/// Fluid passes with a given velocity along the normal of the face, for any fluid in front of it.
///
/// The pressure follows from the characteristic that leaves the fluid, p = p_i + ρc (u − u_i): sound that arrives is
/// thrown back as from a wall that moves so. A negative velocity takes fluid out, as far as there is fluid before the
/// face: where it draws air it does not suck.
///
/// Source: Ferrand et al. 2017, linearised.
///
/// ```toml
/// [wall.inlet.open-boundary.velocity-inlet]
/// velocity = "1 m/s"
/// profile = "parabola"
/// ```
#[plugin(OpenBoundaryEntry [2, 3], "velocity-inlet", "fluid passes with a given velocity",
    source: "Ferrand et al. 2017; Leroy 2014", cfg(not(test)))]
pub struct VelocityInlet {
    /// Velocity into the fluid, m/s; a `profile` and `over_time` are factors of it.
    #[parameter(unit: "m/s")]
    pub velocity: f64,
    /// Distribution of the velocity along the face.
    #[parameter(default)]
    pub profile: Profile,
    /// Times, s, and factors of the velocity, straight between them; it must cover the run.
    #[parameter(default)]
    pub over_time: FactorTable,
    /// Name of the phase that comes in; that of the fluid in front of the face if left out.
    #[parameter(default)]
    pub phase: Option<String>,
    /// Values with which columns of particles begin that come in, by their names, in SI units: `turbulent_energy = 0.01`.
    #[parameter(default)]
    pub values: BTreeMap<String, f64>,
}

impl<const D: usize> OpenBoundary<D> for VelocityInlet {
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        setting.check_phase(&self.phase)?;
        self.profile.check(setting)?;
        check_course(&self.over_time, setting)?;
        let times = self.over_time.iter().flatten().map(|[_, f]| f.abs());
        let largest = times.reduce(f64::max).unwrap_or(1.0) * self.profile.largest();
        setting.check_speed("velocity", self.velocity * largest)
    }
    fn fit(&self, places: &[FaceElement<D>]) -> Result<(), OpenRefusal> {
        self.profile.fit(places)
    }
    fn entering(&self) -> Entering {
        Entering {
            phase: self.phase.clone(),
            values: self.values.clone(),
        }
    }
    fn lets_out(&self) -> bool {
        turns_negative(&self.over_time, self.velocity)
    }
    fn asked(&self, places: &[FaceElement<D>], time: f64) -> Option<f64> {
        let now = self.velocity * factor(&self.over_time, time);
        let one = |place: &FaceElement<D>| self.profile.at(place) * place.measure;
        Some(now * places.iter().map(one).sum::<f64>())
    }
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>> {
        let now = self.velocity * factor(&self.over_time, moment.time);
        moment.each(|place, _| imposed_velocity(place, now * self.profile.at(place)))
    }
}

/// A volume per time passes through the part of the face that has fluid in front of it, at any level.
///
/// Velocities are those of a [`VelocityInlet`], scaled so that they have the rate.
///
/// ```toml
/// [wall.inlet.open-boundary.flow-rate]
/// rate = 0.05                      # m³/s, here m²/s
/// ```
#[plugin(OpenBoundaryEntry [2, 3], "flow-rate", "a volume per time passes", source: "Ferrand et al. 2017", cfg(not(test)))]
pub struct FlowRate {
    /// Volume into the fluid per time: m³/s, in two dimensions m²/s.
    pub rate: f64,
    /// Distribution of the velocity along the face.
    #[parameter(default)]
    pub profile: Profile,
    /// Times, s, and factors of the rate, straight between them; it must cover the run.
    #[parameter(default)]
    pub over_time: FactorTable,
    /// Name of the phase that comes in; that of the fluid in front of the face if left out.
    #[parameter(default)]
    pub phase: Option<String>,
    /// Values with which columns of particles begin that come in, by their names, in SI units.
    #[parameter(default)]
    pub values: BTreeMap<String, f64>,
}

impl<const D: usize> OpenBoundary<D> for FlowRate {
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        setting.check_phase(&self.phase)?;
        self.profile.check(setting)?;
        check_course(&self.over_time, setting)?;
        setting.check_speed("rate", 0.0)
    }
    fn fit(&self, places: &[FaceElement<D>]) -> Result<(), OpenRefusal> {
        self.profile.fit(places)
    }
    fn entering(&self) -> Entering {
        Entering {
            phase: self.phase.clone(),
            values: self.values.clone(),
        }
    }
    fn lets_out(&self) -> bool {
        turns_negative(&self.over_time, self.rate)
    }
    fn asked(&self, _: &[FaceElement<D>], time: f64) -> Option<f64> {
        Some(self.rate * factor(&self.over_time, time))
    }
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>> {
        let now = self.rate * factor(&self.over_time, moment.time);
        let places = moment.places;
        let weight = |place: &FaceElement<D>| self.profile.at(place) * place.measure;
        let wetted = places.iter().zip(moment.inside).filter(|(_, i)| i.wet);
        let wet: f64 = wetted.map(|(p, i)| weight(p) * i.filled).sum();
        // Through less than an element there would be a jet.
        let wet = wet.max(places.iter().map(weight).sum::<f64>() / places.len() as f64);
        moment.each(|place, inside| match inside.wet && wet > 0.0 {
            true => FaceValues {
                share: Some(inside.filled),
                ..imposed_velocity(place, now / wet * self.profile.at(place))
            },
            false => FaceValues::dry(),
        })
    }
}

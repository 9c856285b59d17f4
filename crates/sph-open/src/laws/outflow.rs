//! A characteristic that comes from far away.

use schemars::JsonSchema;
use serde::Deserialize;
use sph_core::register;

use crate::laws::{check_speed, passing};
use crate::{
    Inside, Moment, OpenBoundary, OpenBoundaryEntry, OpenRefusal, OpenSetting, Outside, Place,
};

/// Fluid leaves, and sound with it: what comes back from outside is p + ρc u of a state far away.
///
/// With u inwards, p_i − ρc u_i arrives from the fluid and p₀ + ρc u₀ from outside, so that
/// p = ½ [p_i + p₀ + ρc (u₀ − u_i)] and u = ½ [u_i + u₀ + (p₀ − p_i)/ρc]. u₀ is the `velocity`, or the mean of u_i over
/// the `memory`: what changes faster leaves, what changes more slowly feels the pressure p₀.
///
/// Source: Ferrand et al. 2017 (Riemann invariants), linearised; the running mean is ours.
///
/// ```toml
/// [wall.outlet.open-boundary.outflow]
/// pressure = "0 Pa"
/// memory = "0.1 s"
/// ```
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Outflow {
    /// Pressure p₀ far away, over that of the reference density, Pa.
    #[serde(default)]
    #[schemars(extend("unit" = "Pa"))]
    pub pressure: f64,
    /// Velocity −u₀ out of the fluid far away, m/s; a running mean if left out.
    #[serde(default)]
    #[schemars(extend("unit" = "m/s"))]
    pub velocity: Option<f64>,
    /// Time of the running mean, s.
    #[serde(default)]
    #[schemars(extend("unit" = "s", "exclusiveMinimum" = 0.0))]
    pub memory: Option<f64>,
    /// Height of a level up to which p₀ grows with the depth below it, m; p₀ everywhere if left out.
    #[serde(default)]
    #[schemars(extend("unit" = "m"))]
    pub level: Option<f64>,
}

impl<const D: usize> OpenBoundary<D> for Outflow {
    fn settle(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        match (self.velocity, self.memory) {
            (None, None) => Err(OpenRefusal::of(
                "",
                "it needs the `velocity` far away, or the `memory` over which the fluid's own is averaged",
            )),
            (Some(_), Some(_)) => Err(OpenRefusal::of(
                "memory",
                "the velocity far away is given, and nothing is averaged: take one of the two out",
            )),
            (velocity, _) => check_speed("velocity", velocity.unwrap_or(0.0), setting),
        }
    }
    fn lets_out(&self) -> bool {
        true
    }
    fn memory(&self) -> Option<f64> {
        self.memory
    }
    fn outside(
        &self,
        places: &[Place<D>],
        inside: &[Inside<D>],
        moment: &Moment<D>,
    ) -> Vec<Outside<D>> {
        let g = moment.gravity.norm();
        let one = |(place, inside): (&Place<D>, &Inside<D>)| {
            if !inside.wet {
                return Outside::dry();
            }
            let z = inside.impedance;
            let depth = |level: f64| (level - moment.height(&place.centre)).max(0.0);
            let far = self.pressure + self.level.map_or(0.0, |l| inside.density * g * depth(l));
            let within = inside.velocity.dot(&place.normal);
            let beyond = match self.velocity {
                Some(out) => -out,
                None => inside.mean.dot(&place.normal),
            };
            let normal = 0.5 * (within + beyond + (far - inside.pressure) / z);
            Outside {
                velocity: passing(place, inside, normal),
                pressure: 0.5 * (inside.pressure + far + z * (beyond - within)),
                imposed: false,
            }
        };
        places.iter().zip(inside).map(one).collect()
    }
}

register!(
    OpenBoundaryEntry [2, 3],
    Outflow,
    "outflow",
    "fluid and sound leave",
    "Ferrand et al. 2017"
);

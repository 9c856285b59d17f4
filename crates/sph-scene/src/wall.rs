//! The table `[wall.NAME]`: geometry, condition and motion of a wall.

use schemars::JsonSchema;
use serde::Deserialize;

/// A solid wall with a name.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// Corners of the wall in order, m; the fluid is on the left of travel.
    #[schemars(length(min = 2), extend("unit" = "m"))]
    pub polyline: Vec<Vec<f64>>,
    /// Whether the last corner is joined to the first.
    #[serde(default)]
    pub closed: bool,
    /// Thickness of a plate, m, half of it on either side of the polyline; a plate has two faces and wets on both.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub thickness: Option<f64>,
    /// Whether the fluid sticks to the wall.
    #[serde(default)]
    pub condition: Condition,
    /// Velocity of the wall's surface, m/s, while its geometry stays: a belt.
    #[schemars(extend("unit" = "m/s"))]
    pub velocity: Option<Vec<f64>>,
    /// Rigid motion of the geometry.
    pub motion: Option<Motion>,
}

/// What a wall does to the velocity along it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Condition {
    /// The fluid moves with the wall.
    #[default]
    NoSlip,
    /// The fluid slides along the wall without friction.
    FreeSlip,
}

/// Rigid motion of a wall: a translation and a rotation about a centre that moves along.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Velocity of the translation, m/s; none if left out.
    #[schemars(extend("unit" = "m/s"))]
    pub velocity: Option<Vec<f64>>,
    /// Angular velocity, rad/s, anticlockwise.
    #[serde(default)]
    #[schemars(extend("unit" = "rad/s"))]
    pub angular_velocity: f64,
    /// Centre of the rotation at the start, m; needed where there is a rotation.
    #[schemars(extend("unit" = "m"))]
    pub centre: Option<Vec<f64>>,
    /// Time at which the motion starts, s.
    #[serde(default)]
    #[schemars(extend("unit" = "s", "minimum" = 0.0))]
    pub start: f64,
    /// Time at which the motion stops, s; never if left out.
    #[schemars(extend("unit" = "s", "minimum" = 0.0))]
    pub stop: Option<f64>,
}

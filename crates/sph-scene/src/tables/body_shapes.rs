//! The tables that give a shape of a body: `disc`, `ellipse`, `sphere`, `cylinder`, `cone`, `extrusion`.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::tables::wall_shapes::Axis;

/// A disc or a sphere.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// Centre, m.
    #[schemars(extend("unit" = "m"))]
    pub centre: Vec<f64>,
    /// Radius, m.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub radius: f64,
}

/// An ellipse with its axes along x and y.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ellipse {
    /// Centre, m.
    #[schemars(extend("unit" = "m"))]
    pub centre: Vec<f64>,
    /// Semi-axes along x and along y, m.
    #[schemars(inner(range(min = 0.0)), extend("unit" = "m"))]
    pub semi_axes: [f64; 2],
}

/// A cylinder.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Centre of one end, m.
    #[schemars(extend("unit" = "m"))]
    pub from: Vec<f64>,
    /// Centre of the other end, m.
    #[schemars(extend("unit" = "m"))]
    pub to: Vec<f64>,
    /// Radius, m.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub radius: f64,
}

/// A cone.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cone {
    /// Centre of the base, m.
    #[schemars(extend("unit" = "m"))]
    pub base: Vec<f64>,
    /// Tip, m.
    #[schemars(extend("unit" = "m"))]
    pub apex: Vec<f64>,
    /// Radius of the base, m.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub radius: f64,
}

/// A polygon drawn out along an axis.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Extrusion {
    /// Corners of the polygon in order, m, as the two coordinates across the axis: (y, z), (x, z) or (x, y).
    #[schemars(length(min = 3), extend("unit" = "m"))]
    pub polygon: Vec<Vec<f64>>,
    /// Axis along which it is drawn out.
    pub axis: Axis,
    /// Coordinate of one end along the axis, m.
    #[schemars(extend("unit" = "m"))]
    pub from: f64,
    /// Coordinate of the other end along the axis, m.
    #[schemars(extend("unit" = "m"))]
    pub to: f64,
}

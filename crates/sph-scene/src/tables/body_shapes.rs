//! The tables that give a shape of a body: `disc`, `ellipse`, `sphere`, `cylinder`, `cone`, `extrusion`.

use sph_core::{Axis, parameters};

/// A disc or a sphere.
#[parameters]
pub struct Round {
    /// Centre, m.
    #[parameter(unit: "m")]
    pub centre: Vec<f64>,
    /// Radius of the circle or sphere, m; that of a wall goes through its corners.
    #[parameter(unit: "m", above: 0.0)]
    pub radius: f64,
}

/// An ellipse with its axes along x and y.
#[parameters]
pub struct Ellipse {
    /// Centre, m.
    #[parameter(unit: "m")]
    pub centre: Vec<f64>,
    /// Semi-axes along x and along y, m.
    #[schemars(inner(range(min = 0.0)))]
    #[parameter(unit: "m")]
    pub semi_axes: [f64; 2],
}

/// A cylinder.
#[parameters]
pub struct Cylinder {
    /// Centre of one end, m.
    #[parameter(unit: "m")]
    pub from: Vec<f64>,
    /// Centre of the other end, m.
    #[parameter(unit: "m")]
    pub to: Vec<f64>,
    /// Radius of the circle, m; that of a wall goes through its corners.
    #[parameter(unit: "m", above: 0.0)]
    pub radius: f64,
}

/// A cone.
#[parameters]
pub struct Cone {
    /// Centre of the base, m.
    #[parameter(unit: "m")]
    pub base: Vec<f64>,
    /// Tip, m.
    #[parameter(unit: "m")]
    pub apex: Vec<f64>,
    /// Radius of the circle of the base, m; that of a wall goes through its corners.
    #[parameter(unit: "m", above: 0.0)]
    pub radius: f64,
}

/// A polygon drawn out along an axis.
#[parameters]
pub struct Extrusion {
    /// Corners of the polygon in order, m, as the two coordinates across the axis: (y, z), (x, z) or (x, y).
    #[parameter(unit: "m", min_items: 3)]
    pub polygon: Vec<Vec<f64>>,
    /// Axis along which it is drawn out.
    pub axis: Axis,
    /// Coordinate of one end along the axis, m.
    #[parameter(unit: "m")]
    pub from: f64,
    /// Coordinate of the other end along the axis, m.
    #[parameter(unit: "m")]
    pub to: f64,
}

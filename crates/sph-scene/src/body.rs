//! The table `[body.NAME]`: where a phase is at the start.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::Shape;
use crate::plugins::{AnyPlugins, Plugins};
use crate::polygon::Polygon;
use crate::vector::array;
use crate::wall_shapes::Axis;

/// A piece of a phase at the start: one shape, or what the walls enclose, less what is subtracted.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Name of the phase it is made of.
    pub phase: String,
    /// Lower and upper corner of a box, m.
    #[serde(rename = "box")]
    #[schemars(extend("unit" = "m"))]
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Corners of a polygon in order, m; it closes itself. Two dimensions only.
    #[schemars(length(min = 3), extend("unit" = "m"))]
    pub polygon: Option<Vec<Vec<f64>>>,
    /// Disc by centre and radius. Two dimensions only.
    pub disc: Option<Round>,
    /// Sphere by centre and radius. Three dimensions only.
    pub sphere: Option<Round>,
    /// Cylinder between two points. Three dimensions only.
    pub cylinder: Option<Cylinder>,
    /// Cone by base and apex. Three dimensions only.
    pub cone: Option<Cone>,
    /// Polygon drawn out along an axis. Three dimensions only.
    pub extrusion: Option<Extrusion>,
    /// Fills what the walls enclose, instead of a shape; a `box` bounds it.
    pub fill: Option<Filling>,
    /// Point, m, in that one of several regions between the walls which `fill` fills; all of them if left out.
    #[schemars(extend("unit" = "m"))]
    pub seed: Option<Vec<f64>>,
    /// Whether only what is on the fluid's side of all walls is filled.
    #[serde(default)]
    pub clip: bool,
    /// Shapes that are cut out.
    #[serde(default)]
    pub subtract: Vec<Cutout>,
    /// Velocity at the start, m/s; at rest if left out.
    #[schemars(extend("unit" = "m/s"))]
    pub velocity: Option<Vec<f64>>,
    /// Field that gives the velocity at the start, `[body.NAME.initial.PLUGIN]`.
    #[serde(default)]
    #[schemars(with = "AnyPlugins", extend("maxProperties" = 1))]
    pub initial: Plugins,
    /// Pressure at the start.
    #[serde(default)]
    pub pressure: Pressure,
    /// Level of the free surface against gravity, m, for a hydrostatic pressure; the top of the body if left out.
    #[schemars(extend("unit" = "m"))]
    pub surface: Option<f64>,
}

/// A shape that is cut out of a body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cutout {
    /// Lower and upper corner of a box, m.
    #[serde(rename = "box")]
    #[schemars(extend("unit" = "m"))]
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Corners of a polygon in order, m; it closes itself. Two dimensions only.
    #[schemars(length(min = 3), extend("unit" = "m"))]
    pub polygon: Option<Vec<Vec<f64>>>,
    /// Disc by centre and radius. Two dimensions only.
    pub disc: Option<Round>,
    /// Sphere by centre and radius. Three dimensions only.
    pub sphere: Option<Round>,
    /// Cylinder between two points. Three dimensions only.
    pub cylinder: Option<Cylinder>,
    /// Cone by base and apex. Three dimensions only.
    pub cone: Option<Cone>,
    /// Polygon drawn out along an axis. Three dimensions only.
    pub extrusion: Option<Extrusion>,
}

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

/// What a body without a shape fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Filling {
    /// Every place that the walls enclose.
    Walls,
}

/// Pressure of a body at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Pressure {
    /// No pressure.
    #[default]
    Zero,
    /// Weight of the fluid between the particle and the free surface.
    Hydrostatic,
}

/// The keys that may give a shape, wherever they stand.
#[derive(Clone, Copy)]
pub(crate) struct ShapeKeys<'a> {
    pub bounds: Option<&'a [Vec<f64>; 2]>,
    pub polygon: Option<&'a [Vec<f64>]>,
    pub disc: Option<&'a Round>,
    pub sphere: Option<&'a Round>,
    pub cylinder: Option<&'a Cylinder>,
    pub cone: Option<&'a Cone>,
    pub extrusion: Option<&'a Extrusion>,
}

impl ShapeKeys<'_> {
    /// The keys that are given.
    pub fn given(&self) -> Vec<&'static str> {
        let all = [
            ("box", self.bounds.is_some()),
            ("polygon", self.polygon.is_some()),
            ("disc", self.disc.is_some()),
            ("sphere", self.sphere.is_some()),
            ("cylinder", self.cylinder.is_some()),
            ("cone", self.cone.is_some()),
            ("extrusion", self.extrusion.is_some()),
        ];
        all.iter()
            .filter(|(_, given)| *given)
            .map(|(name, _)| *name)
            .collect()
    }

    /// The shape in D dimensions, if one is given.
    pub fn shape<const D: usize>(&self) -> Option<Shape<D>> {
        let polygon = |points: &[Vec<f64>]| Polygon::new(points.iter().map(|p| array(p)).collect());
        if let Some([lo, hi]) = self.bounds {
            return Some(Shape::Cuboid {
                lo: array(lo),
                hi: array(hi),
            });
        }
        if let Some(points) = self.polygon {
            return Some(Shape::Polygon(polygon(points)));
        }
        if let Some(c) = self.cylinder {
            return Some(Shape::Cylinder {
                from: array(&c.from),
                to: array(&c.to),
                radius: c.radius,
            });
        }
        if let Some(c) = self.cone {
            return Some(Shape::Cone {
                base: array(&c.base),
                apex: array(&c.apex),
                radius: c.radius,
            });
        }
        if let Some(e) = self.extrusion {
            return Some(Shape::Extrusion {
                polygon: polygon(&e.polygon),
                axis: e.axis as usize,
                ends: [e.from.min(e.to), e.from.max(e.to)],
            });
        }
        self.disc.or(self.sphere).map(|r| Shape::Ball {
            centre: array(&r.centre),
            radius: r.radius,
        })
    }
}

/// Tables that give a shape by the same keys.
macro_rules! with_shape {
    ($table:ident) => {
        impl $table {
            pub(crate) fn keys(&self) -> ShapeKeys<'_> {
                ShapeKeys {
                    bounds: self.bounds.as_ref(),
                    polygon: self.polygon.as_deref(),
                    disc: self.disc.as_ref(),
                    sphere: self.sphere.as_ref(),
                    cylinder: self.cylinder.as_ref(),
                    cone: self.cone.as_ref(),
                    extrusion: self.extrusion.as_ref(),
                }
            }
        }
    };
}
with_shape!(Body);
with_shape!(Cutout);

impl Body {
    /// Whether walls decide what is filled: `clip` or `fill`.
    pub fn needs_walls(&self) -> bool {
        self.clip || self.fill.is_some()
    }
}

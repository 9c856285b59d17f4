//! The table `[body.NAME]`: where a phase is at the start.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::Shape;
use crate::plugins::{AnyPlugins, Plugins};
use crate::polygon::Polygon;
use crate::vector::array;

/// A piece of a phase at the start: one shape, less what is subtracted.
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

/// The four keys that may give a shape, wherever they stand.
#[derive(Clone, Copy)]
pub(crate) struct ShapeKeys<'a> {
    pub bounds: Option<&'a [Vec<f64>; 2]>,
    pub polygon: Option<&'a [Vec<f64>]>,
    pub disc: Option<&'a Round>,
    pub sphere: Option<&'a Round>,
}

impl ShapeKeys<'_> {
    /// The keys that are given.
    pub fn given(&self) -> Vec<&'static str> {
        let all = [
            ("box", self.bounds.is_some()),
            ("polygon", self.polygon.is_some()),
            ("disc", self.disc.is_some()),
            ("sphere", self.sphere.is_some()),
        ];
        all.iter()
            .filter(|(_, given)| *given)
            .map(|(name, _)| *name)
            .collect()
    }

    /// The shape in D dimensions, if one is given.
    pub fn shape<const D: usize>(&self) -> Option<Shape<D>> {
        if let Some([lo, hi]) = self.bounds {
            return Some(Shape::Cuboid {
                lo: array(lo),
                hi: array(hi),
            });
        }
        if let Some(points) = self.polygon {
            return Some(Shape::Polygon(Polygon::new(
                points.iter().map(|p| array(p)).collect(),
            )));
        }
        self.disc.or(self.sphere).map(|r| Shape::Ball {
            centre: array(&r.centre),
            radius: r.radius,
        })
    }
}

impl Body {
    pub(crate) fn keys(&self) -> ShapeKeys<'_> {
        ShapeKeys {
            bounds: self.bounds.as_ref(),
            polygon: self.polygon.as_deref(),
            disc: self.disc.as_ref(),
            sphere: self.sphere.as_ref(),
        }
    }
}

impl Cutout {
    pub(crate) fn keys(&self) -> ShapeKeys<'_> {
        ShapeKeys {
            bounds: self.bounds.as_ref(),
            polygon: self.polygon.as_deref(),
            disc: self.disc.as_ref(),
            sphere: self.sphere.as_ref(),
        }
    }
}

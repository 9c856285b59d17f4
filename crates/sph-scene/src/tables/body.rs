//! The table `[body.NAME]`: where a phase is at the start.

use scene_text::given;
use sph_core::{Axis, parameters};

use crate::geometry::polygon::Polygon;
use crate::geometry::vector::array;
use crate::reading::plugins::{AnyPlugins, Plugins};
use crate::tables::body_shapes::{Cone, Cylinder, Ellipse, Extrusion, Round};
use crate::{LevelSurface, Shape, Wall, Wave};

/// A piece of a phase at the start: one shape, or what the walls enclose, less what is subtracted.
#[parameters]
pub struct Body {
    /// Name of the phase it is made of.
    pub phase: String,
    /// Lower and upper corner of a box, m.
    #[serde(rename = "box")]
    #[parameter(unit: "m")]
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Corners of a polygon in order, m; it closes itself. Two dimensions only.
    #[parameter(unit: "m", min_items: 3)]
    pub polygon: Option<Vec<Vec<f64>>>,
    /// Disc by centre and radius. Two dimensions only.
    pub disc: Option<Round>,
    /// Ellipse by centre and semi-axes along x and y. Two dimensions only.
    pub ellipse: Option<Ellipse>,
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
    #[parameter(unit: "m")]
    pub seed: Option<Vec<f64>>,
    /// Whether only what is on the fluid's side of all walls is filled.
    #[parameter(default)]
    pub clip: bool,
    /// Shapes that are cut out.
    #[parameter(default)]
    pub subtract: Vec<Cutout>,
    /// Only what is above this surface is filled: bodies of one `box` with the same surface in `below` and `above` share a lattice.
    pub above: Option<LevelSurface>,
    /// Only what is below this surface is filled.
    pub below: Option<LevelSurface>,
    /// Wave that is on it at the start: what is above its surface is not filled.
    pub wave: Option<Wave>,
    /// Velocity at the start, m/s; at rest if left out.
    #[parameter(unit: "m/s")]
    pub velocity: Option<Vec<f64>>,
    /// Field that gives the velocity at the start, `[body.NAME.initial.PLUGIN]`.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins", extend("maxProperties" = 1))]
    pub initial: Plugins,
    /// Pressure at the start.
    #[parameter(default)]
    pub pressure: Pressure,
    /// Level of the free surface against gravity, m, for a hydrostatic pressure. If left out, the top of the only body, or the weight of what stands over a place in all bodies.
    #[parameter(unit: "m")]
    pub surface: Option<f64>,
}

/// A shape that is cut out of a body.
#[parameters]
pub struct Cutout {
    /// Lower and upper corner of a box, m.
    #[serde(rename = "box")]
    #[parameter(unit: "m")]
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Corners of a polygon in order, m; it closes itself. Two dimensions only.
    #[parameter(unit: "m", min_items: 3)]
    pub polygon: Option<Vec<Vec<f64>>>,
    /// Disc by centre and radius. Two dimensions only.
    pub disc: Option<Round>,
    /// Ellipse by centre and semi-axes along x and y. Two dimensions only.
    pub ellipse: Option<Ellipse>,
    /// Sphere by centre and radius. Three dimensions only.
    pub sphere: Option<Round>,
    /// Cylinder between two points. Three dimensions only.
    pub cylinder: Option<Cylinder>,
    /// Cone by base and apex. Three dimensions only.
    pub cone: Option<Cone>,
    /// Polygon drawn out along an axis. Three dimensions only.
    pub extrusion: Option<Extrusion>,
}

/// What a body without a shape fills.
#[parameters]
pub enum Filling {
    /// Every place that the walls enclose.
    Walls,
}

/// Pressure of a body at the start.
#[parameters]
pub enum Pressure {
    /// No pressure: the particles start at the reference density.
    #[default]
    Zero,
    /// Weight of the fluid between the particle and the free surface; of several bodies, of all that is over it.
    Hydrostatic,
}

/// A polygon, the axis along which it is drawn out, and both ends.
pub(crate) type DrawnOut<'a> = (&'a [Vec<f64>], Axis, [f64; 2]);

/// The keys that may give a shape, wherever they stand.
#[derive(Clone, Copy)]
pub(crate) struct ShapeKeys<'a> {
    pub bounds: Option<&'a [Vec<f64>; 2]>,
    pub polygon: Option<&'a [Vec<f64>]>,
    /// Centre and radius.
    pub disc: Option<(&'a [f64], f64)>,
    pub ellipse: Option<&'a Ellipse>,
    /// Centre and radius.
    pub sphere: Option<(&'a [f64], f64)>,
    /// Both ends and radius.
    pub cylinder: Option<([&'a [f64]; 2], f64)>,
    /// Base, apex and radius.
    pub cone: Option<([&'a [f64]; 2], f64)>,
    pub extrusion: Option<DrawnOut<'a>>,
}

impl ShapeKeys<'_> {
    /// The keys that are given.
    pub fn given(&self) -> Vec<&'static str> {
        given([
            ("box", self.bounds.is_some()),
            ("polygon", self.polygon.is_some()),
            ("disc", self.disc.is_some()),
            ("ellipse", self.ellipse.is_some()),
            ("sphere", self.sphere.is_some()),
            ("cylinder", self.cylinder.is_some()),
            ("cone", self.cone.is_some()),
            ("extrusion", self.extrusion.is_some()),
        ])
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
        if let Some(e) = self.ellipse {
            return Some(Shape::Ellipse {
                centre: array(&e.centre),
                semi_axes: e.semi_axes,
            });
        }
        if let Some((ends, radius)) = self.cylinder {
            let [from, to] = ends.map(array);
            return Some(Shape::Cylinder { from, to, radius });
        }
        if let Some((ends, radius)) = self.cone {
            let [base, apex] = ends.map(array);
            return Some(Shape::Cone { base, apex, radius });
        }
        if let Some((points, axis, [from, to])) = self.extrusion {
            return Some(Shape::Extrusion {
                polygon: polygon(points),
                axis: axis as usize,
                ends: [from.min(to), from.max(to)],
            });
        }
        let (centre, radius) = self.disc.or(self.sphere)?;
        let centre = array(centre);
        Some(Shape::Ball { centre, radius })
    }
}

/// Tables that give a shape by the same keys; `ellipse` only where there is one.
macro_rules! with_shape {
    ($table:ident $(, $ellipse:ident)?) => {
        impl $table {
            pub(crate) fn keys(&self) -> ShapeKeys<'_> {
                #[allow(unused_mut, reason = "of tables without an ellipse")]
                let mut keys = ShapeKeys {
                    bounds: self.bounds.as_ref(),
                    polygon: self.polygon.as_deref(),
                    disc: self.disc.as_ref().map(|d| (&d.centre[..], d.radius)),
                    ellipse: None,
                    sphere: self.sphere.as_ref().map(|s| (&s.centre[..], s.radius)),
                    cylinder: self.cylinder.as_ref().map(|c| ([&c.from[..], &c.to], c.radius)),
                    cone: self.cone.as_ref().map(|c| ([&c.base[..], &c.apex], c.radius)),
                    extrusion: self.extrusion.as_ref().map(|e| (&e.polygon[..], e.axis, [e.from, e.to])),
                };
                $(keys.ellipse = self.$ellipse.as_ref();)?
                keys
            }
        }
    };
}
with_shape!(Body, ellipse);
with_shape!(Cutout, ellipse);
with_shape!(Wall);

impl Body {
    /// Whether walls decide what is filled: `clip` or `fill`.
    pub fn needs_walls(&self) -> bool {
        self.clip || self.fill.is_some()
    }
}

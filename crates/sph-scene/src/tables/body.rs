//! The tables `[body.NAME]`, where a phase is at the start, and `[phase.NAME]`, one material.

use scene_text::given;
use sph_core::{Axis, parameters};

use crate::geometry::polygon::Polygon;
use crate::geometry::vector::array;
use crate::reading::plugins::{AnyPlugins, Plugins};
use crate::{LevelSurface, Shape, Wave};

/// A piece of a phase at the start: one shape, or the volume that walls enclose, less subtracted shapes.
#[parameters]
pub struct Body {
    /// Name of the phase it is made of.
    pub phase: String,
    /// Its shape.
    #[serde(flatten)]
    pub shape: BodyShape,
    /// Fills the volume that walls enclose, instead of a shape; a `box` bounds it.
    pub fill: Option<Filling>,
    /// Point, m, in that one of several regions between the walls which `fill` fills; all of them if left out.
    #[parameter(unit: "m")]
    pub seed: Option<Vec<f64>>,
    /// True if only the fluid's side of all walls is filled.
    #[parameter(default)]
    pub clip: bool,
    /// Shapes that are cut out.
    #[parameter(default)]
    pub subtract: Vec<BodyShape>,
    /// Surface above which alone the body is filled: bodies of one `box` with the same surface in `below` and `above`
    /// share a lattice.
    pub above: Option<LevelSurface>,
    /// Surface below which alone the body is filled.
    pub below: Option<LevelSurface>,
    /// Wave on it at the start: the part above its surface is not filled.
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
    /// Level of the free surface against gravity, m, for a hydrostatic pressure. If left out, the top of the only body, or the weight of all bodies over a place.
    #[parameter(unit: "m")]
    pub surface: Option<f64>,
}

/// The shape of a body, or one that is cut out of it.
#[parameters]
pub struct BodyShape {
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

/// Filling of a body without a shape.
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

impl BodyShape {
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
        if let Some(corners) = &self.bounds {
            let [lo, hi] = corners.each_ref().map(|c| array(c));
            return Some(Shape::Cuboid { lo, hi });
        }
        if let Some(points) = &self.polygon {
            return Some(Shape::Polygon(polygon(points)));
        }
        if let Some(e) = &self.ellipse {
            let (centre, semi_axes) = (array(&e.centre), e.semi_axes);
            return Some(Shape::Ellipse { centre, semi_axes });
        }
        if let Some(c) = &self.cylinder {
            let (from, to, radius) = (array(&c.from), array(&c.to), c.radius);
            return Some(Shape::Cylinder { from, to, radius });
        }
        if let Some(c) = &self.cone {
            let (base, apex, radius) = (array(&c.base), array(&c.apex), c.radius);
            return Some(Shape::Cone { base, apex, radius });
        }
        if let Some(e) = &self.extrusion {
            return Some(Shape::Extrusion {
                polygon: polygon(&e.polygon),
                axis: e.axis as usize,
                ends: [e.from.min(e.to), e.from.max(e.to)],
            });
        }
        let round = self.disc.as_ref().or(self.sphere.as_ref())?;
        let (centre, radius) = (array(&round.centre), round.radius);
        Some(Shape::Ball { centre, radius })
    }
}

impl Body {
    /// True if walls bound the filling: `clip` or `fill`.
    pub fn needs_walls(&self) -> bool {
        self.clip || self.fill.is_some()
    }
}

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

/// A material: its density, how it resists compression and how it flows.
#[parameters]
pub struct Phase {
    /// Reference density, kg/m³.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Equation of state, `[phase.NAME.equation-of-state.PLUGIN]`; chosen by the solver if left out.
    #[serde(rename = "equation-of-state")]
    #[parameter(default)]
    #[schemars(with = "AnyPlugins", extend("maxProperties" = 1))]
    pub equation_of_state: Plugins,
    /// Rheology, `[phase.NAME.rheology.PLUGIN]`, exactly one.
    #[schemars(with = "AnyPlugins", extend("minProperties" = 1), extend("maxProperties" = 1))]
    pub rheology: Plugins,
    /// Numerical speed of sound, m/s; ten times the largest of `velocity_scale` and √(gH) if left out.
    #[parameter(unit: "m/s", above: 0.0, quantity: "speed of sound")]
    pub speed_of_sound: Option<f64>,
    /// Largest speed that is expected, m/s; used to choose the speed of sound.
    #[parameter(unit: "m/s", above: 0.0)]
    pub velocity_scale: Option<f64>,
}

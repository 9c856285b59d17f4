//! Shapes of walls that a scene gives by a few numbers.

use sph_core::parameters;

use crate::{Cone, Cylinder, Extrusion, Round};

/// A face of a box, or a direction along an axis.
#[parameters]
pub enum Face {
    /// Towards less x.
    #[serde(rename = "x-")]
    XMinus,
    /// Towards more x.
    #[serde(rename = "x+")]
    XPlus,
    /// Towards less y.
    #[serde(rename = "y-")]
    YMinus,
    /// Towards more y.
    #[serde(rename = "y+")]
    YPlus,
    /// Towards less z.
    #[serde(rename = "z-")]
    ZMinus,
    /// Towards more z.
    #[serde(rename = "z+")]
    ZPlus,
}

impl Face {
    /// Number of the axis.
    pub fn axis(self) -> usize {
        self as usize / 2
    }

    /// True if it is towards more.
    pub fn upper(self) -> bool {
        self as usize % 2 == 1
    }

    /// Name in scenes.
    pub fn name(self) -> &'static str {
        ["x-", "x+", "y-", "y+", "z-", "z+"][self as usize]
    }
}

/// A disc as a regular polygon, its corners on the circle.
#[parameters]
pub struct DiscWall {
    /// Centre and radius of the circle through the corners.
    #[serde(flatten)]
    pub shape: Round,
    /// Number of sides; about one per spacing of the circumference if left out.
    #[parameter(min: 3, max: 100_000)]
    pub sides: Option<usize>,
    /// Angle, rad, anticlockwise from +x, at which the first corner lies.
    #[parameter(default, unit: "rad")]
    pub turn: f64,
}

/// A sphere as an icosahedron of divided faces, its corners on the sphere.
#[parameters]
pub struct SphereWall {
    /// Centre and radius of the sphere through the corners.
    #[serde(flatten)]
    pub shape: Round,
    /// Number n of parts of every edge of the icosahedron, which gives 20 n² triangles; with edges of about one spacing if left out.
    #[parameter(min: 1, max: 500)]
    pub subdivisions: Option<usize>,
}

/// A cylinder as a prism over a regular polygon, its corners on the circle.
#[parameters]
pub struct CylinderWall {
    /// The cylinder through the corners.
    #[serde(flatten)]
    pub shape: Cylinder,
    /// Number of sides; about one per spacing of the circumference if left out.
    #[parameter(min: 3, max: 100_000)]
    pub sides: Option<usize>,
    /// Angle, rad, right-handed about the direction of travel, from +x for a cylinder along z (+y along x, +z along y) at which the first corner lies. A slanted cylinder counts as along the axis it is nearest to.
    #[parameter(default, unit: "rad")]
    pub turn: f64,
    /// True if the two flat ends are left out: a pipe.
    #[parameter(default)]
    pub open_ends: bool,
}

/// A cone over a regular polygon, its corners on the circle.
#[parameters]
pub struct ConeWall {
    /// The cone through the corners of the base.
    #[serde(flatten)]
    pub shape: Cone,
    /// Number of sides, 4 for a pyramid; about one per spacing of the base's circumference if left out.
    #[parameter(min: 3, max: 100_000)]
    pub sides: Option<usize>,
    /// Angle, rad, right-handed about the direction from base to apex, from +x for a cone along z (+y along x, +z along y) at which the first corner lies; "45 deg" turns the faces of an upright pyramid to the axes.
    #[parameter(default, unit: "rad")]
    pub turn: f64,
}

/// A ramp: the half of a box below the diagonal plane that rises in one direction.
#[parameters]
pub struct Wedge {
    /// Lower corner of the box, m.
    #[parameter(unit: "m")]
    pub lo: Vec<f64>,
    /// Upper corner of the box, m.
    #[parameter(unit: "m")]
    pub hi: Vec<f64>,
    /// Direction in which the ramp rises.
    #[parameter(default: Face::XPlus)]
    pub rise: Face,
    /// Direction that is up; `y+` in 2D and `z+` in 3D if left out.
    pub up: Option<Face>,
}

/// A polygon, given either way round, drawn out along an axis.
#[parameters]
pub struct ExtrusionWall {
    /// The polygon, either way round, and its ends.
    #[serde(flatten)]
    pub shape: Extrusion,
    /// True if the two flat ends are left out.
    #[parameter(default)]
    pub open_ends: bool,
}

/// A turn about a point, in space about an axis.
#[parameters]
pub struct Rotate {
    /// Axis, right-handed; its length does not matter. Three dimensions only, and needed there.
    #[parameter(unit: "1")]
    pub axis: Option<Vec<f64>>,
    /// Angle, rad, anticlockwise.
    #[parameter(unit: "rad")]
    pub angle: f64,
    /// Point that stays, m; the origin if left out.
    #[parameter(unit: "m")]
    pub centre: Option<Vec<f64>>,
}

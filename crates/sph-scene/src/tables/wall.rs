//! The table `[wall.NAME]`: geometry, condition and motion of a wall, and shapes that a scene gives by a few numbers.

use std::path::PathBuf;

use scene_text::given;
use sph_core::{Erodible, WallCondition, parameters};

use crate::reading::plugins::{AnyPlugins, Plugins};
use crate::tables::body::BodyShape;
use crate::{Cone, Cylinder, Extrusion, Motion, Round};

/// A solid wall with a name: exactly one geometry, how the fluid meets it and how it moves.
///
/// The geometry is scaled, then turned by `rotate`, then shifted by `translate`.
#[parameters]
pub struct Wall {
    /// Corners of the wall in order, m; the fluid is on the left of travel. Two dimensions only.
    #[parameter(unit: "m", min_items: 2)]
    pub polyline: Option<Vec<Vec<f64>>>,
    /// True if the last corner of the `polyline` is joined to the first.
    #[parameter(default)]
    pub closed: bool,
    /// Thickness of a plate, m, half of it on either side of the `polyline`; a plate has two faces and wets on both.
    #[parameter(unit: "m", above: 0.0)]
    pub thickness: Option<f64>,
    /// Corners of a polygon in order, m, either way round; it closes itself. Two dimensions only.
    #[parameter(unit: "m", min_items: 3)]
    pub polygon: Option<Vec<Vec<f64>>>,
    /// Disc by centre and radius. Two dimensions only.
    pub disc: Option<DiscWall>,
    /// Lower and upper corner of a box, m.
    #[serde(rename = "box")]
    #[parameter(unit: "m")]
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Faces of the `box` that are left out.
    #[parameter(default)]
    pub open: Vec<Face>,
    /// Sphere by centre and radius. Three dimensions only.
    pub sphere: Option<SphereWall>,
    /// Cylinder between two points. Three dimensions only.
    pub cylinder: Option<CylinderWall>,
    /// Cone by base and apex; with `sides = 4` a pyramid. Three dimensions only.
    pub cone: Option<ConeWall>,
    /// A ramp: half of a box, cut along a diagonal.
    pub wedge: Option<Wedge>,
    /// Polygon drawn out along an axis. Three dimensions only.
    pub extrusion: Option<ExtrusionWall>,
    /// File of the geometry, relative to the scene's folder: `.stl` in 3D; `.svg` or `.csv` in 2D.
    /// An SVG drawing stands upright: y points up and the origin is the lower left corner of its `viewBox` (else of its width and height, else the upper left corner); its numbers are user units.
    /// A CSV file has the columns x and y; a blank line or a line with `#` begins another line, and a line that ends where it began is closed.
    pub file: Option<String>,
    /// Factor on all coordinates, about the origin; 1 if left out.
    #[parameter(unit: "1", above: 0.0)]
    pub scale: Option<f64>,
    /// Unit of the coordinates of the `file`, such as "mm"; that in the heads of its columns, else metres, if left out.
    pub unit: Option<String>,
    /// Names of the CSV file's columns of x and y, or their numbers from 1; the only two if left out.
    #[parameter(min_items: 2, max_items: 2)]
    pub columns: Option<Vec<String>>,
    /// Shift of the geometry, m.
    #[parameter(unit: "m")]
    pub translate: Option<Vec<f64>>,
    /// Turn of the geometry, before it is shifted.
    pub rotate: Option<Rotate>,
    /// Side of a closed geometry on which the fluid is: `inside` if left out, `as-drawn` for a file. A `polyline` has the fluid on the left of travel.
    pub fluid: Option<FluidSide>,
    /// True if a `polyline`, or the geometry of a `file`, is turned round: the fluid is on the other side.
    #[parameter(default)]
    pub flip: bool,
    /// True if facets of an STL file that face the other way than most of those they hang together with are turned
    /// round.
    #[parameter(default)]
    pub align: bool,
    /// Condition of the fluid at the wall.
    #[serde(flatten)]
    pub condition: WallCondition,
    /// Velocity of the wall's surface, m/s, while its geometry stays: a belt.
    #[parameter(unit: "m/s")]
    pub velocity: Option<Vec<f64>>,
    /// Rigid motion of the geometry, prescribed.
    pub motion: Option<Motion>,
    /// The grains that the wall is made of; a flow carries none away if left out.
    pub erodible: Option<Erodible>,
    /// Name of the `erodible` wall that this one stands in: its foot follows the bed.
    pub stands_in: Option<String>,
    /// Mover of the geometry in place of a motion, with the force of the fluid on it, `[wall.NAME.mover.PLUGIN]`; none
    /// if left out.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub mover: Plugins,
    /// Open boundary at which fluid passes the geometry, `[wall.NAME.open-boundary.PLUGIN]`; a solid wall if left out.
    #[serde(rename = "open-boundary")]
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub open_boundary: Plugins,
    /// The file with its folder, set when the scene is read.
    #[serde(skip)]
    pub path: Option<PathBuf>,
    /// File and line in which its table begins, set when the scene is read.
    #[serde(skip)]
    pub place: Option<String>,
}

/// On which side of a closed geometry the fluid is.
#[parameters]
pub enum FluidSide {
    /// Inside: a tank, a pipe.
    Inside,
    /// Outside: an obstacle.
    Outside,
    /// The side that the facets of a file face, or the left of its lines in the upright drawing.
    AsDrawn,
}

impl Wall {
    /// The keys of geometries that are given.
    pub fn geometries(&self) -> Vec<&'static str> {
        given([
            ("polyline", self.polyline.is_some()),
            ("polygon", self.polygon.is_some()),
            ("disc", self.disc.is_some()),
            ("box", self.bounds.is_some()),
            ("sphere", self.sphere.is_some()),
            ("cylinder", self.cylinder.is_some()),
            ("cone", self.cone.is_some()),
            ("wedge", self.wedge.is_some()),
            ("extrusion", self.extrusion.is_some()),
            ("file", self.file.is_some()),
        ])
    }

    /// The keys that bodies have as well.
    pub(crate) fn shape(&self) -> BodyShape {
        BodyShape {
            bounds: self.bounds.clone(),
            polygon: self.polygon.clone(),
            disc: self.disc.as_ref().map(|d| d.shape.clone()),
            ellipse: None,
            sphere: self.sphere.as_ref().map(|s| s.shape.clone()),
            cylinder: self.cylinder.as_ref().map(|c| c.shape.clone()),
            cone: self.cone.as_ref().map(|c| c.shape.clone()),
            extrusion: self.extrusion.as_ref().map(|e| e.shape.clone()),
        }
    }

    /// The side of the fluid in force; none for a polyline.
    pub fn side(&self) -> Option<FluidSide> {
        let default = match (&self.polyline, &self.file) {
            (Some(_), _) => return None,
            (_, Some(_)) => FluidSide::AsDrawn,
            _ => FluidSide::Inside,
        };
        Some(self.fluid.unwrap_or(default))
    }
}

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

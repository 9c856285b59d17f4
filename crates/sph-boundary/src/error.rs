//! What can be wrong with a wall or with the kernel that looks at it.

mod surface;

pub use surface::SurfaceError;

use crate::geometry::wall_end::WallEnd;
use crate::limits::{MOST_PAIRS, MOST_PERIODS};

/// A refused wall, motion or kernel. Lengths are in metres, edges and points count from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BoundaryError {
    /// A wall that goes so far within a step that it would leap over particles and walls.
    #[error(
        "wall `{wall}` moves by {way:.3e} m in one step, and {most:.3e} m, half a spacing, is the most"
    )]
    Leap {
        /// Name of the wall.
        wall: String,
        /// Way of one of its points, m.
        way: f64,
        /// The longest way, m.
        most: f64,
    },
    /// Fluid at a body that is too light for it.
    #[error(
        "fluid acts on the body `{wall}`, which has less than a fiftieth of its density: one particle of it would throw the \
         body; give it more `density`"
    )]
    Light {
        /// Name of the wall.
        wall: String,
    },
    /// Walls that meet too fast, or under too heavy a load.
    #[error(
        "wall `{wall}` goes through wall `{other}`: it is too fast or too heavy for a contact as stiff as the speed of \
         sound allows; raise `speed_of_sound`"
    )]
    Through {
        /// Name of the wall.
        wall: String,
        /// Name of the other.
        other: String,
    },
    /// A polyline without an edge.
    #[error("wall `{wall}` has {count} point(s), at least two are needed")]
    TooFewPoints {
        /// Name of the wall.
        wall: String,
        /// Points given.
        count: usize,
    },
    /// A coordinate that is infinite or not a number.
    #[error("wall `{wall}`: point {point} has a coordinate that is not finite")]
    NotFinite {
        /// Name of the wall.
        wall: String,
        /// Index of the point.
        point: usize,
    },
    /// Two consecutive points at the same place.
    #[error(
        "wall `{wall}`: edge {edge} has zero length, points {edge} and {next} are both at \
         ({x}, {y})"
    )]
    ZeroLengthEdge {
        /// Name of the wall.
        wall: String,
        /// Index of the edge.
        edge: usize,
        /// Index of the point at its end.
        next: usize,
        /// Abscissa of both points.
        x: f64,
        /// Ordinate of both points.
        y: f64,
    },
    /// A closed wall that encloses nothing and is not a plate drawn forth and back.
    #[error(
        "wall `{wall}` is closed but encloses no area, and edge {edge} is not retraced in the \
         opposite direction as it would be on a plate of zero thickness"
    )]
    ZeroArea {
        /// Name of the wall.
        wall: String,
        /// First edge without an opposite face.
        edge: usize,
    },
    /// Two edges that cross.
    #[error(
        "edge {edge} of wall `{wall}` crosses edge {other_edge} of wall `{other}` near ({x}, {y})"
    )]
    Crossing {
        /// Name of the first wall.
        wall: String,
        /// Edge of the first wall.
        edge: usize,
        /// Name of the second wall, which may be the first.
        other: String,
        /// Edge of the second wall.
        other_edge: usize,
        /// Abscissa of the crossing.
        x: f64,
        /// Ordinate of the crossing.
        y: f64,
    },
    /// Edges that lie across each other's boxes by the million.
    #[error(
        "from wall `{wall}` on, more than {MOST_PAIRS} pairs of edges are so near each other that they must be \
         compared: draw it with fewer long slanted lines side by side"
    )]
    Tangled {
        /// Name of the wall.
        wall: String,
    },
    /// Walls far larger than a period, or far away from the box.
    #[error(
        "wall `{wall}` reaches {periods:.1e} periods from the periodic box, more than {MOST_PERIODS}: draw one \
         period of it"
    )]
    ManyPeriods {
        /// Name of the wall.
        wall: String,
        /// Periods that it reaches.
        periods: f64,
    },
    /// Two ends meet whose directions of travel disagree about where the fluid is.
    #[error(
        "the {end} end of wall `{wall}` meets the {other_end} end of wall `{other}` at ({x}, {y}): \
         their directions of travel put the fluid on opposite sides, reverse one of them"
    )]
    OpposedWalls {
        /// Name of the first wall.
        wall: String,
        /// Its end.
        end: WallEnd,
        /// Name of the second wall.
        other: String,
        /// Its end.
        other_end: WallEnd,
        /// Abscissa of the joint.
        x: f64,
        /// Ordinate of the joint.
        y: f64,
    },
    /// More than two ends at one place.
    #[error(
        "{count} ends of walls meet at ({x}, {y}), the first of wall `{wall}`: only two can be \
         joined"
    )]
    AmbiguousJoint {
        /// Name of one of the walls.
        wall: String,
        /// Number of ends.
        count: usize,
        /// Abscissa of the joint.
        x: f64,
        /// Ordinate of the joint.
        y: f64,
    },
    /// A particle whose support reaches past the end of an open wall.
    #[error(
        "the {end} end of wall `{wall}` at ({x}, {y}) is free and particle {particle} is {distance} \
         m away, within the kernel radius {radius} m: close the wall or extend it"
    )]
    FreeEndInReach {
        /// Name of the wall.
        wall: String,
        /// Which end.
        end: WallEnd,
        /// Abscissa of the end.
        x: f64,
        /// Ordinate of the end.
        y: f64,
        /// Index of the nearest particle.
        particle: usize,
        /// Its distance, m.
        distance: f64,
        /// The kernel radius, m.
        radius: f64,
    },
    /// A plate folded back onto itself.
    #[error("plate `{wall}` turns too sharply at point {point} to be given a thickness")]
    SharpPlate {
        /// Name of the plate.
        wall: String,
        /// Index of the point.
        point: usize,
    },
    /// The number of poses is not the number of walls.
    #[error("{given} pose(s) given for {walls} wall(s)")]
    PoseCount {
        /// Poses given.
        given: usize,
        /// Walls of the mesh.
        walls: usize,
    },
    /// Two joined walls given different motions.
    #[error("walls `{wall}` and `{other}` are joined at ({x}, {y}) and cannot move differently")]
    JointTornApart {
        /// Name of the wall that ends at the joint.
        wall: String,
        /// Name of the wall that starts there.
        other: String,
        /// Abscissa of the joint in the reference position.
        x: f64,
        /// Ordinate of the joint in the reference position.
        y: f64,
    },
    /// Coulomb's friction where there are no elements to press on.
    #[error("wall `{wall}` has Coulomb's friction, which needs the wall elements of `walls.usaw`")]
    NoElements {
        /// Name of the wall.
        wall: String,
    },
    /// A wall that a treatment does not have.
    #[error("wall `{wall}` {reason}; take `walls.usaw`")]
    NotScaled {
        /// Name of the wall.
        wall: String,
        /// What it is.
        reason: &'static str,
    },
    /// A wall whose map would be too large.
    #[error(
        "wall `{wall}` needs a map of {nodes} nodes, and {most} are the most: take `walls.usaw`, or larger particles"
    )]
    LargeMap {
        /// Name of the wall.
        wall: String,
        /// Nodes that its map would have.
        nodes: usize,
        /// Nodes at most.
        most: usize,
    },
    /// A wall closed through periodicity given a rotation.
    #[error("wall `{wall}` is closed through periodicity and cannot rotate")]
    PeriodicWallRotated {
        /// Name of the wall.
        wall: String,
    },
    /// A line in space or a surface in the plane.
    #[error(
        "wall `{wall}` is not drawn for {dimension} dimensions: a polyline is a wall of two, a surface one of three"
    )]
    Dimension {
        /// Name of the wall.
        wall: String,
        /// Dimensions of the scene.
        dimension: usize,
    },
    /// A motion with a number that is not finite or a table that does not ascend.
    #[error(
        "the motion of wall `{wall}` is not sound: all numbers must be finite, periods positive, an axis longer than zero, and the times of a table ascending"
    )]
    Motion {
        /// Name of the wall.
        wall: String,
    },
    /// A wall drawn as triangles.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A number that must be positive and finite.
    #[error("{name} must be positive and finite, got {value}")]
    NotPositive {
        /// What it is.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// Breaks or pieces of the kernel that do not fit.
    #[error("kernel is not a piecewise polynomial with a positive integral: {reason}")]
    Kernel {
        /// What is wrong.
        reason: String,
    },
}

/// Something to look at that does not stop the run.
#[derive(Clone, Debug, PartialEq)]
pub enum WallWarning {
    /// An edge shorter than a quarter of the spacing: it becomes one short segment.
    ShortEdge {
        /// Name of the wall.
        wall: String,
        /// Index of the edge.
        edge: usize,
        /// Its length, m.
        length: f64,
        /// The spacing asked for, m.
        spacing: f64,
    },
    /// A surface drawn with most of its triangles far smaller than the spacing: they stay so.
    FineSurface {
        /// Name of the wall.
        wall: String,
        /// Triangles with sides below a quarter of the spacing.
        fine: usize,
        /// All triangles of the wall.
        all: usize,
        /// The spacing asked for, m.
        spacing: f64,
    },
    /// Faces that end on the back of another wall: no fluid is before them, and they are left out.
    Unseen {
        /// Name of the wall.
        wall: String,
        /// How many.
        faces: usize,
    },
}

impl std::fmt::Display for WallWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::ShortEdge {
                wall,
                edge,
                length,
                spacing,
            } => write!(
                f,
                "edge {edge} of wall `{wall}` is {length} m long, far shorter than the spacing \
                 {spacing} m"
            ),
            Self::FineSurface {
                wall,
                fine,
                all,
                spacing,
            } => write!(
                f,
                "{fine} of the {all} triangles of wall `{wall}` are far smaller than the spacing \
                 {spacing} m: draw it coarser"
            ),
            Self::Unseen { wall, faces } => write!(
                f,
                "{faces} faces of wall `{wall}` end on the back of another wall: they bound no fluid and are left out"
            ),
        }
    }
}

/// A failure of the wall stages.
pub(crate) fn stage_error(reason: impl ToString) -> sph_core::StepError {
    sph_core::StepError::Stage {
        stage: "walls".into(),
        reason: reason.to_string(),
    }
}

//! What can be wrong with a wall drawn as triangles.

use sph_core::number;

/// A refused surface. Points, triangles and edges count from 0 as in what was given; edge k of a
/// triangle goes from its corner k to the next. Lengths and places in metres.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// A surface without a triangle.
    #[error("wall `{wall}` has no triangle")]
    NoTriangles {
        /// Name of the wall.
        wall: String,
    },
    /// A coordinate that is infinite or not a number.
    #[error("wall `{wall}`: point {point} has a coordinate that is not finite")]
    NotFinite {
        /// Name of the wall.
        wall: String,
        /// Index of the point.
        point: usize,
    },
    /// A corner that does not exist.
    #[error("wall `{wall}`: triangle {triangle} has the corner {point}, there are {count} points")]
    MissingPoint {
        /// Name of the wall.
        wall: String,
        /// Index of the triangle.
        triangle: usize,
        /// Index of the point.
        point: u32,
        /// Points given.
        count: usize,
    },
    /// A triangle without area, or with two corners at one place.
    #[error("wall `{wall}`: triangle {triangle} at {} has no area", place(.at))]
    NoArea {
        /// Name of the wall.
        wall: String,
        /// Index of the triangle.
        triangle: usize,
        /// Its first corner.
        at: [f64; 3],
    },
    /// A triangle so thin that its normal is rounding.
    #[error(
        "wall `{wall}`: triangle {triangle} at {} is a needle: {altitude} m high on an edge of \
         {edge} m", place(.at)
    )]
    Needle {
        /// Name of the wall.
        wall: String,
        /// Index of the triangle.
        triangle: usize,
        /// Its first corner.
        at: [f64; 3],
        /// Smallest altitude.
        altitude: f64,
        /// Longest edge.
        edge: f64,
    },
    /// A surface of the size of a particle.
    #[error(
        "wall `{wall}` is {extent} m across, less than two spacings of {spacing} m: the flow \
         cannot see it"
    )]
    TooSmall {
        /// Name of the wall.
        wall: String,
        /// Diagonal of the box around it.
        extent: f64,
        /// The spacing asked for.
        spacing: f64,
    },
    /// More elements than can be meant.
    #[error(
        "the walls would be cut into about {estimate} triangles, {limit} at most: `{wall}` alone \
         needs {own}; check the unit of length or use a coarser spacing"
    )]
    TooManyElements {
        /// Name of the wall that needs most.
        wall: String,
        /// Elements of that wall.
        own: u64,
        /// Elements of all walls.
        estimate: u64,
        /// The most.
        limit: u64,
    },
    /// Triangles that lie across each other's boxes by the million.
    #[error(
        "from wall `{wall}` on, more than {} pairs of triangles are so near each other that they must be \
         compared: draw it with fewer long slanted triangles side by side",
        crate::limits::MOST_PAIRS
    )]
    Tangled {
        /// Name of the wall.
        wall: String,
    },
    /// One triangle given twice.
    #[error("wall `{wall}`: triangles {triangle} and {other} at {} have the same corners", place(.at))]
    Repeated {
        /// Name of the wall.
        wall: String,
        /// Index of the first triangle.
        triangle: usize,
        /// Index of the second triangle.
        other: usize,
        /// A corner of both.
        at: [f64; 3],
    },
    /// Two faces of a wall on each other, with opposite normals.
    #[error(
        "wall `{wall}`: triangles {triangle} and {other} lie on each other near {} with opposite \
         normals: give the plate a thickness, or draw bodies that touch as walls of their own",
        place(.at)
    )]
    NoThickness {
        /// Name of the wall.
        wall: String,
        /// Index of the first triangle.
        triangle: usize,
        /// Index of the second triangle.
        other: usize,
        /// A place on both.
        at: [f64; 3],
    },
    /// Two triangles that travel their common edge in the same direction.
    #[error(
        "wall `{wall}`: triangles {triangle} and {other} meet in an edge at {} but put the fluid \
         on opposite sides: one of them is flipped", place(.at)
    )]
    Flipped {
        /// Name of the wall.
        wall: String,
        /// Index of the first triangle.
        triangle: usize,
        /// Index of the second triangle.
        other: usize,
        /// Middle of the edge.
        at: [f64; 3],
    },
    /// An edge of more than two triangles.
    #[error(
        "wall `{wall}`: {count} triangles meet in one edge at {}, the first is {triangle}: the \
         surface is not a manifold there, draw the bodies as walls of their own", place(.at)
    )]
    NotManifold {
        /// Name of the wall.
        wall: String,
        /// The first triangle.
        triangle: usize,
        /// Number of triangles.
        count: usize,
        /// Middle of the edge.
        at: [f64; 3],
    },
    /// Two triangles that cross.
    #[error(
        "triangle {triangle} of wall `{wall}` crosses triangle {other_triangle} of wall `{other}` \
         near {}", place(.at)
    )]
    Crossing {
        /// Name of the first wall.
        wall: String,
        /// Triangle of the first wall.
        triangle: usize,
        /// Name of the second wall, which may be the first.
        other: String,
        /// Triangle of the second wall.
        other_triangle: usize,
        /// Middle of where they cross.
        at: [f64; 3],
    },
    /// Two triangles in one plane that cover each other and face the same way.
    #[error(
        "triangle {triangle} of wall `{wall}` and triangle {other_triangle} of wall `{other}` \
         cover each other near {}: that piece is drawn twice", place(.at)
    )]
    DrawnTwice {
        /// Name of the first wall.
        wall: String,
        /// Triangle of the first wall.
        triangle: usize,
        /// Name of the second wall, which may be the first.
        other: String,
        /// Triangle of the second wall.
        other_triangle: usize,
        /// A place on both.
        at: [f64; 3],
    },
    /// A wall that other walls cover altogether, or that bounds no fluid.
    #[error(
        "nothing is left of wall `{wall}`: other walls cover all of it, or turn their backs on its edges; does one of \
         them face the other way? leave it out, or give a plate of two sides a thickness"
    )]
    Covered {
        /// Name of the wall.
        wall: String,
    },
    /// Walls that meet in an edge with the fluid on different sides.
    #[error(
        "walls `{wall}` and `{other}` meet in an edge at {} but put the fluid on opposite sides: \
         reverse the triangles of one of them", place(.at)
    )]
    Opposed {
        /// Name of the first wall.
        wall: String,
        /// Name of the second wall.
        other: String,
        /// Middle of the edge.
        at: [f64; 3],
    },
    /// A planar piece that could not be cut into triangles.
    #[error("the planar piece of wall `{wall}` at {} cannot be cut into triangles: {reason}", place(.at))]
    NotMeshed {
        /// Name of the wall.
        wall: String,
        /// A corner of the piece.
        at: [f64; 3],
        /// Why.
        reason: String,
    },
    /// The number of groups is not the number of walls.
    #[error("{given} group(s) given for {walls} wall(s)")]
    GroupCount {
        /// Groups given.
        given: usize,
        /// Walls given.
        walls: usize,
    },
    /// Two walls of one group given different motions.
    #[error("walls `{wall}` and `{other}` move together and cannot be given different motions")]
    TornApart {
        /// Name of the first wall.
        wall: String,
        /// Name of the second wall.
        other: String,
    },
    /// A particle whose support reaches past an edge that no other triangle continues.
    #[error(
        "wall `{wall}` is open: {edges} edge(s) without a neighbour surround an opening of \
         {} m around {}, and at {} one of them is {} m from particle {particle}, within the \
         kernel radius {} m: {}", number::plain(*.extent), place(.centre), place(.at), number::plain(*.distance),
         number::plain(*.radius), remedy(.met)
    )]
    FreeEdgeInReach {
        /// Name of the wall.
        wall: String,
        /// Edges around the opening, before they are cut at the spacing.
        edges: usize,
        /// Diagonal of the box around the opening.
        extent: f64,
        /// Middle of that box.
        centre: Box<[f64; 3]>,
        /// A wall that meets this one in the edge with its back.
        met: Option<String>,
        /// Place on the edge nearest to the particle.
        at: [f64; 3],
        /// Index of the nearest particle.
        particle: usize,
        /// Its distance.
        distance: f64,
        /// The kernel radius.
        radius: f64,
    },
}

fn remedy(met: &Option<String>) -> String {
    match met {
        Some(other) => format!(
            "wall `{other}` meets it there and does not continue it: does one of the two face the other way?"
        ),
        None => "close the wall or extend it".to_string(),
    }
}

fn place(at: &[f64; 3]) -> String {
    // Rounding of computed places is not shown.
    let [x, y, z] = at.map(|x| {
        let size = at.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let unit = 10f64.powi(6 - size.max(f64::MIN_POSITIVE).log10().ceil() as i32);
        let rounded = (x * unit).round() / unit;
        if rounded.is_finite() {
            rounded + 0.0
        } else {
            x
        }
    });
    format!("({x}, {y}, {z})")
}

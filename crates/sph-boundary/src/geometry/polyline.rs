//! A wall as it is drawn, and its ends.

use crate::geometry::vector::{perp, sub};

/// A wall of straight edges with the fluid on the left of the direction of travel.
///
/// The inward unit normal of an edge with unit tangent t is n = (−t_y, t_x): a closed polyline runs
/// counter-clockwise around the fluid it holds and clockwise around a solid in the fluid.
///
/// A closed polyline that goes forth and back over the same points is a plate of zero thickness
/// with fluid on both sides; `closed` with two points is the shortest one. A wall along a whole
/// period of a periodic box is drawn *open*, from one side of the box to the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// Name used in messages.
    pub name: String,
    /// Corners in the order of travel, m.
    pub points: Vec<[f64; 2]>,
    /// True if an edge leads from the last point back to the first.
    pub closed: bool,
}

impl Polyline {
    /// A wall that returns to its first point, which is not repeated at the end.
    pub fn closed(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self {
            closed: true,
            ..Self::open(name, points)
        }
    }

    /// A wall from its first to its last point.
    pub fn open(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self {
            name: name.into(),
            points,
            closed: false,
        }
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        let open = usize::from(!self.closed);
        self.points.len().saturating_sub(open)
    }

    /// End points of edge `edge`, in the order of travel.
    ///
    /// # Panics
    /// When there is no such edge.
    pub fn edge(&self, edge: usize) -> [[f64; 2]; 2] {
        let next = (edge + 1) % self.points.len();
        [self.points[edge], self.points[next]]
    }

    /// All edges in the order of travel.
    pub fn edges(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        (0..self.edge_count()).map(|edge| self.edge(edge))
    }

    /// Lengths of all edges, m.
    pub fn lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.edges().map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]))
    }

    /// The same wall with the fluid on the other side.
    pub fn reversed(&self) -> Self {
        let mut reversed = self.clone();
        reversed.points.reverse();
        reversed
    }

    /// Area ½ Σ x_i y_{i+1} − x_{i+1} y_i inside the closed polyline, positive when counter-clockwise, m².
    pub fn signed_area(&self) -> f64 {
        let Some(&[x0, y0]) = self.points.first() else {
            return 0.0;
        };
        let moved = |i: usize| sub(self.points[i % self.points.len()], [x0, y0]);
        let twice = (0..self.points.len()).map(|i| perp(moved(i), moved(i + 1)));
        0.5 * twice.sum::<f64>()
    }
}

/// An end of an open wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WallEnd {
    /// The start of the direction of travel.
    First,
    /// The end of the direction of travel.
    Last,
}

impl std::fmt::Display for WallEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::First => "first",
            Self::Last => "last",
        })
    }
}

/// The end of a wall that nothing continues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeEnd {
    /// Index of the wall.
    pub wall: usize,
    /// Its end.
    pub end: WallEnd,
    /// Index of the node.
    pub node: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_is_positive_counter_clockwise() {
        let points = vec![[1.0, 1.0], [3.0, 1.0], [3.0, 4.0], [1.0, 4.0]];
        let square = Polyline::closed("square", points);
        assert_eq!(square.signed_area(), 6.0);
        assert_eq!(square.reversed().signed_area(), -6.0);
        assert_eq!(square.edge_count(), 4);
        assert_eq!(square.edge(3), [[1.0, 4.0], [1.0, 1.0]]);
    }
}

//! Edges that cross.

use crate::error::BoundaryError;
use crate::periodic::PeriodicBox;
use crate::polyline::Polyline;

struct Edge {
    wall: usize,
    edge: usize,
    /// Whether it is an image of another edge across a periodic side.
    image: bool,
    ends: [[f64; 2]; 2],
    /// Bounds along x.
    x: [f64; 2],
}

/// Refuses two edges, of one wall or of two, that cross properly; touching is allowed.
///
/// An end within `tolerance` metres of the other edge's line touches it.
pub(crate) fn check_crossings(
    polylines: &[Polyline],
    tolerance: f64,
    domain: &PeriodicBox,
) -> Result<(), BoundaryError> {
    let mut edges = edges(polylines, domain);
    edges.sort_by(|a, b| {
        a.x[0]
            .total_cmp(&b.x[0])
            .then_with(|| (a.wall, a.edge).cmp(&(b.wall, b.edge)))
    });
    for (i, first) in edges.iter().enumerate() {
        for second in edges[i + 1..]
            .iter()
            .take_while(|second| second.x[0] <= first.x[1])
        {
            if first.image && second.image {
                continue;
            }
            if let Some([x, y]) = crossing(first.ends, second.ends, tolerance) {
                return Err(BoundaryError::Crossing {
                    wall: polylines[first.wall].name.clone(),
                    edge: first.edge,
                    other: polylines[second.wall].name.clone(),
                    other_edge: second.edge,
                    x,
                    y,
                });
            }
        }
    }
    Ok(())
}

/// All edges, and their images across the periodic sides that come near the walls themselves.
fn edges(polylines: &[Polyline], domain: &PeriodicBox) -> Vec<Edge> {
    let points = || polylines.iter().flat_map(|line| &line.points);
    let low = [0, 1].map(|k| points().map(|p| p[k]).fold(f64::INFINITY, f64::min));
    let high = [0, 1].map(|k| points().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
    let walls = PeriodicBox {
        lower: low,
        upper: high,
        ..*domain
    };
    let periods = domain.periods();
    // Images of an interval that overlap the walls, counted in periods of the box.
    let images = |k: usize, a: f64, b: f64| {
        if !walls.periodic[k] {
            return 0..=0;
        }
        let first = ((low[k] - b) / periods[k]).ceil() as i32;
        first..=((high[k] - a) / periods[k]).floor() as i32
    };
    let mut edges = Vec::new();
    for (wall, line) in polylines.iter().enumerate() {
        for (edge, [a, b]) in line.edges().enumerate() {
            for i in images(0, a[0].min(b[0]), a[0].max(b[0])) {
                for j in images(1, a[1].min(b[1]), a[1].max(b[1])) {
                    let shift = domain.shift([i, j]);
                    let ends = [a, b].map(|p| [p[0] + shift[0], p[1] + shift[1]]);
                    let x = [ends[0][0].min(ends[1][0]), ends[0][0].max(ends[1][0])];
                    edges.push(Edge {
                        wall,
                        edge,
                        image: [i, j] != [0; 2],
                        ends,
                        x,
                    });
                }
            }
        }
    }
    edges
}

/// Where two edges cross, if the ends of each are on opposite sides of the other.
fn crossing([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2], tolerance: f64) -> Option<[f64; 2]> {
    let [to_a, to_b] = [a, b].map(|p| distance_to_line(p, c, d));
    let [to_c, to_d] = [c, d].map(|p| distance_to_line(p, a, b));
    let opposite = |p: f64, q: f64| p * q < 0.0 && p.abs().min(q.abs()) > tolerance;
    if !(opposite(to_a, to_b) && opposite(to_c, to_d)) {
        return None;
    }
    let part = to_a / (to_a - to_b);
    Some([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])])
}

/// Signed distance of `p` to the line from `c` to `d`, positive on its left.
fn distance_to_line(p: [f64; 2], c: [f64; 2], d: [f64; 2]) -> f64 {
    let (x, y) = (d[0] - c[0], d[1] - c[1]);
    (x * (p[1] - c[1]) - y * (p[0] - c[0])) / x.hypot(y)
}

//! On which side of the walls a point is.

use crate::geometry::mesh::{NearSegment, SegmentMesh};
use crate::geometry::sides::Columns;

/// Crossings of the ray closer to each other than this part of the wall's extent are one place.
const SAME_HEIGHT: f64 = 1e-12;

/// Walls that wind around a place by more than this enclose it, though they have openings.
const ENCLOSED: f64 = 0.5;

impl SegmentMesh {
    /// Whether a point is in the fluid, as the walls see it.
    ///
    /// A ray goes from the point along an axis that is not periodic (upwards if both or neither
    /// are). Among the crossings at one height opposite ones cancel, as do the faces of a plate of
    /// zero thickness or of two blocks that touch; the first height where one is left decides by
    /// the side that faces the point. A ray that meets nothing asks the wall that reaches
    /// furthest along it. Without walls every point is in the fluid.
    ///
    /// Walls with free ends enclose a point, but for their openings, where their winding number is more than ½, and
    /// that decides; elsewhere a free end shadows nothing. A point on a wall within rounding may be given either
    /// answer.
    ///
    /// The first call after a motion sorts the segments into columns; then the cost is that of the
    /// segments in one column.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        let along = self.ray_axis();
        let columns = self.sides.0.get_or_init(|| self.columns(along));
        if let Some(enclosed) = self.wound(columns, point).filter(|w| w.abs() > ENCLOSED) {
            return enclosed > 0.0;
        }
        let across = 1 - along;
        let column = columns.column(point[across], self.domain(), across);
        let mut crossings = self.crossings(column, point, along);
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let scale = crossings
            .last()
            .map_or(0.0, |(height, _)| height.abs() + point[along].abs());
        let mut rest = crossings.as_slice();
        while let Some(&(height, _)) = rest.first() {
            let count = rest.partition_point(|(h, _)| *h <= height + SAME_HEIGHT * scale);
            let net: i32 = rest[..count].iter().map(|(_, facing)| facing).sum();
            if net != 0 {
                return net > 0;
            }
            rest = &rest[count..];
        }
        columns.beyond
    }

    fn columns(&self, along: usize) -> Columns {
        let across = 1 - along;
        let ends = |s: usize| {
            let [a, b] = self.ends(s);
            (a[across].min(b[across]), a[across].max(b[across]))
        };
        let spans: Vec<_> = (0..self.segments().len()).map(ends).collect();
        let mut columns = Columns::new(&spans, self.domain(), across, self.fluid_beyond(along));
        if !self.free_ends().is_empty() && self.domain().periodic == [false; 2] {
            let edges = self.segments().chunk_by(|a, b| {
                (a.wall, a.edge, a.vertices[1]) == (b.wall, b.edge, b.vertices[0])
            });
            let ends = edges.map(|e| [e[0].vertices[0], e[e.len() - 1].vertices[1]]);
            columns.edges = ends.collect();
        }
        columns
    }

    /// How far walls with free ends enclose a point: their winding number Σ α/2π, α the angle in which the point sees
    /// an edge; positive where they face it. None of walls that are closed, or in a periodic box.
    pub fn enclosed(&self, point: [f64; 2]) -> Option<f64> {
        let along = self.ray_axis();
        self.wound(self.sides.0.get_or_init(|| self.columns(along)), point)
    }

    fn wound(&self, columns: &Columns, point: [f64; 2]) -> Option<f64> {
        let angle = |[a, b]: &[usize; 2]| {
            let [a, b] = [a, b].map(|v| {
                let x = self.vertices()[*v].position;
                [x[0] - point[0], x[1] - point[1]]
            });
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1])
        };
        let sum: f64 = columns.edges.iter().map(angle).sum();
        (!columns.edges.is_empty()).then_some(sum / std::f64::consts::TAU)
    }

    fn ray_axis(&self) -> usize {
        match self.domain().periodic {
            [false, true] => 0,
            _ => 1,
        }
    }

    /// Heights above the point at which the ray meets a segment, with +1 where the fluid is on the
    /// near side of it and −1 where it is on the far side.
    fn crossings(&self, column: &[u32], point: [f64; 2], along: usize) -> Vec<(f64, i32)> {
        let across = 1 - along;
        let domain = self.domain();
        let period = domain.periods()[along];
        let mut crossings = Vec::new();
        for s in column.iter().map(|s| *s as usize) {
            let segment = &self.segments()[s];
            // The image of the segment that faces the point.
            let mut apart = [0.0; 2];
            apart[across] = point[across] - segment.centre[across];
            let image = domain.nearest_image(apart);
            let [a, b] = self.seen_from(point, NearSegment { segment: s, image });
            let x = [a[across], b[across]];
            if (x[0] <= 0.0) == (x[1] <= 0.0) {
                continue;
            }
            let part = x[0] / (x[0] - x[1]);
            let mut height = a[along] + part * (b[along] - a[along]);
            if domain.periodic[along] {
                height = height.rem_euclid(period);
            }
            if height > 0.0 {
                crossings.push((height, if segment.normal[along] < 0.0 { 1 } else { -1 }));
            }
        }
        crossings
    }

    /// Whether the fluid lies beyond all walls along the positive direction of an axis.
    fn fluid_beyond(&self, along: usize) -> bool {
        let joined = || {
            let vertices = self.vertices().iter();
            vertices.filter_map(|v| Some((v.position[along], v.previous?, v.next?)))
        };
        let outward = |previous: usize, next: usize| {
            self.segments()[previous].normal[along] + self.segments()[next].normal[along]
        };
        let top = joined().fold(f64::NEG_INFINITY, |top, (h, ..)| top.max(h));
        let scale = joined().fold(0.0, |scale: f64, (h, ..)| scale.max(h.abs()));
        // Both faces of a plate of zero thickness are as high; the upper one decides.
        let furthest = joined()
            .filter(|(h, ..)| *h >= top - SAME_HEIGHT * scale)
            .max_by(|a, b| outward(a.1, a.2).total_cmp(&outward(b.1, b.2)));
        let Some((_, previous, next)) = furthest else {
            return true;
        };
        let outward = outward(previous, next);
        if self.domain().periodic == [true; 2] || outward != 0.0 {
            return self.domain().periodic == [true; 2] || outward > 0.0;
        }
        // A spike: the fluid is outside when it is travelled clockwise or folds back.
        let [t, u] = [previous, next].map(|s| self.segments()[s].tangent());
        t[0] * u[1] - t[1] * u[0] <= 0.0
    }
}

//! The data of SVG paths: `M 0 0 L 1 0 A …`.

use kurbo::{Arc, BezPath, PathEl, Point, SvgArc, Vec2};
use svgtypes::{PathParser, PathSegment};

/// The path of the data, its arcs as cubics within `tolerance`.
///
/// # Errors
/// If the data is broken, or a number is larger than `limit`.
pub(crate) fn parse(data: &str, tolerance: f64, limit: f64) -> Result<BezPath, String> {
    let mut pen = Pen {
        path: BezPath::new(),
        at: Point::ZERO,
        start: Point::ZERO,
        handles: [Point::ZERO; 2],
        down: false,
    };
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|e| format!("d: {e}"))?;
        pen.draw(segment, tolerance, limit)?;
    }
    Ok(pen.path)
}

struct Pen {
    path: BezPath,
    at: Point,
    start: Point,
    /// Last control points of a cubic and of a quadratic curve, which smooth ones mirror; the pen's place after others.
    handles: [Point; 2],
    /// True if a line has been begun.
    down: bool,
}

impl Pen {
    fn draw(&mut self, segment: PathSegment, tolerance: f64, limit: f64) -> Result<(), String> {
        let from = self.at;
        let base = if segment.is_abs() { Point::ZERO } else { from };
        let place = |x: f64, y: f64| match x.abs().max(y.abs()) <= limit {
            true => Ok(Point::new(base.x + x, base.y + y)),
            false => Err(format!("d: ({x}, {y}) is out of range for this spacing")),
        };
        let [cubic, quadratic] = self.handles.map(|last| from + (from - last));
        if !matches!(segment, PathSegment::MoveTo { .. }) && !self.down {
            self.push(PathEl::MoveTo(from));
        }
        let drawn = match segment {
            PathSegment::MoveTo { x, y, .. } => PathEl::MoveTo(place(x, y)?),
            PathSegment::LineTo { x, y, .. } => PathEl::LineTo(place(x, y)?),
            PathSegment::HorizontalLineTo { x, .. } => {
                PathEl::LineTo(Point::new(place(x, 0.0)?.x, from.y))
            }
            PathSegment::VerticalLineTo { y, .. } => {
                PathEl::LineTo(Point::new(from.x, place(0.0, y)?.y))
            }
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => PathEl::CurveTo(place(x1, y1)?, place(x2, y2)?, place(x, y)?),
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                PathEl::CurveTo(cubic, place(x2, y2)?, place(x, y)?)
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                PathEl::QuadTo(place(x1, y1)?, place(x, y)?)
            }
            PathSegment::SmoothQuadratic { x, y, .. } => PathEl::QuadTo(quadratic, place(x, y)?),
            PathSegment::EllipticalArc {
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
                ..
            } => {
                place(rx, ry)?;
                let to = place(x, y)?;
                let arc = SvgArc {
                    from,
                    to,
                    radii: Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                };
                // Between ends that are one place an arc has no centre.
                let apart = (to - from).hypot() > 1e-9 * tolerance;
                if let Some(arc) = Some(&arc).filter(|_| apart).and_then(Arc::from_svg_arc) {
                    let path = &mut self.path;
                    arc.to_cubic_beziers(tolerance, |a, b, c| path.curve_to(a, b, c));
                    (self.at, self.handles) = (to, [to; 2]);
                    return Ok(());
                }
                PathEl::LineTo(to)
            }
            PathSegment::ClosePath { .. } => PathEl::ClosePath,
        };
        self.push(drawn);
        Ok(())
    }

    fn push(&mut self, drawn: PathEl) {
        if let PathEl::MoveTo(start) = drawn {
            self.start = start;
        }
        self.path.push(drawn);
        self.down = drawn != PathEl::ClosePath;
        let at = drawn.end_point().unwrap_or(self.start);
        self.handles = match drawn {
            PathEl::CurveTo(_, second, _) => [second, at],
            PathEl::QuadTo(control, _) => [at, control],
            _ => [at; 2],
        };
        self.at = at;
    }
}

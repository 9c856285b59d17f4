//! The data of SVG paths: `M 0 0 L 1 0 A …`.

use kurbo::{Arc, BezPath, Point, SvgArc, Vec2};
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
        let mut handles = [None; 2];
        if !matches!(segment, PathSegment::MoveTo { .. }) && !self.down {
            self.begin(from);
        }
        self.at = match segment {
            PathSegment::MoveTo { x, y, .. } => {
                self.begin(place(x, y)?);
                self.start
            }
            PathSegment::LineTo { x, y, .. } => self.line(place(x, y)?),
            PathSegment::HorizontalLineTo { x, .. } => {
                self.line(Point::new(place(x, 0.0)?.x, from.y))
            }
            PathSegment::VerticalLineTo { y, .. } => {
                self.line(Point::new(from.x, place(0.0, y)?.y))
            }
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => {
                let first = place(x1, y1)?;
                self.cubic([first, place(x2, y2)?, place(x, y)?], &mut handles)
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                self.cubic([cubic, place(x2, y2)?, place(x, y)?], &mut handles)
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                self.quadratic([place(x1, y1)?, place(x, y)?], &mut handles)
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                self.quadratic([quadratic, place(x, y)?], &mut handles)
            }
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
                let arc = SvgArc {
                    from,
                    to: place(x, y)?,
                    radii: Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                };
                self.arc(&arc, tolerance)
            }
            PathSegment::ClosePath { .. } => {
                self.path.close_path();
                self.down = false;
                self.start
            }
        };
        self.handles = handles.map(|handle| handle.unwrap_or(self.at));
        Ok(())
    }

    /// A new line from here.
    fn begin(&mut self, at: Point) {
        self.path.move_to(at);
        self.start = at;
        self.down = true;
    }

    /// A curve by two handles; a smooth continuation mirrors the second.
    fn cubic(
        &mut self,
        [first, second, to]: [Point; 3],
        handles: &mut [Option<Point>; 2],
    ) -> Point {
        handles[0] = Some(second);
        self.path.curve_to(first, second, to);
        to
    }

    /// The same by one handle.
    fn quadratic(&mut self, [control, to]: [Point; 2], handles: &mut [Option<Point>; 2]) -> Point {
        handles[1] = Some(control);
        self.path.quad_to(control, to);
        to
    }

    fn line(&mut self, to: Point) -> Point {
        self.path.line_to(to);
        to
    }

    fn arc(&mut self, given: &SvgArc, tolerance: f64) -> Point {
        // Between ends that are one place an arc has no centre.
        let apart = (given.to - given.from).hypot() > 1e-9 * tolerance;
        match Some(given).filter(|_| apart).and_then(Arc::from_svg_arc) {
            Some(arc) => {
                let path = &mut self.path;
                arc.to_cubic_beziers(tolerance, |a, b, c| path.curve_to(a, b, c));
            }
            None => self.path.line_to(given.to),
        }
        given.to
    }
}

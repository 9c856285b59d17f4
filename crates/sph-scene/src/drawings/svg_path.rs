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
        handle: Handle::None,
        down: false,
    };
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|e| format!("d: {e}"))?;
        pen.draw(segment, tolerance, limit)?;
    }
    Ok(pen.path)
}

/// The last control point, which a smooth curve mirrors.
#[derive(Clone, Copy)]
enum Handle {
    None,
    Quadratic(Point),
    Cubic(Point),
}

struct Pen {
    path: BezPath,
    at: Point,
    start: Point,
    handle: Handle,
    /// Whether a line has been begun.
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
        let mirrored = |p: Point| from + (from - p);
        let mut handle = Handle::None;
        if !matches!(segment, PathSegment::MoveTo { .. }) && !self.down {
            self.path.move_to(from);
            self.start = from;
            self.down = true;
        }
        self.at = match segment {
            PathSegment::MoveTo { x, y, .. } => {
                self.start = place(x, y)?;
                self.path.move_to(self.start);
                self.down = true;
                self.start
            }
            PathSegment::LineTo { x, y, .. } => self.line(place(x, y)?),
            PathSegment::HorizontalLineTo { x, .. } => {
                let to = Point::new(place(x, 0.0)?.x, from.y);
                self.line(to)
            }
            PathSegment::VerticalLineTo { y, .. } => {
                let to = Point::new(from.x, place(0.0, y)?.y);
                self.line(to)
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
                let (first, second, to) = (place(x1, y1)?, place(x2, y2)?, place(x, y)?);
                handle = Handle::Cubic(second);
                self.path.curve_to(first, second, to);
                to
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = match self.handle {
                    Handle::Cubic(p) => mirrored(p),
                    _ => from,
                };
                let (second, to) = (place(x2, y2)?, place(x, y)?);
                handle = Handle::Cubic(second);
                self.path.curve_to(first, second, to);
                to
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                let (control, to) = (place(x1, y1)?, place(x, y)?);
                handle = Handle::Quadratic(control);
                self.path.quad_to(control, to);
                to
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let control = match self.handle {
                    Handle::Quadratic(p) => mirrored(p),
                    _ => from,
                };
                let to = place(x, y)?;
                handle = Handle::Quadratic(control);
                self.path.quad_to(control, to);
                to
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
                let to = place(x, y)?;
                let arc = SvgArc {
                    from,
                    to,
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
        self.handle = handle;
        Ok(())
    }

    fn line(&mut self, to: Point) -> Point {
        self.path.line_to(to);
        to
    }

    fn arc(&mut self, given: &SvgArc, tolerance: f64) -> Point {
        // Between ends that are one place an arc has no centre.
        let apart = (given.to - given.from).hypot() > 1e-9 * tolerance;
        let arc = match apart {
            true => Arc::from_svg_arc(given),
            false => None,
        };
        match arc {
            Some(arc) => {
                let path = &mut self.path;
                arc.to_cubic_beziers(tolerance, |a, b, c| path.curve_to(a, b, c));
            }
            None => self.path.line_to(given.to),
        }
        given.to
    }
}

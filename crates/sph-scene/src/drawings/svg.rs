//! Lines from SVG drawings.

use kurbo::{
    Affine, Arc, BezPath, Circle, Ellipse, PathEl, Point, RoundedRect, Shape, SvgArc, Vec2,
};
use roxmltree::{Document, Node, ParsingOptions};
use svgtypes::{Length, LengthUnit, PathParser, PathSegment, PointsParser, Transform, ViewBox};

use crate::geometry::outlines::Line;

/// Most elements, texts and comments of a drawing.
const NODES: u32 = 2_000_000;
const CORNERS: usize = 1_000_000;
/// Largest coordinate, in tolerances.
const LARGEST: f64 = 1e9;
/// Shares of the tolerance that arcs lose to cubics and cubics to straight edges.
const SHARES: [f64; 2] = [0.1, 0.8];

impl Line {
    /// The lines of an SVG drawing, upright, in user units; curves within `tolerance` user units.
    ///
    /// The origin is the lower left corner of the `viewBox`, else of the width and height, else the upper left corner.
    ///
    /// # Errors
    /// If it is no drawing, holds no lines, or is too large for the tolerance: the given name, the place, the fault there.
    pub fn from_svg(text: &str, name: &str, tolerance: f64) -> Result<Vec<Self>, String> {
        let told = |why: String| format!("`{name}`: {why}");
        let options = ParsingOptions {
            allow_dtd: true,
            nodes_limit: NODES,
            ..ParsingOptions::default()
        };
        let document = Document::parse_with_options(text, options)
            .map_err(|e| told(format!("it is no SVG drawing: {e}")))?;
        let root = document.root_element();
        if root.tag_name().name() != "svg" {
            return Err(told("it is no SVG drawing: there is no <svg>".to_string()));
        }
        let mut lines = Lines {
            tolerance,
            found: Vec::new(),
            corners: 0,
        };
        let upright = upright(&root).map_err(told)?;
        // Not by recursion: drawings may be nested to any depth.
        let mut waiting: Vec<(Node<'_, '_>, Affine)> = children(&root, upright);
        while let Some((node, outer)) = waiting.pop() {
            let name = node.tag_name().name();
            let place = |why: String| {
                let at = document.text_pos_at(node.range().start);
                told(format!("line {}: <{name}>: {why}", at.row))
            };
            if hidden(&node) {
                continue;
            }
            let placed = match node.attribute("transform") {
                Some(text) => outer * transform(text).map_err(place)?,
                None => outer,
            };
            match name {
                "svg" | "use" | "text" => {
                    let why = "it is not read; turn it into paths (unlink clones, convert text)";
                    return Err(place(why.to_string()));
                }
                "g" | "a" | "switch" => waiting.extend(children(&node, placed)),
                _ => {
                    let tolerance = SHARES[0] * tolerance / scale(&placed);
                    if let Some(path) = drawn(&node, tolerance).map_err(place)? {
                        lines.add(&(placed * path)).map_err(place)?;
                    }
                }
            }
        }
        let found = Some(lines.found).filter(|found| !found.is_empty());
        found.ok_or_else(|| told("it holds no lines".to_string()))
    }
}

/// Children in such an order that they are taken from the end as they are drawn.
fn children<'a, 'i>(node: &Node<'a, 'i>, placed: Affine) -> Vec<(Node<'a, 'i>, Affine)> {
    let elements = node.children().filter(Node::is_element);
    let mut all: Vec<_> = elements.map(|child| (child, placed)).collect();
    all.reverse();
    all
}

fn hidden(node: &Node<'_, '_>) -> bool {
    let styled = node.attribute("style").is_some_and(|style| {
        let mut rules = style.split(';').filter_map(|rule| rule.split_once(':'));
        rules.any(|(key, value)| key.trim() == "display" && value.trim() == "none")
    });
    styled || node.attribute("display") == Some("none")
}

/// Turns y upwards, from the lower left corner.
fn upright(root: &Node<'_, '_>) -> Result<Affine, String> {
    let flip = Affine::FLIP_Y;
    if let Some(text) = root.attribute("viewBox") {
        let ViewBox { x, y, h, .. } = text.parse().map_err(|e| format!("viewBox: {e}"))?;
        return Ok(flip * Affine::translate((-x, -y - h)));
    }
    match root.attribute("height") {
        Some(text) if !text.trim().ends_with('%') => {
            Ok(flip * Affine::translate((0.0, -length("height", text)?)))
        }
        _ => Ok(flip),
    }
}

fn transform(text: &str) -> Result<Affine, String> {
    let t: Transform = text.parse().map_err(|e| format!("transform: {e}"))?;
    Ok(Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]))
}

/// Largest stretch of a transform.
fn scale(affine: &Affine) -> f64 {
    let [a, b, c, d, ..] = affine.as_coeffs();
    a.hypot(b).hypot(c.hypot(d)).max(f64::MIN_POSITIVE)
}

/// A length in user units, of which an inch has 96.
fn length(name: &str, text: &str) -> Result<f64, String> {
    let Length { number, unit } = text.trim().parse().map_err(|e| format!("{name}: {e}"))?;
    let factor = match unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 96.0 / 2.54,
        LengthUnit::Mm => 96.0 / 25.4,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        _ => return Err(format!("{name}: `{text}` is relative to what is not known")),
    };
    Ok(number * factor)
}

/// The element's own path, if it is one that draws.
fn drawn(node: &Node<'_, '_>, tolerance: f64) -> Result<Option<BezPath>, String> {
    let optional = |name: &str| match node.attribute(name) {
        Some("auto") | None => Ok(None),
        Some(text) => length(name, text).map(Some),
    };
    let number = |name: &str| Ok::<f64, String>(optional(name)?.unwrap_or(0.0));
    let limit = LARGEST / SHARES[0] * tolerance;
    let within = |r: f64| match r.abs() <= limit {
        true => Ok(r),
        false => Err(format!("a length of {r} is out of range for this spacing")),
    };
    Ok(match node.tag_name().name() {
        "path" => {
            let data = node.attribute("d").unwrap_or("");
            Some(path(data, tolerance, limit)?)
        }
        name @ ("polygon" | "polyline") => {
            let mut path = BezPath::new();
            let points = PointsParser::from(node.attribute("points").unwrap_or(""));
            for (k, point) in points.enumerate() {
                match k {
                    0 => path.move_to(point),
                    _ => path.line_to(point),
                }
            }
            if name == "polygon" && path.elements().len() > 1 {
                path.close_path();
            }
            Some(path)
        }
        "line" => {
            let from = (number("x1")?, number("y1")?);
            let to = (number("x2")?, number("y2")?);
            Some(kurbo::Line::new(from, to).to_path(tolerance))
        }
        "rect" => {
            let corner = [number("x")?, number("y")?];
            let size = [within(number("width")?)?, within(number("height")?)?];
            let (rx, ry) = (optional("rx")?, optional("ry")?);
            let rounding = [rx.or(ry), ry.or(rx)].map(|r| r.unwrap_or(0.0));
            let most = |k: usize| rounding[k].clamp(0.0, 0.5 * size[k].abs());
            Some(rectangle(corner, size, [most(0), most(1)], tolerance))
        }
        "circle" => {
            let centre = (number("cx")?, number("cy")?);
            Some(Circle::new(centre, within(number("r")?)?).to_path(tolerance))
        }
        "ellipse" => {
            let centre = (number("cx")?, number("cy")?);
            let radii = (within(number("rx")?)?, within(number("ry")?)?);
            Some(Ellipse::new(centre, radii, 0.0).to_path(tolerance))
        }
        _ => None,
    })
}

/// A rectangle with round corners, drawn as one of circular corners and stretched.
fn rectangle([x, y]: [f64; 2], [w, h]: [f64; 2], [rx, ry]: [f64; 2], tolerance: f64) -> BezPath {
    if rx == 0.0 || ry == 0.0 {
        return kurbo::Rect::new(x, y, x + w, y + h).to_path(tolerance);
    }
    let stretch = ry / rx;
    let plain = RoundedRect::new(0.0, 0.0, w, h / stretch, rx);
    let place = Affine::translate((x, y)) * Affine::scale_non_uniform(1.0, stretch);
    place * plain.to_path(tolerance / stretch.max(1.0))
}

/// Collects flattened paths.
struct Lines {
    tolerance: f64,
    found: Vec<Line>,
    corners: usize,
}

impl Lines {
    fn add(&mut self, path: &BezPath) -> Result<(), String> {
        let limit = LARGEST * self.tolerance;
        let reach = path.control_box();
        let far = [reach.x0, reach.y0, reach.x1, reach.y1];
        let reachable = path.is_finite() && far.iter().all(|c| c.abs() <= limit);
        if !path.is_empty() && !reachable {
            return Err("its coordinates are out of range for this spacing".to_string());
        }
        let near = 1e-6 * self.tolerance;
        let tolerance = SHARES[1] * self.tolerance;
        let (found, corners) = (&mut self.found, &mut self.corners);
        let mut line: Vec<[f64; 2]> = Vec::new();
        let mut end = |line: &mut Vec<[f64; 2]>, closed: bool| {
            let points = std::mem::take(line);
            let tidy = Line { points, closed }.tidied(near);
            found.extend((tidy.points.len() > 1).then_some(tidy));
        };
        let at = |p: Point| [p.x, p.y];
        let mut pen = Point::ZERO;
        // One piece after the other, so that there is an end where there are too many corners.
        for element in path.iter() {
            if *corners > CORNERS {
                break;
            }
            match element {
                PathEl::MoveTo(p) => {
                    end(&mut line, false);
                    line.push(at(p));
                }
                PathEl::ClosePath => end(&mut line, true),
                piece => kurbo::flatten([PathEl::MoveTo(pen), piece], tolerance, |flat| {
                    if let PathEl::LineTo(p) = flat {
                        line.push(at(p));
                        *corners += 1;
                    }
                }),
            }
            pen = element.end_point().unwrap_or(pen);
        }
        end(&mut line, false);
        let why = format!("the drawing has more than {CORNERS} corners at this spacing");
        (self.corners <= CORNERS).then_some(()).ok_or(why)
    }
}

/// The path of the data `M 0 0 L 1 0 A …`, its arcs as cubics within `tolerance`, unless a number is larger than `limit`.
fn path(data: &str, tolerance: f64, limit: f64) -> Result<BezPath, String> {
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

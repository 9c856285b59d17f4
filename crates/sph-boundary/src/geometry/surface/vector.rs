//! Vectors of three numbers.

pub(super) type Point = [f64; 3];

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a + t b.
pub(super) fn along(a: Point, t: f64, b: Point) -> Point {
    [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(super) fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// a / |a|; the zero vector stays what it is.
pub(super) fn unit(a: Point) -> Point {
    let length = norm(a);
    if length > 0.0 {
        a.map(|x| x / length)
    } else {
        a
    }
}

/// Twice the area of a triangle times its normal.
pub(super) fn double_area([a, b, c]: [Point; 3]) -> Point {
    cross(sub(b, a), sub(c, a))
}

/// Lower and upper corner of the box around some points.
pub(super) fn bounds(points: impl IntoIterator<Item = Point>) -> [Point; 2] {
    let nothing = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    points.into_iter().fold(nothing, |[low, high], p| {
        [
            std::array::from_fn(|k| low[k].min(p[k])),
            std::array::from_fn(|k| high[k].max(p[k])),
        ]
    })
}

/// Distance of a point from the segment between two others.
pub(super) fn distance_to_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (t, to) = (sub(b, a), sub(p, a));
    let length2 = dot(t, t);
    let part = if length2 > 0.0 {
        (dot(to, t) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    norm(along(to, -part, t))
}

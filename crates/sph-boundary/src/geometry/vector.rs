//! Vectors of D numbers, and planes.

pub(crate) use sph_core::bounds;

pub(crate) type Point = [f64; 3];

/// The first N of some numbers, with zeros behind them.
#[inline(always)]
pub(crate) fn padded<const N: usize>(numbers: &[f64]) -> [f64; N] {
    std::array::from_fn(|k| numbers.get(k).copied().unwrap_or(0.0))
}

#[inline(always)]
pub(crate) fn add<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] + b[k])
}

#[inline(always)]
pub(crate) fn sub<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// a + t b.
#[inline(always)]
pub(crate) fn along<const D: usize>(a: [f64; D], t: f64, b: [f64; D]) -> [f64; D] {
    std::array::from_fn(|k| a[k] + t * b[k])
}

#[inline(always)]
pub(crate) fn dot<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (1..D).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

#[inline(always)]
pub(crate) fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn norm<const D: usize>(a: [f64; D]) -> f64 {
    dot(a, a).sqrt()
}

/// a / |a|; the zero vector stays.
pub(crate) fn unit<const D: usize>(a: [f64; D]) -> [f64; D] {
    let length = norm(a);
    if length > 0.0 {
        a.map(|x| x / length)
    } else {
        a
    }
}

/// Twice the area of a triangle times its normal.
pub(crate) fn double_area([a, b, c]: [Point; 3]) -> Point {
    cross(sub(b, a), sub(c, a))
}

/// A box with so much room around it.
pub(crate) fn widened<const D: usize>([low, high]: [[f64; D]; 2], by: f64) -> [[f64; D]; 2] {
    [low.map(|x| x - by), high.map(|x| x + by)]
}

/// a × b in the plane.
#[inline(always)]
pub(crate) fn perp<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The part of the way along the segment between two points at which it is nearest to another one, and the way from
/// there to that one.
pub(crate) fn foot_on_edge<const D: usize>(p: [f64; D], [a, b]: [[f64; D]; 2]) -> (f64, [f64; D]) {
    let (t, to) = (sub(b, a), sub(p, a));
    let length2 = dot(t, t);
    let part = if length2 > 0.0 {
        (dot(to, t) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (part, along(to, -part, t))
}

pub(crate) fn distance_to_segment<const D: usize>(p: [f64; D], ends: [[f64; D]; 2]) -> f64 {
    norm(foot_on_edge(p, ends).1)
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    origin: Point,
    axes: [Point; 2],
}

impl Plane {
    /// The plane through a place, m, across a unit normal.
    pub fn new(origin: Point, normal: Point) -> Self {
        // The coordinate axis that is farthest from the normal.
        let mut axis = [0.0; 3];
        let flattest = (0..3).min_by(|i, j| normal[*i].abs().total_cmp(&normal[*j].abs()));
        axis[flattest.unwrap_or(0)] = 1.0;
        Self::along(along(axis, -dot(axis, normal), normal), origin, normal)
    }

    /// The same with the first axis along a direction in it.
    pub fn along(direction: Point, origin: Point, normal: Point) -> Self {
        let first = unit(direction);
        let axes = [first, cross(normal, first)];
        Self { origin, axes }
    }

    /// Coordinates of the foot of the perpendicular from a point, m.
    #[inline]
    pub fn foot(&self, point: Point) -> [f64; 2] {
        self.part(sub(point, self.origin))
    }

    /// The part of a vector in the plane, by its axes.
    #[inline]
    pub fn part(&self, vector: Point) -> [f64; 2] {
        [dot(vector, self.axes[0]), dot(vector, self.axes[1])]
    }

    /// The place with some coordinates, m.
    pub fn place(&self, x: [f64; 2]) -> Point {
        along(along(self.origin, x[0], self.axes[0]), x[1], self.axes[1])
    }
}

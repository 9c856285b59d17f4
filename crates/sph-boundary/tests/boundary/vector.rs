//! Vectors and rotations.

pub type Vector = [f64; 3];

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// a + s b
pub fn plus(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    plus(a, -1.0, b)
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub fn unit(a: Vector) -> Vector {
    a.map(|x| x / norm(a))
}

/// The directed edges around a face as seen from a point.
pub fn edges(face: &[Vector], point: Vector) -> impl Iterator<Item = [Vector; 2]> {
    let next = face.iter().cycle().skip(1);
    face.iter()
        .zip(next)
        .map(move |(a, b)| [*a, *b].map(|c| minus(c, point)))
}

/// The unit normal of a triangle, counter-clockwise.
pub fn normal([a, b, c]: [Vector; 3]) -> Vector {
    unit(cross(minus(b, a), minus(c, a)))
}

/// A turn about the axis (1, 2, −1) by an angle.
pub fn turned(v: Vector, angle: f64) -> Vector {
    let axis = unit([1.0, 2.0, -1.0]);
    let (sin, cos) = angle.sin_cos();
    let along = plus(v.map(|x| x * cos), sin, cross(axis, v));
    plus(along, (1.0 - cos) * dot(axis, v), axis)
}

//! The nearest point of a wall element.

use sph_core::Vect;

/// |x − c|² to the nearest point c of a segment (D = 2) or a triangle (D = 3), m².
pub fn squared_distance<const D: usize>(x: &Vect<D>, corners: &[Vect<D>; D]) -> f64 {
    match corners.as_slice() {
        [a, b] => of_segment(x, a, b),
        [a, b, c] => of_triangle(x, a, b, c),
        _ => f64::INFINITY,
    }
}

fn of_segment<const D: usize>(x: &Vect<D>, a: &Vect<D>, b: &Vect<D>) -> f64 {
    let (along, from) = (b - a, x - a);
    let length = along.norm_squared();
    let share = match length > 0.0 {
        true => (from.dot(&along) / length).clamp(0.0, 1.0),
        false => 0.0,
    };
    (from - along * share).norm_squared()
}

/// The foot on the plane where it lies within the triangle, else the nearest point of an edge.
fn of_triangle<const D: usize>(x: &Vect<D>, a: &Vect<D>, b: &Vect<D>, c: &Vect<D>) -> f64 {
    let (ab, ac, ax) = (b - a, c - a, x - a);
    let [bb, bc, cc] = [ab.dot(&ab), ab.dot(&ac), ac.dot(&ac)];
    let [xb, xc] = [ax.dot(&ab), ax.dot(&ac)];
    let area = bb * cc - bc * bc;
    if area > 0.0 {
        let share = [(cc * xb - bc * xc) / area, (bb * xc - bc * xb) / area];
        if share[0] >= 0.0 && share[1] >= 0.0 && share[0] + share[1] <= 1.0 {
            return (ax - ab * share[0] - ac * share[1]).norm_squared();
        }
    }
    let edges = [(a, b), (b, c), (c, a)];
    let each = edges.map(|(from, to)| of_segment(x, from, to));
    each.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_end_at_their_ends() {
        let segment = [Vect::from([0.0, 0.0]), Vect::from([2.0, 0.0])];
        let at = |x, y| squared_distance(&Vect::from([x, y]), &segment).sqrt();
        assert_eq!(at(1.0, 0.5), 0.5);
        assert_eq!(at(-3.0, 4.0), 5.0);
        assert_eq!(at(5.0, -4.0), 5.0);
    }

    #[test]
    fn triangles_have_a_face_edges_and_corners() {
        let at = |x: [f64; 3]| {
            let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
            squared_distance(&Vect::from(x), &corners.map(Vect::from)).sqrt()
        };
        assert_eq!(at([1.0, 1.0, -2.0]), 2.0);
        assert_eq!(at([2.0, -3.0, 4.0]), 5.0);
        assert!((at([3.0, 3.0, 1.0]) - 3f64.sqrt()).abs() < 1e-15);
        assert_eq!(at([-3.0, 0.0, 4.0]), 5.0);
        // A triangle without an area is its edges.
        let flat = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(Vect::from);
        assert_eq!(squared_distance(&Vect::from([3.0, 0.0, 0.0]), &flat), 1.0);
    }
}

//! The place of a segment or a triangle that is nearest to a point.

type Point<const D: usize> = [f64; D];

/// The nearest part of a segment or triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// A place within.
    Face,
    /// A place on the edge of a triangle from this corner to the next.
    Edge(u8),
    /// This corner.
    Corner(u8),
}

/// The place of a segment (D = 2) or triangle (D = 3) that is nearest to a point, m, and the part on which it lies.
#[inline]
pub fn nearest_place<const D: usize>(
    point: Point<D>,
    corners: &[Point<D>; D],
) -> (Point<D>, Feature) {
    match corners[..] {
        [a, b] => of_segment(point, a, b),
        _ => of_triangle(point, [corners[0], corners[1], corners[D - 1]]),
    }
}

#[inline]
fn of_segment<const D: usize>(
    point: Point<D>,
    start: Point<D>,
    end: Point<D>,
) -> (Point<D>, Feature) {
    let whole = sub(end, start);
    let part = dot(sub(point, start), whole) / dot(whole, whole);
    let feature = match part {
        p if p < 0.0 => Feature::Corner(0),
        p if p > 1.0 => Feature::Corner(1),
        _ => Feature::Face,
    };
    (along(start, part.clamp(0.0, 1.0), whole), feature)
}

/// The regions of a triangle as in Ericson, Real-Time Collision Detection (2005), §5.1.5.
fn of_triangle<const D: usize>(point: Point<D>, [a, b, c]: [Point<D>; 3]) -> (Point<D>, Feature) {
    let (ab, ac) = (sub(b, a), sub(c, a));
    let from = |corner| {
        let to = sub(point, corner);
        (dot(ab, to), dot(ac, to))
    };
    let (d1, d2) = from(a);
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, Feature::Corner(0));
    }
    let (d3, d4) = from(b);
    if d3 >= 0.0 && d4 <= d3 {
        return (b, Feature::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (along(a, d1 / (d1 - d3), ab), Feature::Edge(0));
    }
    let (d5, d6) = from(c);
    if d6 >= 0.0 && d5 <= d6 {
        return (c, Feature::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (along(a, d2 / (d2 - d6), ac), Feature::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let part = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (along(b, part, sub(c, b)), Feature::Edge(1));
    }
    let sum = va + vb + vc;
    let within = along(along(a, vb / sum, ab), vc / sum, ac);
    (within, Feature::Face)
}

#[inline(always)]
fn sub<const D: usize>(a: Point<D>, b: Point<D>) -> Point<D> {
    std::array::from_fn(|k| a[k] - b[k])
}

/// a + t b.
#[inline(always)]
fn along<const D: usize>(a: Point<D>, t: f64, b: Point<D>) -> Point<D> {
    std::array::from_fn(|k| a[k] + t * b[k])
}

#[inline(always)]
fn dot<const D: usize>(a: Point<D>, b: Point<D>) -> f64 {
    (1..D).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest of a fine grid of places is no nearer, and at most half a cell farther.
    #[test]
    fn no_place_is_nearer() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.2, 0.0], [0.3, 0.9, 0.4]];
        let distance = |a: [f64; 3], b: [f64; 3]| dot(sub(a, b), sub(a, b)).sqrt();
        let cells = 200;
        let grid = (0..=cells).flat_map(|i| (0..=cells - i).map(move |j| (i, j)));
        let place = |(i, j): (i32, i32)| {
            let [s, t] = [i, j].map(|k| f64::from(k) / f64::from(cells));
            let first = along(corners[0], s, sub(corners[1], corners[0]));
            along(first, t, sub(corners[2], corners[0]))
        };
        let grid: Vec<_> = grid.map(place).collect();
        let mut features = Vec::new();
        for k in 0..343 {
            let [x, y, z] = [k % 7, k / 7 % 7, k / 49].map(|n| f64::from(n) * 0.4 - 0.9);
            let point = [x, y, z];
            let (found, feature) = nearest_place(point, &corners);
            let sampled = grid.iter().map(|place| distance(*place, point));
            let least = sampled.fold(f64::INFINITY, f64::min);
            let own = distance(found, point);
            assert!(own <= least + 1e-12 && least - own < 0.005, "{point:?}");
            if !features.contains(&feature) {
                features.push(feature);
            }
        }
        assert_eq!(features.len(), 7, "{features:?}");
    }
}

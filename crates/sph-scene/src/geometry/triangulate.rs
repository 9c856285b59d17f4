//! Plane polygons as triangles.

use crate::geometry::polygon::cross;

/// Triangles of a simple polygon whose corners go round anticlockwise, by ear clipping.
///
/// Every corner is used and no triangle is degenerate, so that the neighbours of its edges fit.
pub(crate) fn triangulate(points: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut ring: Vec<usize> = (0..points.len()).collect();
    let mut triangles = Vec::with_capacity(points.len().saturating_sub(2));
    let (mut at, mut waited) = (0, 0);
    while ring.len() >= 3 {
        let n = ring.len();
        let corner = [at + n - 1, at, at + 1].map(|k| ring[k % n]);
        // A polygon whose rounding hides its last ears is cut all the same.
        if waited > n || is_ear(points, &ring, corner) {
            triangles.push(corner);
            ring.remove(at % n);
            waited = 0;
            at = if at < ring.len() { at } else { 0 };
        } else {
            at = (at + 1) % n;
            waited += 1;
        }
    }
    triangles
}

fn is_ear(points: &[[f64; 2]], ring: &[usize], [a, b, c]: [usize; 3]) -> bool {
    let [pa, pb, pc] = [a, b, c].map(|k| points[k]);
    if cross(pa, pb, pc) <= 0.0 {
        return false;
    }
    let sides = [(pa, pb), (pb, pc), (pc, pa)];
    let within = |x: [f64; 2]| sides.iter().all(|(p, q)| cross(*p, *q, x) >= 0.0);
    let mut others = ring.iter().filter(|k| ![a, b, c].contains(k));
    !others.any(|k| within(points[*k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn areas(points: &[[f64; 2]]) -> Vec<f64> {
        let area = |t: &[usize; 3]| 0.5 * cross(points[t[0]], points[t[1]], points[t[2]]);
        triangulate(points).iter().map(area).collect()
    }

    #[test]
    fn a_comb_with_corners_on_its_edges_is_cut_without_slivers() {
        let back = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [4.0, 0.0]];
        let right = [[4.0, 3.0], [3.0, 3.0], [3.0, 1.0], [2.0, 1.0]];
        let left = [[1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let comb = [&back[..], &right, &left].concat();
        let areas = areas(&comb);
        assert_eq!(areas.len(), comb.len() - 2);
        assert!(areas.iter().all(|a| *a > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - 8.0).abs() < 1e-12);
    }
}

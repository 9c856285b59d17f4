//! Volume, centre and inertia of the volume that walls enclose, and of the fluid next to it.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use nalgebra::{Matrix3, Matrix6, Vector3};

use crate::bodies::spatial_vector::{padded, six};
use crate::{BoundaryError, Drawing, Polyline, Result, Surface};

/// A solid of density 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Volume, m³ (area, m², in two dimensions).
    pub volume: f64,
    /// Centre, m.
    pub centre: Vector3<f64>,
    /// ∫ (r² I − r rᵀ) dV about the centre, m⁵; in two dimensions only the last entry, ∫ r² dA, m⁴.
    pub inertia: Matrix3<f64>,
}

const OPEN: &str = "the wall is open: it encloses no volume";
const FLAT: &str = "the wall encloses no volume";
const VESSEL: &str =
    "the fluid is inside of it, which makes it a vessel: a body has `fluid = \"outside\"`";

fn no_solid(why: &str) -> Result<()> {
    Err(BoundaryError(why.into()))
}

/// Moments of pieces: volume, first and second moments about the origin.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    volume: f64,
    size: f64,
    first: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Moments {
    fn add(&mut self, corners: &[Vector3<f64>], volume: f64) {
        let n = corners.len() as f64;
        self.volume += volume;
        self.size += volume.abs();
        let whole = corners[1..].iter().fold(corners[0], |sum, c| sum + c);
        self.first += whole * (volume / (n + 1.0));
        let square = |c: &Vector3<f64>| c * c.transpose();
        let more = corners[1..].iter();
        let own = more.fold(square(&corners[0]), |sum, c| sum + square(c));
        self.second += (own + square(&whole)) * (volume / ((n + 1.0) * (n + 2.0)));
    }
}

impl Solid {
    /// Of the pieces of one wall; the fluid is outside of it.
    ///
    /// By the divergence theorem: sums over triangles (origin, edge) and tetrahedra (origin, facet).
    ///
    /// # Errors
    /// If they enclose nothing.
    pub fn from_pieces<'a>(pieces: impl IntoIterator<Item = &'a Drawing>) -> Result<Self> {
        let mut sum = Moments::default();
        let mut flat = true;
        for piece in pieces {
            match piece {
                Drawing::Line(line) => add_line(&mut sum, line)?,
                Drawing::Surface(surface) => {
                    flat = false;
                    add_surface(&mut sum, surface)?;
                }
            }
        }
        if sum.volume.abs() <= 1e-12 * sum.size {
            no_solid(FLAT)?;
        }
        if sum.volume < 0.0 {
            no_solid(VESSEL)?;
        }
        let centre = sum.first / sum.volume;
        let about = sum.second - centre * centre.transpose() * sum.volume;
        let mut inertia = Matrix3::identity() * about.trace() - about;
        if flat {
            inertia = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, inertia[(2, 2)]));
        }
        Ok(Solid {
            volume: sum.volume,
            centre,
            inertia,
        })
    }
}

/// Winding number of the pieces of one wall around a place: 1 inside of a body, −1 inside of a vessel, 0 outside of
/// both.
pub(crate) fn winding<'a>(pieces: impl IntoIterator<Item = &'a Drawing>, x: Vector3<f64>) -> f64 {
    let from = |p: &[f64]| padded(p) - x;
    let around = |piece: &Drawing| match piece {
        Drawing::Line(line) => {
            let turn = |ends: [[f64; 2]; 2]| {
                let [b, a] = ends.map(|p| from(&p));
                a.cross(&b).z.atan2(a.dot(&b)) / TAU
            };
            line.edges().map(turn).sum::<f64>()
        }
        Drawing::Surface(surface) => {
            // Half of a solid angle, van Oosterom & Strackee 1983.
            let angle = |triangle: &[u32; 3]| {
                let [a, b, c] = triangle.map(|k| from(&surface.points[k as usize]));
                let [p, q, r] = [a, b, c].map(|v| v.norm());
                let below = p * q * r + a.dot(&b) * r + b.dot(&c) * p + c.dot(&a) * q;
                a.dot(&b.cross(&c)).atan2(below) / TAU
            };
            surface.triangles.iter().map(angle).sum()
        }
    };
    pieces.into_iter().map(around).sum()
}

fn add_line(sum: &mut Moments, line: &Polyline) -> Result<()> {
    if !line.closed {
        return no_solid(OPEN);
    }
    for [a, b] in line.edges() {
        // The fluid is on the left of travel, so the body is gone round clockwise.
        let [a, b] = [b, a].map(|p| padded(&p));
        sum.add(&[a, b], 0.5 * (a.x * b.y - a.y * b.x));
    }
    Ok(())
}

fn add_surface(sum: &mut Moments, surface: &Surface) -> Result<()> {
    let edges = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let bits = |c: u32| surface.points[c as usize].map(|x| (x + 0.0).to_bits());
    let all = surface.triangles.iter().flat_map(edges);
    let directed: BTreeSet<_> = all.map(|e| e.map(bits)).collect();
    if directed.iter().any(|[a, b]| !directed.contains(&[*b, *a])) {
        return no_solid(OPEN);
    }
    for triangle in &surface.triangles {
        // Anticlockwise seen from the fluid: outwards.
        let [a, b, c] = triangle.map(|k| Vector3::from(surface.points[k as usize]));
        sum.add(&[a, b, c], a.dot(&b.cross(&c)) / 6.0);
    }
    Ok(())
}

/// A* = ρ h Σ ∫ j jᵀ dS with j = (n, (x − c) × n): the inertia of a layer of fluid one smoothing length h thick that goes
/// with the surface along its normal n.
pub(crate) fn layer<'a>(
    pieces: impl IntoIterator<Item = &'a Drawing>,
    centre: Vector3<f64>,
    density: f64,
    smoothing_length: f64,
) -> Matrix6<f64> {
    let mut sum = Matrix6::zeros();
    let mut add = |x: Vector3<f64>, weighted_normal: Vector3<f64>| {
        let area = weighted_normal.norm();
        if area > 0.0 {
            let normal = weighted_normal / area;
            let j = six(normal, (x - centre).cross(&normal));
            sum += j * j.transpose() * (area * density * smoothing_length);
        }
    };
    for piece in pieces {
        match piece {
            Drawing::Line(line) => {
                for [a, b] in line.edges() {
                    let [a, b] = [a, b].map(|p| padded(&p));
                    let along = b - a;
                    let normal = Vector3::new(-along.y, along.x, 0.0) * 0.5;
                    // Two points are exact for squares of the arm.
                    for s in [-1.0, 1.0].map(|k| 0.5 + k * 0.5 / 3.0_f64.sqrt()) {
                        add(a + along * s, normal);
                    }
                }
            }
            Drawing::Surface(surface) => {
                for triangle in &surface.triangles {
                    let [a, b, c] = triangle.map(|k| Vector3::from(surface.points[k as usize]));
                    let normal = (b - a).cross(&(c - a)) / 6.0;
                    // The middles of the edges are exact, too.
                    for x in [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5] {
                        add(x, normal);
                    }
                }
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::surface::boxed;

    fn rectangle(reversed: bool, closed: bool) -> Drawing {
        let mut points = vec![[1.0, 2.0], [1.0, 3.0], [3.0, 3.0], [3.0, 2.0]];
        if reversed {
            points.reverse();
        }
        Drawing::Line(Polyline {
            name: "r".into(),
            points,
            closed,
        })
    }

    #[test]
    fn a_rectangle_and_a_box_have_their_moments_to_rounding() {
        let solid = Solid::from_pieces([&rectangle(false, true)]).unwrap();
        assert!((solid.volume - 2.0).abs() < 1e-14);
        assert!((solid.centre - Vector3::new(2.0, 2.5, 0.0)).norm() < 1e-14);
        // A (a² + b²)/12
        assert!((solid.inertia[(2, 2)] - 2.0 * 5.0 / 12.0).abs() < 1e-13);
        let cuboid = boxed("box", [1.0, 2.0, -1.0], [3.0, 5.0, 3.0]);
        let solid = Solid::from_pieces([&Drawing::Surface(cuboid)]).unwrap();
        assert!((solid.volume - 24.0).abs() < 1e-12);
        assert!((solid.centre - Vector3::new(2.0, 3.5, 1.0)).norm() < 1e-13);
        let expected = Vector3::new(9.0 + 16.0, 4.0 + 16.0, 4.0 + 9.0) * 2.0;
        let off = solid.inertia - Matrix3::from_diagonal(&expected);
        assert!(off.norm() < 1e-11, "{off}");
    }

    #[test]
    fn windings_tell_bodies_from_vessels() {
        let at = |reversed: bool, x: f64| {
            winding([&rectangle(reversed, true)], Vector3::new(x, 2.5, 0.0))
        };
        for (reversed, x, expected) in [(false, 2.0, 1.0), (true, 2.0, -1.0), (false, 0.5, 0.0)] {
            assert!((at(reversed, x) - expected).abs() < 1e-12);
        }
        let solid = [&Drawing::Surface(boxed("box", [0.0; 3], [1.0, 2.0, 3.0]))];
        for (x, expected) in [(0.2, 1.0), (-0.2, 0.0)] {
            let around = winding(solid, Vector3::new(x, 0.7, 1.9));
            assert!((around - expected).abs() < 1e-12, "{around}");
        }
    }

    #[test]
    fn vessels_lines_and_lids_are_no_solids() {
        let mut open = boxed("box", [0.0; 3], [1.0; 3]);
        open.triangles.truncate(10);
        let plate = Polyline::closed("p", vec![[0.0, 0.0], [1.0, 0.0]]);
        for (drawing, why) in [
            (rectangle(true, true), VESSEL),
            (rectangle(false, false), OPEN),
            (Drawing::Surface(open), OPEN),
            (Drawing::Line(plate), FLAT),
        ] {
            assert_eq!(Solid::from_pieces([&drawing]).unwrap_err().0, why);
        }
    }

    /// Of a square of side a about its centre: 2 ρ h a along each axis, ρ h 4 ∫ s² ds = ρ h a³/3 about it.
    #[test]
    fn the_layer_of_a_square_has_its_inertia() {
        let corners = vec![[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];
        let square = Drawing::Line(Polyline::closed("s", corners));
        let layer = layer([&square], Vector3::new(2.0, 2.0, 0.0), 1000.0, 0.1);
        let expected = [400.0, 400.0, 0.0, 0.0, 0.0, 100.0 * 8.0 / 3.0];
        for i in 0..6 {
            for k in 0..6 {
                let want = if i == k { expected[i] } else { 0.0 };
                assert!((layer[(i, k)] - want).abs() < 1e-10, "{layer}");
            }
        }
    }
}

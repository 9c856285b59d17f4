//! Surfaces of shapes in space, their normals pointing outwards, and the division of curved ones.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use scene_text::surface::{Facets, Welder, cross, dot, minus};
use sph_core::Axis;

use crate::geometry::polygon::{Polygon, triangulate};
use crate::geometry::vector::{array, unit};
use crate::tables::wall::Face;

/// A box without the faces in `open`.
pub(crate) fn cuboid(lo: [f64; 3], hi: [f64; 3], open: &[Face]) -> Facets {
    let mut surface = Welder::default();
    let kept =
        |axis: usize, upper: bool| !open.iter().any(|f| (f.axis(), f.upper()) == (axis, upper));
    let all = (0..3).flat_map(|axis| [(axis, false), (axis, true)]);
    for (k, upper) in all.filter(|(axis, upper)| kept(*axis, *upper)) {
        let (u, v) = ((k + 1) % 3, (k + 2) % 3);
        let corner = |[right, top]: [bool; 2]| {
            let mut x = if upper { hi } else { lo };
            x[u] = if right { hi[u] } else { lo[u] };
            x[v] = if top { hi[v] } else { lo[v] };
            x
        };
        let round = [[false, false], [true, false], [true, true], [false, true]];
        let mut corners = round.map(corner);
        if !upper {
            corners.reverse();
        }
        surface.fan(&corners);
    }
    surface.finish()
}

/// A cosine or sine of which rounding does not tilt a face that stands along an axis: a quarter turn is exact.
pub(crate) fn clean(c: f64) -> f64 {
    if c.abs() < 1e-15 { 0.0 } else { c }
}

/// Corners of a regular polygon about the origin, the first at an angle of `turn`.
pub(crate) fn ring(radius: f64, sides: usize, turn: f64) -> Vec<[f64; 2]> {
    let corner = |k: usize| {
        let angle = turn + TAU * k as f64 / sides as f64;
        [radius * clean(angle.cos()), radius * clean(angle.sin())]
    };
    (0..sides).map(corner).collect()
}

/// A ring in space, right-handed about `axis`: as shifts from its centre.
fn ring_about(axis: &[f64; 3], flat: &[[f64; 2]]) -> Vec<[f64; 3]> {
    let d: [f64; 3] = array(&unit(axis).unwrap_or_default());
    let axes = (0..3).rev();
    let main = axes.max_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs()));
    let mut first = [0.0; 3];
    first[(main.unwrap_or(2) + 1) % 3] = 1.0;
    let along = dot(&first, &d);
    let across: [f64; 3] = std::array::from_fn(|k| first[k] - along * d[k]);
    let first: [f64; 3] = array(&unit(&across).unwrap_or_default());
    let second = cross(&d, &first);
    let shift = |p: &[f64; 2]| std::array::from_fn(|k| p[0] * first[k] + p[1] * second[k]);
    flat.iter().map(shift).collect()
}

fn shifted(x: &[f64; 3], shifts: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let shift = |s: &[f64; 3]| std::array::from_fn(|k| x[k] + s[k]);
    shifts.iter().map(shift).collect()
}

/// The numbers of the corners of a ring, each with the next.
fn sides(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).map(move |k| (k, (k + 1) % count))
}

/// A prism over a ring between two points.
pub(crate) fn cylinder(from: [f64; 3], to: [f64; 3], flat: &[[f64; 2]], open_ends: bool) -> Facets {
    let shifts = ring_about(&minus(&to, &from), flat);
    let [mut bottom, top] = [from, to].map(|end| shifted(&end, &shifts));
    let mut surface = Welder::default();
    for (k, next) in sides(flat.len()) {
        surface.fan(&[bottom[k], bottom[next], top[next], top[k]]);
    }
    if !open_ends {
        surface.fan(&top);
        bottom.reverse();
        surface.fan(&bottom);
    }
    surface.finish()
}

pub(crate) fn cone(base: [f64; 3], apex: [f64; 3], flat: &[[f64; 2]]) -> Facets {
    let shifts = ring_about(&minus(&apex, &base), flat);
    let mut bottom = shifted(&base, &shifts);
    let mut surface = Welder::default();
    for (k, next) in sides(flat.len()) {
        surface.triangle([bottom[k], bottom[next], apex]);
    }
    bottom.reverse();
    surface.fan(&bottom);
    surface.finish()
}

/// A polygon of the two coordinates across `axis`, drawn out between two planes.
pub(crate) fn extrusion(
    polygon: &[[f64; 2]],
    axis: Axis,
    ends: [f64; 2],
    open_ends: bool,
) -> Facets {
    // The plane (x, z) is left-handed about y: it is taken as (z, x).
    let mirrored = axis == Axis::Y;
    let mut flat: Vec<[f64; 2]> = match mirrored {
        true => polygon.iter().map(|p| [p[1], p[0]]).collect(),
        false => polygon.to_vec(),
    };
    if Polygon::new(flat.clone()).area() < 0.0 {
        flat.reverse();
    }
    let place = |p: &[f64; 2], at: f64| match axis {
        Axis::X => [at, p[0], p[1]],
        Axis::Y => [p[1], at, p[0]],
        Axis::Z => [p[0], p[1], at],
    };
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let mut surface = Welder::default();
    for (k, next) in sides(flat.len()) {
        let (a, b) = (&flat[k], &flat[next]);
        surface.fan(&[place(a, low), place(b, low), place(b, high), place(a, high)]);
    }
    if !open_ends {
        for [a, b, c] in triangulate(&flat) {
            surface.triangle([a, b, c].map(|k| place(&flat[k], high)));
            surface.triangle([c, b, a].map(|k| place(&flat[k], low)));
        }
    }
    surface.finish()
}

/// An icosahedron of which every edge has `parts` parts, drawn onto a sphere.
pub(crate) fn sphere(centre: [f64; 3], radius: f64, parts: usize) -> Facets {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::with_capacity(12);
    for (a, b) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let (a, b) = (a, b * golden);
        corners.extend([[0.0, a, b], [b, 0.0, a], [a, b, 0.0]]);
    }
    let mut facets = Facets::default();
    let mut known: HashMap<Vec<(usize, usize)>, u32> = HashMap::new();
    for face in icosahedron(&corners) {
        let mut point = |i: usize, j: usize| {
            let mut weights: Vec<_> = face.into_iter().zip([parts - i - j, i, j]).collect();
            weights.retain(|(_, w)| *w > 0);
            weights.sort_unstable();
            let along = |(n, w): &(usize, usize), k: usize| *w as f64 * corners[*n][k];
            let flat: [f64; 3] = std::array::from_fn(|k| weights.iter().map(|w| along(w, k)).sum());
            *known.entry(weights).or_insert_with(|| {
                let away = dot(&flat, &flat).sqrt();
                let x = std::array::from_fn(|k| centre[k] + radius * flat[k] / away);
                facets.points.push(x);
                facets.points.len() as u32 - 1
            })
        };
        for i in 0..parts {
            for j in 0..parts - i {
                let (a, b, c) = (point(i, j), point(i + 1, j), point(i, j + 1));
                facets.triangles.push([a, b, c]);
                if i + j + 2 <= parts {
                    facets.triangles.push([b, point(i + 1, j + 1), c]);
                }
            }
        }
    }
    facets
}

/// The twenty faces: triples of corners at the distance 2 of neighbours.
fn icosahedron(corners: &[[f64; 3]]) -> Vec<[usize; 3]> {
    let near = |i: usize, j: usize| {
        let edge = minus(&corners[i], &corners[j]);
        (dot(&edge, &edge) - 4.0).abs() < 1e-9
    };
    let mut faces = Vec::with_capacity(20);
    for i in 0..12 {
        for j in i + 1..12 {
            for k in (j + 1..12).filter(|&k| near(i, j) && near(j, k) && near(i, k)) {
                let [a, b, c] = [corners[i], corners[j], corners[k]];
                let outward = dot(&a, &cross(&b, &c)) > 0.0;
                faces.push(if outward { [i, j, k] } else { [i, k, j] });
            }
        }
    }
    faces
}

/// Largest distance of an edge from the curve, in spacings.
const SAGITTA: f64 = 0.02;
/// Shortest edge, in spacings.
const SHORTEST: f64 = 0.5;

/// Sides of a circle of `radius` spacings: of one spacing, or shorter where the curve asks for
/// it, but not shorter than half a spacing.
fn sides_of_circle(radius: f64) -> usize {
    let near = (TAU * radius).round();
    let fine = (PI / (1.0 - (SAGITTA / radius).min(1.0)).acos()).ceil();
    let most = (PI / (0.5 * SHORTEST / radius).min(1.0).asin()).floor();
    near.max(fine).min(most).clamp(6.0, 1e5) as usize
}

/// The same where the scene leaves the number of sides open; `radius` and `spacing` in m.
pub(crate) fn sides_of(given: Option<usize>, radius: f64, spacing: f64) -> usize {
    given.unwrap_or_else(|| sides_of_circle(radius / spacing))
}

/// Parts of every edge of the icosahedron around a sphere of `radius` spacings, by the same rule.
///
/// Of n parts the shortest edge is 0.894/n radii long, the longest 1.323/n and the mean 1.107/n;
/// the middle of the largest triangle is 0.292/n² radii below the sphere.
pub(crate) fn subdivisions(radius: f64) -> usize {
    let near = (1.107 * radius).round();
    let fine = (0.292 * radius / SAGITTA).sqrt().ceil();
    let most = (0.894 * radius / SHORTEST).floor();
    near.max(fine).min(most).clamp(1.0, 500.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(surface: &Facets, volume: f64, within: f64) {
        let topology = surface.topology();
        assert!(topology.openings.is_empty() && topology.flipped.is_empty());
        let found = surface.volume();
        let near = (found - volume).abs() <= within * volume;
        assert!(near, "{found} {volume}");
    }

    #[test]
    fn shapes_are_closed_and_face_outwards() {
        closed(&cuboid([1.0; 3], [2.0, 3.0, 4.0], &[]), 6.0, 1e-14);
        assert_eq!(cuboid([0.0; 3], [1.0; 3], &[]).triangles.len(), 12);
        let flat = ring(0.5, 400, 0.1);
        let aligned = [[0.0, 0.0, 3.0], [-3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
        for to in aligned.into_iter().chain([[1.0, 2.0, -2.0]]) {
            closed(&cylinder([0.0; 3], to, &flat, false), 0.75 * PI, 1e-3);
            closed(&cone([0.0; 3], to, &flat), 0.25 * PI, 1e-3);
        }
        let ball = sphere([5.0, 1.0, -2.0], 2.0, 12);
        closed(&ball, 4.0 / 3.0 * PI * 8.0, 0.02);
        assert_eq!(ball.triangles.len(), 20 * 144);
        assert_eq!(ball.points.len(), 10 * 144 + 2);
        let low = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
        let corners = [low, [[1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]].concat();
        let back: Vec<_> = corners.iter().rev().copied().collect();
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            for ends in [[0.5, 2.5], [2.5, 0.5]] {
                closed(&extrusion(&corners, axis, ends, false), 6.0, 1e-14);
                closed(&extrusion(&back, axis, ends, false), 6.0, 1e-14);
            }
        }
    }

    #[test]
    fn a_square_cylinder_has_its_first_corner_where_the_turn_says() {
        let prism = cylinder([0.0; 3], [0.0, 0.0, 1.0], &ring(1.0, 4, 0.0), false);
        assert_eq!(prism.points[0], [1.0, 0.0, 0.0]);
        let prism = cylinder([0.0; 3], [0.0, 1.0, 0.0], &ring(1.0, 4, 0.0), false);
        assert_eq!(prism.points[0], [0.0, 0.0, 1.0]);
    }

    #[test]
    fn edges_of_a_sphere_are_as_long_as_the_rule_for_its_parts_says() {
        let parts = 40;
        let ball = sphere([0.0; 3], 1.0, parts);
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for corners in ball.triangles.iter().map(|t| ball.corners(t)) {
            for k in 0..3 {
                let edge = minus(&corners[k], &corners[(k + 1) % 3]);
                let length = dot(&edge, &edge).sqrt() * parts as f64;
                (least, most) = (least.min(length), most.max(length));
            }
        }
        let near = (0.88..0.92).contains(&least) && (1.29..1.33).contains(&most);
        assert!(near, "{least} {most}");
    }

    #[test]
    fn circles_are_round_and_their_sides_not_short() {
        for radius in [2.0, 3.0, 7.0, 40.0, 1000.0] {
            let n = sides_of_circle(radius) as f64;
            let sagitta = radius * (1.0 - (PI / n).cos());
            let edge = 2.0 * radius * (PI / n).sin();
            let round = sagitta < 0.0201 && edge > 0.499;
            assert!(round, "{radius}: {sagitta} {edge}");
        }
        assert_eq!(sides_of_circle(40.0), 251);
        assert_eq!(sides_of_circle(0.1), 6);
        assert_eq!(sides_of_circle(1e9), 100_000);
        assert_eq!(subdivisions(1e9), 500);
    }
}

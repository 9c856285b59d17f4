//! Points on faces, edges and corners, and at any distance from them.

use sph_kernels::PiecewisePolynomial;

use super::corners::on_line;
use super::planes::excess;
use super::solid::Solid;
use super::{TOLERANCE, assert_within, kernels};
use crate::random::Random;
use crate::vector::{Vector, plus, turned};

const OFFSETS: [f64; 17] = [
    0.0, 1e-16, -1e-16, 1e-14, -1e-14, 1e-12, -1e-12, 1e-11, 1e-10, -1e-10, 1e-9, -1e-9, 1e-8,
    -1e-7, 1e-5, -1e-4, 1e-3,
];

/// γ where `count` right-angled faces meet, at small signed distances from them, and infinite
/// from the others: expanded in planes, edges and the corner.
fn orthant(shape: &PiecewisePolynomial, at: &[f64]) -> f64 {
    let p: Vec<f64> = at.iter().map(|x| excess(shape, *x)).collect();
    let line = on_line(shape, 0.0);
    match *at {
        [_] => 0.5 + p[0],
        [x, y] => 0.25 + 0.5 * (p[0] + p[1]) + line * x * y,
        [x, y, z] => {
            let edges = 0.5 * line * (x * y + y * z + z * x);
            let corner = shape.normalisation(3) * shape.value(0.0) * x * y * z;
            0.125 + 0.25 * (p[0] + p[1] + p[2]) + edges + corner
        }
        _ => unreachable!("one to three faces"),
    }
}

/// Pairs of offsets below 10⁻⁶.
fn small() -> impl Iterator<Item = [f64; 2]> {
    let offsets = || OFFSETS.into_iter().filter(|x| x.abs() < 1e-6);
    offsets().flat_map(move |x| offsets().map(move |y| [x, y]))
}

/// Turned by nothing and by a generic angle.
fn both(faces: impl Fn() -> Vec<Vec<Vector>>) -> [(f64, Solid); 2] {
    [0.0, 1.1].map(|angle| (angle, Solid::mapped(faces(), |v| turned(v, angle))))
}

#[test]
fn faces_edges_and_corners_of_a_room() {
    let rooms = both(|| Solid::box_of([[0.0, 8.0]; 3]));
    for (kernel, of) in kernels() {
        let shape = kernel.shape();
        let mut worst: f64 = 0.0;
        let mut check = |exact: f64, point: Vector| {
            for (angle, room) in &rooms {
                let at = turned(point, *angle);
                for sum in [room.at(&of, at), room.at_by_triangles(&of, at)] {
                    worst = worst.max((sum.gamma() - exact).abs());
                }
            }
        };
        for x in OFFSETS {
            // On the diagonal of a face too, where its triangles meet.
            check(orthant(shape, &[x]), [x, 4.0, 4.0]);
            check(orthant(shape, &[x]), [x, 3.3, 4.4]);
            for y in OFFSETS {
                check(orthant(shape, &[x, y]), [x, y, 4.0]);
                for z in OFFSETS.into_iter().step_by(2) {
                    check(orthant(shape, &[x, y, z]), [x, y, z]);
                }
            }
        }
        // The expansion leaves out x³ y, 10⁻¹².
        assert_within(&kernel, worst, TOLERANCE);
    }
}

#[test]
fn the_gradient_of_a_room() {
    let rooms = both(|| Solid::box_of([[0.0, 8.0]; 3]));
    for (kernel, of) in kernels() {
        let shape = kernel.shape();
        let (plane, line) = (super::planes::slope(shape, 0.0), on_line(shape, 0.0));
        let mut worst: f64 = 0.0;
        for [x, y] in small() {
            for (angle, room) in &rooms {
                let sum = room.at(&of, turned([x, y, 4.0], *angle));
                let exact = [0.5 * plane + line * y, 0.5 * plane + line * x, 0.0];
                let difference = plus(sum.gradient, -1.0, turned(exact, *angle));
                worst = difference.iter().fold(worst, |worst, x| worst.max(x.abs()));
            }
        }
        assert_within(&kernel, worst, TOLERANCE);
    }
}

#[test]
fn a_reentrant_edge_and_where_it_ends() {
    let blocks = both(|| Solid::l_block(8.0));
    for (kernel, of) in kernels() {
        let shape = kernel.shape();
        let mut worst: f64 = 0.0;
        for x in OFFSETS {
            for y in OFFSETS {
                // Outside is the quadrant x, y > 0.
                let solid = orthant(shape, &[x, y]);
                for (angle, block) in &blocks {
                    let sum = block.at(&of, turned([x, y, 0.0], *angle));
                    worst = worst.max((sum.gamma() - (1.0 - solid)).abs());
                    // At the floor z = −8 the fluid is the half space without an octant.
                    for z in [0.0, 1e-16, 1e-10, -1e-10, 1e-5] {
                        let exact = orthant(shape, &[z]) - orthant(shape, &[x, y, z]);
                        let sum = block.at(&of, turned([x, y, -8.0 + z], *angle));
                        worst = worst.max((sum.gamma() - exact).abs());
                    }
                }
            }
        }
        assert_within(&kernel, worst, TOLERANCE);
    }
}

/// Corners off their planes by 10⁻⁷, as in a file of single-precision numbers.
#[test]
fn faces_need_not_be_quite_planar() {
    let mut random = Random(11);
    let mut moved: Vec<(Vector, Vector)> = Vec::new();
    let room = Solid::mapped(Solid::box_of([[0.0, 8.0]; 3]), |v| {
        if let Some((_, to)) = moved.iter().find(|(from, _)| *from == v) {
            return *to;
        }
        let to = plus(v, 1.0, random.vector(1e-7));
        moved.push((v, to));
        to
    });
    for (kernel, of) in kernels() {
        let mut worst: f64 = 0.0;
        for [x, y] in small() {
            for (point, exact) in [
                ([x, 4.0, 4.0], 0.5),
                ([x, y, 4.0], 0.25),
                ([x, y, 0.0], 0.125),
                ([x, y, 1e-7], 0.125),
            ] {
                for sum in [room.at(&of, point), room.at_by_triangles(&of, point)] {
                    worst = worst.max((sum.gamma() - exact).abs());
                }
            }
        }
        assert_within(&kernel, worst, 1e-6);
    }
}

/// One face of a room with each of its edges in three parts, unlike the faces beside it: touching
/// points pay for it with the rounding of coordinates over the displacement.
#[test]
fn edges_may_be_cut_on_one_side() {
    let mut faces = Solid::box_of([[0.0, 8.0]; 3]);
    let floor = &mut faces[4];
    let cut = |i: usize| {
        let (a, b) = (floor[i], floor[(i + 1) % 4]);
        let at = |t: f64| plus(a.map(|x| (1.0 - t) * x), t, b);
        [a, at(0.3), at(0.63)]
    };
    *floor = (0..4).flat_map(cut).collect();
    let room = Solid::mapped(faces, |v| turned(v, 1.1));
    for (kernel, of) in kernels() {
        let mut worst: f64 = 0.0;
        for x in OFFSETS {
            for z in OFFSETS {
                for y in [2.4, 4.0, 5.04, 4.9] {
                    let exact = orthant(kernel.shape(), &[x, z]);
                    let sum = room.at(&of, turned([x, y, z], 1.1));
                    worst = worst.max((sum.gamma() - exact).abs());
                }
            }
        }
        assert_within(&kernel, worst, 3e-5);
    }
}

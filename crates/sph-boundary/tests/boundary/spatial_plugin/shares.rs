//! What the wall points stand for: θ times their part of the wall.

use sph_boundary::WallSpec;
use sph_core::Vect;

use crate::bench::{Bench, wide};
use crate::close;
use crate::spatial_plugin::shapes::{block, tank, wall};

const SPACING: f64 = 0.25;
/// Spacings along an edge of the box.
const N: usize = 8;

fn boxed(surface: sph_boundary::Surface) -> Bench<3> {
    let walls = [WallSpec::at_rest(wall(surface))];
    Bench::new("usaw", &walls, SPACING, wide(), vec![Vect::repeat(1.0)])
}

/// How many coordinates are on a face of the box.
fn faces(x: &Vect<3>) -> usize {
    let size = N as f64 * SPACING;
    x.iter().filter(|c| **c == 0.0 || **c == size).count()
}

fn sums(bench: &Bench<3>) -> [(usize, f64); 4] {
    let points = &bench.world.walls.points;
    let mut sums = [(0, 0.0); 4];
    for (x, share) in points.position.iter().zip(&points.share) {
        let sum = &mut sums[faces(x)];
        (sum.0, sum.1) = (sum.0 + 1, sum.1 + share);
    }
    sums
}

#[test]
fn in_a_box_faces_have_a_half_edges_a_quarter_and_corners_an_eighth_of_three_quarters() {
    let size = N as f64 * SPACING;
    let bench = boxed(tank([0.0; 3], [size; 3]));
    let points = &bench.world.walls.points;
    for (x, share) in points.position.iter().zip(&points.share) {
        // A corner has three quarters of a square of wall.
        let expected = [0.5, 0.25, 0.125 * 0.75][faces(x) - 1];
        close(*share, expected, 1e-14, x);
    }
    let [inside, flat, edge, corner] = sums(&bench);
    let n = N - 1;
    let counts = [inside, flat, edge, corner].map(|sum| sum.0);
    assert_eq!(counts, [0, 6 * n * n, 12 * n, 8]);
}

/// The cells of free particles inside and the shares on the wall fill the box.
#[test]
fn free_cells_and_shares_fill_the_box_but_for_a_quarter_of_a_cell_at_its_corners() {
    let size = N as f64 * SPACING;
    let sums = sums(&boxed(tank([0.0; 3], [size; 3])));
    let total: f64 = sums.iter().map(|s| s.1).sum();
    let cells = (N as f64).powi(3) - (N as f64 - 1.0).powi(3);
    // Eight corners with 3/32 instead of 1/8.
    close(total, cells - 0.25, 1e-12, "in all");
}

#[test]
fn around_a_block_edges_have_three_quarters_and_corners_seven_eighths_of_three_quarters() {
    let size = N as f64 * SPACING;
    let [_, flat, edge, corner] = sums(&boxed(block("block", [0.0; 3], [size; 3])));
    let per_point = |(count, sum): (usize, f64)| sum / count as f64;
    close(per_point(flat), 0.5, 1e-14, "faces");
    close(per_point(edge), 0.75, 1e-14, "edges");
    close(per_point(corner), 0.875 * 0.75, 1e-14, "corners");
}

//! What the wall points stand for: θ times their part of the wall.

use sph_boundary::{Surface, WallSpec};
use sph_core::Vect;

use crate::bench::{Bench, wide};
use crate::close;
use crate::spatial_plugin::shapes::{block, tank, wall};

const SPACING: f64 = 0.25;
/// Spacings along an edge of the box.
const N: usize = 8;

/// Edge of the box, m.
const SIZE: f64 = N as f64 * SPACING;

/// Checks the shares of points on faces, edges and corners of a box; returns their sum.
fn sum_of(surface: Surface, shares: [f64; 3]) -> f64 {
    let walls = [WallSpec::at_rest(wall(surface))];
    let far = vec![Vect::repeat(1.0)];
    let bench = Bench::<3>::new("usaw", &walls, SPACING, wide(), far);
    let points = &bench.world.walls.points;
    let mut counts = [0; 3];
    for (x, share) in points.position.iter().zip(&points.share) {
        let faces = x.iter().filter(|c| **c == 0.0 || **c == SIZE).count();
        close(*share, shares[faces - 1], 1e-14, x);
        counts[faces - 1] += 1;
    }
    let n = N - 1;
    assert_eq!(counts, [6 * n * n, 12 * n, 8]);
    points.share.iter().sum()
}

/// The cells of free particles inside and the shares on the wall fill the box.
#[test]
fn in_a_box_faces_have_a_half_edges_a_quarter_and_corners_an_eighth_of_three_quarters() {
    // A corner has three quarters of a square of wall.
    let total = sum_of(tank([0.0; 3], [SIZE; 3]), [0.5, 0.25, 0.125 * 0.75]);
    let cells = (N as f64).powi(3) - (N as f64 - 1.0).powi(3);
    // Eight corners with 3/32 instead of 1/8.
    close(total, cells - 0.25, 1e-12, "in all");
}

#[test]
fn around_a_block_edges_have_three_quarters_and_corners_seven_eighths_of_three_quarters() {
    sum_of(
        block("block", [0.0; 3], [SIZE; 3]),
        [0.5, 0.75, 0.875 * 0.75],
    );
}

//! A square towed through a tank, with ten spacings to its side.

use crate::shipped::finished;

/// A wall is known to half a spacing, so that the square is a tenth wider or narrower; the reference is good to 1 %.
#[test]
fn the_mean_drag_of_a_towed_square_is_that_of_finite_differences_to_2_9_per_cent() {
    let run = finished("moving-square", &["numerics.spacing=0.1"]);
    run.error("drag-mean", 0.1 + 0.01, 0.0291);
}

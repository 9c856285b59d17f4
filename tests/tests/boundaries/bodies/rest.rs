//! A body that weighs what it displaces.

use sph_tests::bench;

use crate::bodies::FLOAT;

/// Six tenths of the box are under water, and it is six tenths as heavy as water.
#[test]
fn a_box_that_weighs_what_it_displaces_stays_for_ten_seconds_within_a_spacing() {
    let bench = bench!(FLOAT);
    bench.done(
        "run scene.toml --quiet --out r --threads 1 --set run.end=10 --set run.checkpoint_every=10 \
         --set wall.float.mover.rigid-body.density=600 --set output.series_every=0.05",
    );
    let series = bench.series("r");
    for (column, bound) in [("float.x", 0.02), ("float.y", 0.02), ("float.angle", 0.1)] {
        let most = series.largest_size(column);
        println!("{column}: {most:.5}");
        assert!(most < bound, "{column}: {most:.4}");
    }
}

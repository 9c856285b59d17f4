//! Bodies much lighter than the fluid that they push away.

use sph_io::read_table;
use sph_tests::Bench;

use crate::{FLOAT, PROGRAM};

/// Boxes of 1/10 and 1/50 of the density of water, pressed down to where they are drawn, rise to their draught and stay.
/// They start with more than 4 and 24 times their weight of buoyancy.
#[test]
fn boxes_a_tenth_and_a_fiftieth_as_heavy_as_water_rise_and_come_to_rest() {
    for ratio in [0.1, 0.02] {
        let bench = Bench::with(PROGRAM, FLOAT);
        bench.done(&format!(
            "run scene.toml --quiet --out r --threads 1 --set run.end=4 --set run.checkpoint_every=4 \
             --set wall.float.mover.rigid-body.density={} --set wall.float.mover.rigid-body.free=[\"y\"] \
             --set phase.water.rheology.newtonian.viscosity=2 --set output.series_every=0.01",
            1000.0 * ratio
        ));
        let series = read_table(bench.path("r/series.csv")).expect("a series");
        let height = series.column("float.y").expect("a height");
        // Water of 0.8 m less the box is 0.196 m², of which the box displaces `ratio` of itself.
        let level = (0.196 + 0.02 * ratio) / 0.8;
        let expected = level - 0.1 * ratio - 0.2;
        let late = &height[height.len() - 50..];
        let mean = late.iter().sum::<f64>() / late.len() as f64;
        let swing = late.iter().fold(0.0_f64, |m, y| m.max((y - mean).abs()));
        let off = (mean - expected).abs() / 0.02;
        assert!(
            off < 0.5,
            "{ratio}: at {mean:.4} m for {expected:.4} m, {off:.2} spacings"
        );
        assert!(swing < 0.25 * 0.02, "{ratio}: it swings by {swing:.4} m");
    }
}

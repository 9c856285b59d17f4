//! Bodies much lighter than the fluid that they push away.

use sph_tests::{bench, within};

use crate::bodies::FLOAT;

/// Boxes of 1/10 and 1/50 of the density of water, held down where they are drawn, with 6 and 30 times their weight of
/// buoyancy. They rise beyond their draught, no further than twice the way there, and come back; nowhere are they
/// accelerated by more than 2 g. What swings from step to step is accelerated a thousand times as much.
#[test]
fn boxes_a_tenth_and_a_fiftieth_as_heavy_as_water_swing_about_their_draught() {
    for ratio in [0.1, 0.02] {
        let bench = bench!(FLOAT);
        bench.done(&format!(
            "run scene.toml --quiet --out r --threads 1 --set run.end=0.9 --set run.checkpoint_every=0.9 \
             --set wall.float.mover.rigid-body.density={} --set wall.float.mover.rigid-body.free=[\"y\"] \
             --set phase.water.rheology.newtonian.viscosity=10 --set output.series_every=0.01",
            1000.0 * ratio
        ));
        let series = bench.series("r");
        let height = series.column("float.y");
        let time = series.column("time");
        // Water of 0.8 m less the box is 0.196 m², of which the box displaces `ratio` of itself.
        let level = (0.196 + 0.02 * ratio) / 0.8;
        let draught = level - 0.1 * ratio - 0.2;
        let top = series.largest("float.y");
        within(top, draught..2.0 * draught, "m that it rises");
        let last = height[height.len() - 20..].iter().copied();
        let back = last.fold(f64::INFINITY, f64::min);
        assert!(back < draught, "{ratio}: back to {back:.4} m");
        let rows = height.windows(3).zip(time.windows(3));
        let bends = rows.map(|(y, t)| {
            let slope = |k: usize| (y[k + 1] - y[k]) / (t[k + 1] - t[k]);
            2.0 * (slope(1) - slope(0)) / (t[2] - t[0])
        });
        let most = bends.fold(0.0, |m: f64, a| m.max(a.abs()));
        println!("{ratio}: up to {top:.4} m, {most:.2} m/s² at most");
        assert!(most < 2.0 * 9.81, "{ratio}: {most:.1} m/s²");
    }
}

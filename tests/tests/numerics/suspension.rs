//! Grains in suspension: shocks of settling, balance of settling and mixing, the balance of the grains, the same bits, refusals.

use sph_tests::{assembly_refuses, bench, close};

use crate::sediment::{CHANNEL, column, in_space};

/// A still column with grains at a concentration of 0.1 that are hardly heavier than water.
const COLUMN: &str = include_str!("column.toml");

/// A channel whose flow lifts grains.
fn lifting(scene: &str) -> String {
    let law = "[suspension.van-rijn]\n[probe.grains]\nkind = \"statistic\"\nfield = \"concentration\"\n\
               weight = \"mass\"\nreduce = [\"sum\", \"max\"]\n";
    scene.replace("[walls.usaw]", &format!("{law}[walls.usaw]"))
}

/// Kynch's theory: clear water over grains that sink with w (1 − C)^n, a deposit that grows with what arrives, both until they
/// meet, each within half a spacing; no grain is lost, none passes 0 or the packing.
#[test]
fn a_suspension_settles_in_two_shocks() {
    let scene = COLUMN.replace("end = 2.0", "end = 5.0");
    let bench = bench!(&scene);
    bench.done("run scene.toml --quiet --out out");
    let series = |name: &str| column(&bench, "out", name);
    let (time, clear, deposit) = (series("time"), series("clear"), series("deposit"));
    let speed = 0.05 * 0.9_f64.powf(4.65);
    let growth = 0.1 * speed / (0.6 - 0.1);
    let mut compared = 0;
    for k in 0..time.len() {
        let upper = 0.15 - speed * time[k];
        let lower = growth * time[k];
        // A deposit has a level from a row on.
        if lower > 0.005 && upper > lower + 0.02 {
            close(clear[k], upper, 0.0025, "m of grains");
            close(deposit[k], lower, 0.0025, "m of the deposit");
            compared += 1;
        }
    }
    assert!(compared > 15, "{compared} rows");
    // All grains lie in a deposit at packing.
    let last = deposit.last().expect("rows");
    assert!((last - 0.1 * 0.15 / 0.6).abs() < 0.0025, "{last}");
    let [sum, least, most] = ["sum", "min", "max"].map(|of| series(&format!("grains.{of}")));
    assert!(sum.iter().all(|s| (s / sum[0] - 1.0).abs() < 1e-13));
    assert!(least.iter().all(|c| *c >= 0.0) && most.iter().all(|c| *c <= 0.6));
    assert!(*most.last().expect("rows") > 0.59);
}

/// Settling against mixing ends at C ∝ exp(−wz/D), at every particle. A small gravity leaves the water at rest: its motion
/// stirs, 8·10⁻⁵ of the ratio with 9.81 m/s² and 6·10⁻⁶ with 10⁻³.
#[test]
fn settling_and_mixing_end_in_an_exponential() {
    let scene = COLUMN
        .replace("-9.81", "-1e-6")
        .replace("end = 2.0", "end = 12.0")
        .replace("spacing = 0.005", "spacing = 0.0125")
        .replace("[0.0, 0.05] }", "[0.0, 0.125] }")
        .replace("[0.05, 0.0]]", "[0.125, 0.0]]")
        .replace("[0.05, 0.15]]", "[0.125, 0.125]]")
        .replace(
            "hindrance_exponent = 4.65",
            "hindrance_exponent = 0.0\ndiffusivity = 4e-3",
        )
        .replace("concentration = 0.1 }", "concentration = 1e-3 }");
    let bench = bench!(&scene);
    bench.done("run scene.toml --quiet --out out");
    let state = bench.state("out");
    let [places, grains] = ["position", "concentration"].map(|name| state.reals(name));
    let rate = 0.05 / 4e-3;
    let all = places.chunks(2).zip(&grains);
    let scaled = all.map(|(x, c)| c * (rate * x[1]).exp());
    let (least, most) = scaled.fold((f64::INFINITY, 0.0_f64), |(a, b), c| (a.min(c), b.max(c)));
    assert!(most / least - 1.0 < 1e-5, "{least:e} {most:e}");
}

/// The grains of the bed, without pores, and those in the water are one number.
#[test]
fn what_leaves_the_bed_is_in_the_water() {
    for (name, scene) in [("plane", CHANNEL), ("space", &in_space())] {
        let bench = bench!(&lifting(scene));
        bench.done("run scene.toml --quiet --out out");
        let series = |name: &str| column(&bench, "out", name);
        let (volume, lifted) = (series("bed.volume"), series("bed.lifted"));
        let suspended = series("grains.sum");
        let last = *lifted.last().expect("rows");
        assert!(last > 1e-10, "{name}: {last:e} were lifted");
        for k in 0..volume.len() {
            let water = suspended[k] / 1000.0;
            close(water, lifted[k], 1e-12 * last, name);
            close(0.6 * volume[k], -lifted[k], 1e-15, name);
        }
        assert!(series("grains.max").iter().all(|c| *c <= 0.6));
    }
}

/// Rouse's profile from E/w at two grains over the bed, C/C_a = (a (H − z)/(z (H − a)))^Z, for the mean Shields number, below
/// 0.9 H. Measured are 0.92 to 0.98. Without the means over extents and of diffusivities they are 1.07 to 1.23, which fails.
#[test]
fn a_suspension_has_the_level_and_form_of_rouses_profile() {
    let bench = bench!(include_str!("rouse.toml"));
    bench.done("run scene.toml --quiet --out out");
    let (time, all) = (
        column(&bench, "out", "time"),
        column(&bench, "out", "bed.shields"),
    );
    let late: Vec<f64> = (time.iter().zip(&all))
        .filter(|(t, _)| **t > 8.0)
        .map(|(_, s)| *s)
        .collect();
    let shields = late.iter().sum::<f64>() / late.len() as f64;
    let (diameter, depth, weight) = (2e-4, 0.2, 1.65 * 9.81);
    let size: f64 = diameter * (weight / 1e-12_f64).cbrt();
    let speed = 1e-6 / diameter * ((10.36_f64.powi(2) + 1.049 * size.powi(3)).sqrt() - 10.36);
    let critical = 0.3 / (1.0 + 1.2 * size) + 0.055 * (1.0 - (-0.02 * size).exp());
    let excess = (shields - critical) / critical;
    let rate = 0.00033 * size.powf(0.3) * excess.powf(1.5) * (weight * diameter).sqrt();
    let power = speed / (0.41 * (shields * weight * diameter).sqrt());
    let rouse = |z: f64| {
        let a = 2.0 * diameter;
        rate / speed * (a * (depth - z) / (z * (depth - a))).powf(power)
    };
    let profile = sph_io::read_table(bench.path("out/curves/grains_0001.csv")).expect("curves");
    let values = |name| profile.column(name).expect("a column").iter();
    let all = values("distance").zip(values("mean"));
    let below: Vec<_> = all.filter(|(z, _)| **z < 0.9 * depth).collect();
    assert_eq!(below.len(), 9);
    for (z, mean) in below {
        let level = mean / rouse(*z);
        assert!((level - 1.0).abs() < 0.15, "{level} at {z} m");
    }
}

#[test]
fn no_grain_leaves_a_bed_up_to_the_threshold() {
    let law = "grain_diameter = \"1 mm\"";
    let shields = |critical: f64| {
        let scene = lifting(CHANNEL).replace(law, &format!("{law}\ncritical_shields = {critical}"));
        let bench = bench!(&scene);
        bench.done("run scene.toml --quiet --out out");
        column(&bench, "out", "grains.max")
    };
    assert!(shields(50.0).iter().all(|c| *c == 0.0));
    assert!(*shields(0.05).last().expect("rows") > 0.0);
}

#[test]
fn suspensions_have_the_same_bits_on_threads_on_ranks_and_after_an_interruption() {
    for (name, scene) in [("plane", CHANNEL), ("space", &in_space())] {
        let bench = bench!(&lifting(scene));
        let one = bench.same_bits("", 7);
        assert!(one.columns["concentration"].iter().any(|c| *c > 0));
        bench.done("run scene.toml --quiet --out ranks --ranks 2");
        one.assert_same(&bench.state("ranks"), name);
    }
}

/// Water with grains that do not settle, between two open faces.
const OPEN: &str = include_str!("open.toml");

/// Behind an inlet with `values` the concentration is that of the inlet, and grains leave with their water.
#[test]
fn grains_come_in_and_go_out_by_open_faces() {
    let bench = bench!(OPEN);
    bench.done("run scene.toml --quiet --out out");
    let [time, least, most] =
        ["time", "grains.min", "grains.max"].map(|name| column(&bench, "out", name));
    for k in 0..time.len() {
        assert!(most[k] <= 0.01 && least[k] >= 0.0);
        assert!(time[k] < 1.1 || (least[k] - 0.01).abs() < 1e-15);
    }
    assert!(*time.last().expect("rows") > 1.4);
}

#[test]
fn suspensions_that_are_none_are_refused() {
    assembly_refuses(COLUMN, include_str!("suspension.refused"));
    assembly_refuses(OPEN, include_str!("suspension_open.refused"));
    assembly_refuses(&lifting(CHANNEL), include_str!("suspension_lifted.refused"));
}

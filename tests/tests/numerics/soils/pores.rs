//! Pores of soils: the balance of grains and fluid, consolidation, undrained shear, the same bits, refusals.

use sph_tests::{Bench, assembly_refuses, bench};

/// A dense bed under water that is sheared by the water's start.
const BED: &str = include_str!("bed.toml");

fn sum(column: &[f64]) -> f64 {
    column.iter().sum()
}

/// A column of the checkpoint in a folder, in the order of the identities.
fn by_identity(bench: &Bench, folder: &str, name: &str) -> Vec<f64> {
    let state = bench.state(folder);
    let both = state.columns["identity"].iter().zip(state.reals(name));
    let mut both: Vec<(&u64, f64)> = both.collect();
    both.sort_by_key(|(id, _)| *id);
    both.into_iter().map(|(_, x)| x).collect()
}

/// What the soil takes up is what the water gives, and its packing is that of its mass.
#[test]
fn grains_and_water_are_neither_made_nor_lost() {
    let bench = bench!(BED);
    bench.done("run scene.toml --quiet --out none --set run.end=1e-9");
    bench.done("run scene.toml --quiet --out out");
    let [m0, m1] = ["none", "out"].map(|folder| by_identity(&bench, folder, "mass"));
    assert!((sum(&m1) / sum(&m0) - 1.0).abs() < 1e-14, "mass was made");
    let packing = by_identity(&bench, "out", "packing");
    let [first, grains] = ["none", "out"].map(|folder| by_identity(&bench, folder, "grain_volume"));
    assert_eq!(first, grains, "grains were made");
    let mut grown = 0.0_f64;
    for (k, &g) in grains.iter().enumerate().filter(|(_, g)| **g > 0.0) {
        // m = m₀ + ρ_w G (1/φ − 1/φ₀).
        let law = m0[k] + 1000.0 * g * (1.0 / packing[k] - 1.0 / 0.62);
        assert!((m1[k] / law - 1.0).abs() < 1e-12, "{} {law}", m1[k]);
        grown = grown.max((packing[k] - 0.62).abs());
    }
    assert!(grown > 1e-5, "nothing dilated: {grown:e}");
}

#[test]
fn pores_have_the_same_bits_on_threads_and_after_an_interruption() {
    bench!(BED).same_bits("", 7);
}

#[test]
fn pores_that_are_none_are_refused() {
    assembly_refuses(BED, include_str!("pores.refused"));
}

//! What several machines would have and send.

use sph_tests::{Says, bench, within};

#[test]
fn every_particle_has_one_owner_and_ghosts_are_those_that_are_sent() {
    let bench = bench!();
    let told = bench.done("explain hydrostatic-tank --ranks 6 --json").out;
    let json: serde_json::Value = serde_json::from_str(&told).expect("JSON");
    let split = &json["ranks"];
    let ranks = split["ranks"].as_array().expect("ranks");
    assert_eq!(ranks.len(), 6);
    let sum = |key: &str| ranks.iter().filter_map(|r| r[key].as_u64()).sum::<u64>();
    assert_eq!(Some(sum("particles")), json["particles"].as_u64());
    assert_eq!(sum("ghosts"), sum("sent"));
    // Three cuts lead to a rank, each off by half a particle at most, and none costs three times the mean.
    let particles = sum("particles") as f64;
    let bound = 3.0 * 0.5 * 3.0 * 6.0 / particles;
    let off = split["imbalance"].as_f64().expect("an imbalance");
    within(off, 0.0..bound, "imbalance");
    // What the density sum and the interactions have found: no column twice.
    let columns: Vec<&str> = split["exchanges"]
        .as_array()
        .expect("exchanges")
        .iter()
        .flat_map(|e| e["columns"].as_array().expect("columns"))
        .filter_map(|c| c.as_str())
        .collect();
    let mut once = columns.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), columns.len(), "{columns:?}");
    assert_eq!(columns.first(), Some(&"density"), "{columns:?}");
    // Pressures follow from densities.
    let has = |name| columns.contains(&name);
    assert!(has("acceleration") && !has("pressure"), "{columns:?}");
    let text = bench.done("explain hydrostatic-tank --ranks 6").out;
    text.says("split over 6 machines");
}

#[test]
fn splits_that_cannot_be_are_told() {
    let bench = bench!();
    for (command, told) in [
        (
            "explain hydrostatic-tank --ranks 100000",
            "some would own nothing",
        ),
        ("explain hydrostatic-tank --ranks 0", "invalid value"),
        ("explain grains-oedometer --ranks 2", "one of grains"),
    ] {
        bench.refused(command).says(told);
    }
}

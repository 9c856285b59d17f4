//! The scour map, on a bed with a pit of known depth.

use sph_core::{Store, Vect, fields};
use sph_neighbours::World;
use sph_probes::Probe;

use super::common::{self, near, put};

const SPACING: f64 = 0.05;
/// Top of the bed, m.
const LEVEL: f64 = 0.4;

/// Eight by eight columns of eight grains under two particles of water. A quarter has lost three rows, the neighbouring
/// quarter has gained one, and a grain swims in the water over the pit.
fn world() -> World<3> {
    let at = |n: u32| (f64::from(n) + 0.5) * SPACING;
    let mut rows = Vec::new();
    for (i, j) in (0..8).flat_map(|i| (0..8).map(move |j| (i, j))) {
        let grains = match (i < 4, j < 4) {
            (true, true) => 5,
            (true, false) => 9,
            _ => 8,
        };
        let phase = |k: u32| u32::from(k >= grains);
        rows.extend((0..grains + 2).map(|k| (Vect::from([i, j, k].map(at)), phase(k))));
    }
    rows.push((Vect::from([1, 1, 9].map(at)), 0));
    let mut free = Store::new(rows.len());
    put(&mut free, fields::POSITION, rows.iter().map(|r| r.0));
    put(&mut free, fields::PHASE, rows.iter().map(|r| r.1));
    common::world(free, SPACING)
}

fn probe(keys: &str) -> Box<dyn Probe<3>> {
    let keys = format!("phase = \"sand\"\nlevel = {LEVEL}\n{keys}");
    common::prepared("scour-map", &keys, ["sand", "water"])
}

#[test]
fn a_pit_has_its_depth_and_volume_and_grains_in_suspension_do_not_fill_it() {
    let found = probe("").measure(&world()).unwrap();
    near(found[0], 3.0 * SPACING);
    near(found[1], SPACING);
    near(found[2], 16.0 * SPACING * SPACING * 3.0 * SPACING);
    let outside = probe("within = [[0.0, 0.2], [0.4, 0.4]]");
    let outside = outside.measure(&world()).unwrap();
    near(outside[0], 0.0);
    near(outside[1], SPACING);
    near(outside[2], 0.0);
}

/// Water has taken two of the four grains of a cell's top row, and all of the cell beside it: half a row, and the whole bed.
#[test]
fn a_row_half_gone_counts_half_and_a_bed_gone_is_as_deep_as_its_ground() {
    let mut world = world();
    let gone = |x: &Vect<3>| {
        let top = x[0] < 0.05 && x[1] > 0.3 && x[2] > 0.4;
        let beside = x[0] > 0.3 && x[1] > 0.3;
        top || beside
    };
    let phases = world.free.get(fields::PHASE).unwrap().iter();
    let both = phases.zip(world.free.get(fields::POSITION).unwrap());
    let water = both.map(|(phase, x)| if gone(x) { 1 } else { *phase });
    let water: Vec<u32> = water.collect();
    put(&mut world.free, fields::PHASE, water);
    let all = "within = [[0.0, 0.0], [0.4, 0.4]]";
    let rows = probe(all).as_curves().unwrap().curves(&world).unwrap();
    let depth = |x: f64, y: f64| {
        let near = |row: &&Vec<f64>| (row[0] - x).hypot(row[1] - y) < 1e-9;
        rows.iter().find(near).map(|row| row[3])
    };
    // The quarter has gained a row: half of it is left.
    near(depth(0.05, 0.35).unwrap(), -0.5 * SPACING);
    near(depth(0.35, 0.35).unwrap(), LEVEL);
    let found = probe(all).measure(&world).unwrap();
    near(found[0], LEVEL);
    // Without a part that counts, cells without grains are left out.
    near(probe("").measure(&world).unwrap()[0], 3.0 * SPACING);
}

/// Seven columns from x = 0.05 on: three cells, not four of which one is half outside.
#[test]
fn whole_cells_fill_the_part_that_counts() {
    let probe = probe("within = [[0.05, 0.0], [0.4, 0.4]]");
    let rows = probe.as_curves().unwrap().curves(&world()).unwrap();
    let mut across: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    across.dedup();
    assert_eq!(across.len(), 3);
    for (n, x) in across.iter().enumerate() {
        near(*x, 0.05 + (n as f64 + 0.5) * 0.35 / 3.0);
    }
    assert_eq!(rows.len(), 12);
}

#[test]
fn the_map_has_a_row_for_every_cell_of_two_spacings() {
    let probe = probe("");
    let rows = probe.as_curves().unwrap().curves(&world()).unwrap();
    assert_eq!(rows.len(), 16);
    let curves = probe.as_curves().unwrap();
    let drawn = curves.drawn_column().unwrap();
    assert_eq!(curves.curve_columns()[drawn].suffix, "depth");
    let pit = rows.iter().filter(|row| row[drawn] > 0.0).count();
    assert_eq!(pit, 4);
    for row in rows {
        near(row[2] + row[drawn], LEVEL);
    }
}

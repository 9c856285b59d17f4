//! Where dummy particles stand in space.

use sph_boundary::WallSpec;
use sph_core::Vect;
use sph_neighbours::Domain;

use crate::bench::{Bench, wide};
use crate::spatial_plugin::shapes::{block, floor, tank, wall};

const SPACING: f64 = 0.5;
/// h/δr = 2 with a support of 2h: four rows fill the kernel.
const ROWS: i64 = 4;

/// Cells with their centres at (i + ½) δr; refuses places off the lattice.
fn cells(bench: &Bench<3>) -> Vec<[i64; 3]> {
    let cell = |x: &Vect<3>| {
        [0, 1, 2].map(|k| {
            let index = (x[k] / SPACING).floor();
            let off = x[k] - (index + 0.5) * SPACING;
            assert!(off.abs() < 1e-13, "{x} is {off:e} off the lattice");
            index as i64
        })
    };
    let mut cells: Vec<_> = bench.world.walls.points.position.iter().map(cell).collect();
    cells.sort_unstable();
    cells
}

fn around(surface: sph_boundary::Surface, particle: [f64; 3]) -> Bench<3> {
    let particles = vec![Vect::from(particle)];
    Bench::new(
        "dummy-particles",
        &[WallSpec::at_rest(wall(surface))],
        SPACING,
        wide(),
        particles,
    )
}

/// Distance of a cell's centre from the box 0 ≤ x ≤ n δr, in spacings.
fn off(cell: &[i64; 3], n: [i64; 3]) -> f64 {
    let out = |k: usize| {
        let x = cell[k] as f64 + 0.5;
        (-x).max(x - n[k] as f64).max(0.0)
    };
    (0..3).map(|k| out(k).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn a_closed_box_is_framed_by_a_particle_in_every_cell_within_the_support() {
    let n = [6, 5, 4];
    let bench = around(tank([0.0; 3], n.map(|n| n as f64 * SPACING)), [1.0; 3]);
    let mut frame = Vec::new();
    for i in -ROWS..n[0] + ROWS {
        for j in -ROWS..n[1] + ROWS {
            for k in -ROWS..n[2] + ROWS {
                let distance = off(&[i, j, k], n);
                if distance > 0.0 && distance <= ROWS as f64 {
                    frame.push([i, j, k]);
                }
            }
        }
    }
    // 14 · 13 · 12 − 6 · 5 · 4 = 2064 less the rounded edges of the frame.
    assert_eq!(frame.len(), 1652);
    assert_eq!(cells(&bench), frame);
}

#[test]
fn a_solid_block_is_filled_to_its_middle() {
    let bench = around(block("block", [0.0; 3], [2.0, 2.5, 3.0]), [-3.0; 3]);
    let mut all = Vec::new();
    for i in 0..4 {
        for j in 0..5 {
            all.extend((0..6).map(|k| [i, j, k]));
        }
    }
    assert_eq!(cells(&bench), all, "4 × 5 × 6 cells");
}

#[test]
fn the_kernel_is_as_full_next_to_a_flat_wall_as_in_the_bulk() {
    let domain = Domain {
        lower: Vect::from([0.0, 0.0, -50.0]),
        upper: Vect::from([6.0, 6.0, 50.0]),
        periodic: [true, true, false],
    };
    let mut positions = Vec::new();
    for i in 0..12 {
        for j in 0..12 {
            let place = |k: i32| Vect::from([i, j, k].map(|c| (f64::from(c) + 0.5) * SPACING));
            positions.extend((0..10).map(place));
        }
    }
    let walls = [WallSpec::at_rest(wall(floor(0.0, 6.0)))];
    let bench = Bench::new("dummy-particles", &walls, SPACING, domain, positions);
    assert_eq!(
        bench.world.walls.points.position.len(),
        4 * 144,
        "four layers"
    );
    let sum = |height: f64| {
        let x = bench.positions()[bench.at(Vect::from([3.25, 3.25, height]))];
        let world = &bench.world;
        let all = bench.positions().iter().chain(&world.walls.points.position);
        let w = |y: &Vect<3>| world.kernel.at(world.domain.nearest_image(x - y).norm()).0;
        all.map(|y| SPACING.powi(3) * w(y)).sum::<f64>()
    };
    let (bulk, first) = (sum(2.25), sum(0.25));
    println!("Σ V w = {bulk:.6} in the bulk, {first:.6} in the first row");
    assert!((bulk - 1.0).abs() < 3e-3, "{bulk}");
    assert!((first - bulk).abs() < 1e-13, "{first} {bulk}");
}

#[test]
fn every_dummy_is_a_whole_particle() {
    let bench = around(tank([0.0; 3], [2.0; 3]), [1.0; 3]);
    let walls = &bench.world.walls;
    assert!(walls.points.share.iter().all(|s| *s == 1.0));
    assert!(walls.points.volume.iter().all(|v| *v == SPACING.powi(3)));
    assert!(walls.elements.centre.is_empty() && walls.contacts.is_empty());
}

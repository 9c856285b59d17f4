//! Where dummy particles stand: behind the wall, one per cell of the lattice.

use sph_boundary::Polyline;
use sph_core::Vect;

use crate::bench::{Bench, fixed_line, over_a_flat_wall, wide};

/// h/δr = 2 with a support of 2h: four rows fill the kernel.
const ROWS: i64 = 4;
const SPACING: f64 = 0.5;

fn around(polyline: Polyline) -> Bench<2> {
    let far = vec![Vect::<2>::new(3.0, 2.0)];
    Bench::new(
        "dummy-particles",
        &[fixed_line(polyline)],
        SPACING,
        wide(),
        far,
    )
}

/// Cell (i, j) with its centre at ((i + ½) δr, (j + ½) δr); refuses places off the lattice.
fn cells(bench: &Bench<2>) -> Vec<(i64, i64)> {
    let positions = bench.world.walls.points.position.iter();
    let mut cells: Vec<_> = positions
        .map(|x| {
            let index = [0, 1].map(|k| (x[k] / SPACING).floor());
            for k in 0..2 {
                let off = x[k] - (index[k] + 0.5) * SPACING;
                // Cutting an edge and stepping off it rounds a few times.
                assert!(off.abs() < 1e-13, "{x} is {off:e} off the lattice");
            }
            (index[0] as i64, index[1] as i64)
        })
        .collect();
    cells.sort_unstable();
    cells
}

/// All cells outside 0 ≤ i < nx, 0 ≤ j < ny within four rows of it.
fn frame(nx: i64, ny: i64, top: bool) -> Vec<(i64, i64)> {
    let mut cells = Vec::new();
    for i in -ROWS..nx + ROWS {
        for j in -ROWS..ny + if top { ROWS } else { 0 } {
            let inside = (0..nx).contains(&i) && (0..ny).contains(&j);
            if !inside {
                cells.push((i, j));
            }
        }
    }
    cells
}

#[test]
fn a_closed_box_is_framed_by_224_particles_one_in_every_cell() {
    let corners = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]];
    let bench = around(Polyline::closed("box", corners));
    let expected = frame(12, 8, true);
    // (12 + 8)(8 + 8) − 12 · 8 = 224 and not one twice.
    assert_eq!(expected.len(), 224);
    assert_eq!(cells(&bench), expected);
}

#[test]
fn an_open_tank_has_a_particle_in_every_cell_up_to_its_rim() {
    let line = vec![[0.0, 4.0], [0.0, 0.0], [6.0, 0.0], [6.0, 4.0]];
    let bench = around(Polyline::open("tank", line));
    let found = cells(&bench);
    let below_rim: Vec<_> = found.iter().filter(|(_, j)| *j < 8).copied().collect();
    assert_eq!(below_rim, frame(12, 8, false));
    let above: Vec<_> = found.iter().filter(|(_, j)| *j >= 8).collect();
    // A wall may reach on beyond its end, never into the room.
    assert!(above.iter().all(|(i, _)| !(0..12).contains(i)), "{above:?}");
}

#[test]
fn a_solid_block_is_filled_to_its_middle() {
    let block = Polyline::closed(
        "block",
        vec![[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0]],
    );
    let bench = around_outside(block);
    let all: Vec<_> = (0..8).flat_map(|i| (0..8).map(move |j| (i, j))).collect();
    assert_eq!(
        cells(&bench),
        all,
        "8 × 8 cells are four rows from either side"
    );
}

fn around_outside(polyline: Polyline) -> Bench<2> {
    let far = vec![Vect::<2>::new(-3.0, 2.0)];
    Bench::new(
        "dummy-particles",
        &[fixed_line(polyline)],
        SPACING,
        wide(),
        far,
    )
}

#[test]
fn a_periodic_floor_has_four_rows_of_sixteen() {
    let bench = over_a_flat_wall("dummy-particles", 4, 0.5);
    let expected: Vec<_> = (0..16).flat_map(|i| (-4..0).map(move |j| (i, j))).collect();
    assert_eq!(cells(&bench), expected);
}

#[test]
fn every_dummy_is_a_whole_particle() {
    let bench = over_a_flat_wall("dummy-particles", 4, 0.5);
    let walls = &bench.world.walls;
    assert!(walls.points.share.iter().all(|s| *s == 1.0));
    assert!(walls.points.volume.iter().all(|v| *v == SPACING * SPACING));
    assert!(walls.elements.centre.is_empty() && walls.contacts.is_empty());
    assert!(bench.wall.columns().is_empty());
    assert!(bench.gamma().iter().all(|g| *g == 0.0), "nobody wrote γ");
}

/// Floors with a wedge or a notch at several angles.
fn wedges() -> impl Iterator<Item = (String, Vec<[f64; 2]>)> {
    let tops = [0.4, 1.0, 1.7, 2.6];
    let both = tops.into_iter().flat_map(|top| [(top, 1.0), (top, -1.0)]);
    both.map(|(top, sign)| {
        let floor = vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [3.1, sign * top],
            [4.3, 0.0],
            [6.5, 0.0],
            [6.5, 5.0],
            [0.0, 5.0],
        ];
        (format!("wedge of {}", sign * top), floor)
    })
}

#[test]
fn no_dummy_of_a_wedge_is_in_the_fluid_or_nearer_to_it_than_half_a_spacing() {
    for (what, floor) in wedges() {
        let bench = around(Polyline::closed("floor", floor));
        let points = &bench.world.walls.points.position;
        assert!(points.len() > 150, "{what}: {} particles", points.len());
        for x in points {
            assert!(!bench.wall.contains(x), "{what}: {x} is in the fluid");
            let near = bench.wall.clearance(x, 0.5 * SPACING * (1.0 - 1e-6));
            assert!(near.is_none(), "{what}: {x} is {near:?} from the wall");
        }
    }
}

#[test]
fn dummies_of_a_wedge_keep_seven_tenths_of_a_spacing_from_each_other() {
    for (what, floor) in wedges() {
        let bench = around(Polyline::closed("floor", floor));
        let points = &bench.world.walls.points.position;
        let mut least = f64::INFINITY;
        for (i, x) in points.iter().enumerate() {
            for y in &points[..i] {
                least = least.min((x - y).norm());
            }
        }
        assert!(least >= 0.7 * SPACING, "{what}: {least}");
    }
}

/// Σ V w over lattice and dummies: 1 where the kernel is full.
#[test]
fn the_kernel_is_as_full_next_to_a_flat_wall_as_in_the_bulk() {
    let bench = over_a_flat_wall("dummy-particles", 12, 0.5);
    let sum = |x: Vect<2>| {
        let world = &bench.world;
        let all = bench.positions().iter().chain(&world.walls.points.position);
        let w = |y: &Vect<2>| world.kernel.at(world.domain.nearest_image(x - y).norm());
        all.map(|y| 0.25 * w(y).0).sum::<f64>()
    };
    let bulk = sum(bench.positions()[bench.at(Vect::<2>::new(4.25, 2.75))]);
    let first = sum(bench.positions()[bench.at(Vect::<2>::new(4.25, 0.25))]);
    assert!(
        (bulk - 1.0012).abs() < 1e-4,
        "the lattice sum of the kernel: {bulk}"
    );
    // The same sum over the same lattice.
    assert!((first - bulk).abs() < 1e-14, "{first} {bulk}");
}

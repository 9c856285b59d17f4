//! Where dummy particles stand: behind the wall, one per cell of the lattice.

use sph_boundary::{Polyline, WallSpec};
use sph_core::Vect;
use sph_neighbours::Domain;

use crate::bench::{Bench, fixed_line, over_a_flat_wall, wide};
use crate::close;
use crate::spatial_plugin::shapes::{block, floor, tank, wall};

/// h/δr = 2 with a support of 2h: four rows fill the kernel.
const ROWS: i64 = 4;
const SPACING: f64 = 0.5;

fn around<const D: usize>(wall: WallSpec<D>, particle: [f64; D]) -> Bench<D> {
    let particles = vec![particle.into()];
    Bench::new("dummy-particles", &[wall], SPACING, wide(), particles)
}

fn in_the_plane(line: Polyline, particle: [f64; 2]) -> Bench<2> {
    around(fixed_line(line), particle)
}

fn in_space(surface: sph_boundary::Surface, particle: [f64; 3]) -> Bench<3> {
    around(WallSpec::at_rest(wall(surface)), particle)
}

/// Cells with their centres at (i + ½) δr; refuses places off the lattice.
fn cells<const D: usize>(bench: &Bench<D>) -> Vec<[i64; D]> {
    let cell = |x: &Vect<D>| {
        std::array::from_fn(|k| {
            let index = (x[k] / SPACING).floor();
            // Cutting an edge and stepping off it rounds a few times.
            let off = x[k] - (index + 0.5) * SPACING;
            assert!(off.abs() < 1e-13, "{x} is {off:e} off the lattice");
            index as i64
        })
    };
    let mut cells: Vec<_> = bench.world.walls.points.position.iter().map(cell).collect();
    cells.sort_unstable();
    cells
}

/// All cells outside 0 ≤ i < nx, 0 ≤ j < ny within four rows of it.
fn frame(nx: i64, ny: i64, top: bool) -> Vec<[i64; 2]> {
    let columns = -ROWS..nx + ROWS;
    let rows = -ROWS..ny + if top { ROWS } else { 0 };
    let all = columns.flat_map(|i| rows.clone().map(move |j| [i, j]));
    let inside = |[i, j]: &[i64; 2]| (0..nx).contains(i) && (0..ny).contains(j);
    all.filter(|cell| !inside(cell)).collect()
}

#[test]
fn a_closed_box_is_framed_by_224_particles_one_in_every_cell() {
    let corners = vec![[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]];
    let bench = in_the_plane(Polyline::closed("box", corners), [3.0, 2.0]);
    let expected = frame(12, 8, true);
    // (12 + 8)(8 + 8) − 12 · 8 = 224 and not one twice.
    assert_eq!(expected.len(), 224);
    assert_eq!(cells(&bench), expected);
}

#[test]
fn an_open_tank_has_a_particle_in_every_cell_up_to_its_rim() {
    let line = vec![[0.0, 4.0], [0.0, 0.0], [6.0, 0.0], [6.0, 4.0]];
    let bench = in_the_plane(Polyline::open("tank", line), [3.0, 2.0]);
    let (below_rim, above): (Vec<_>, Vec<_>) = cells(&bench).into_iter().partition(|c| c[1] < 8);
    assert_eq!(below_rim, frame(12, 8, false));
    // A wall may reach on beyond its end, never into the room.
    assert!(above.iter().all(|c| !(0..12).contains(&c[0])), "{above:?}");
}

/// Distance of a cell's centre from the box 0 ≤ x ≤ n δr, in spacings.
fn off(cell: &[i64; 3], n: [i64; 3]) -> f64 {
    let out = |k: usize| {
        let x = cell[k] as f64 + 0.5;
        (-x).max(x - n[k] as f64).max(0.0)
    };
    (0..3).map(|k| out(k).powi(2)).sum::<f64>().sqrt()
}

fn product([x, y, z]: [std::ops::Range<i64>; 3]) -> impl Iterator<Item = [i64; 3]> {
    let columns = x.flat_map(move |i| y.clone().map(move |j| [i, j]));
    columns.flat_map(move |[i, j]| z.clone().map(move |k| [i, j, k]))
}

#[test]
fn a_closed_box_in_space_is_framed_by_a_particle_in_every_cell_within_the_support() {
    let n = [6, 5, 4];
    let bench = in_space(tank([0.0; 3], n.map(|n| n as f64 * SPACING)), [1.0; 3]);
    let near = |cell: &[i64; 3]| off(cell, n) > 0.0 && off(cell, n) <= ROWS as f64;
    let frame = product(n.map(|n| -ROWS..n + ROWS)).filter(near);
    let frame: Vec<_> = frame.collect();
    // 14 · 13 · 12 − 6 · 5 · 4 = 2064 less the rounded edges of the frame.
    assert_eq!(frame.len(), 1652);
    assert_eq!(cells(&bench), frame);
}

#[test]
fn a_solid_block_is_filled_to_its_middle() {
    let corners = vec![[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0]];
    let bench = in_the_plane(Polyline::closed("block", corners), [-3.0, 2.0]);
    let all: Vec<_> = (0..8).flat_map(|i| (0..8).map(move |j| [i, j])).collect();
    // 8 × 8 cells are four rows from either side.
    assert_eq!(cells(&bench), all);
    let bench = in_space(block("block", [0.0; 3], [2.0, 2.5, 3.0]), [-3.0; 3]);
    let all: Vec<_> = product([0..4, 0..5, 0..6]).collect();
    assert_eq!(cells(&bench), all);
}

#[test]
fn a_periodic_floor_has_four_rows_of_sixteen() {
    let bench = over_a_flat_wall("dummy-particles", 4, 0.5);
    let expected: Vec<_> = (0..16).flat_map(|i| (-4..0).map(move |j| [i, j])).collect();
    assert_eq!(cells(&bench), expected);
}

fn is_whole<const D: usize>(bench: &Bench<D>) {
    let walls = &bench.world.walls;
    let volume = SPACING.powi(D as i32);
    assert!(walls.points.share.iter().all(|s| *s == 1.0));
    assert!(walls.points.volume.iter().all(|v| *v == volume));
    assert!(walls.elements.centre.is_empty() && walls.contacts.is_empty());
    assert!(bench.wall.columns().is_empty());
    assert!(
        bench.gamma().iter().all(|g| *g == 0.0),
        "no sweep has written γ"
    );
}

#[test]
fn every_dummy_is_a_whole_particle() {
    is_whole(&over_a_flat_wall("dummy-particles", 4, 0.5));
    is_whole(&in_space(tank([0.0; 3], [2.0; 3]), [1.0; 3]));
}

/// Dummies at floors with a wedge or a notch at several angles.
fn wedges() -> impl Iterator<Item = (f64, Bench<2>)> {
    let tops = [0.4, 1.0, 1.7, 2.6];
    tops.into_iter().flat_map(|top| [top, -top]).map(|top| {
        let mut floor = vec![[0.0, 0.0], [2.0, 0.0], [3.1, top], [4.3, 0.0]];
        floor.extend([[6.5, 0.0], [6.5, 5.0], [0.0, 5.0]]);
        let floor = Polyline::closed("floor", floor);
        (top, in_the_plane(floor, [3.0, 2.0]))
    })
}

#[test]
fn no_dummy_of_a_wedge_is_in_the_fluid_or_nearer_to_it_than_half_a_spacing() {
    for (top, bench) in wedges() {
        let points = &bench.world.walls.points.position;
        assert!(points.len() > 150, "{top}: {} particles", points.len());
        for x in points {
            assert!(!bench.wall.contains(x), "{top}: {x} is in the fluid");
            let near = bench.wall.clearance(x, 0.5 * SPACING * (1.0 - 1e-6));
            assert!(near.is_none(), "{top}: {x} is {near:?} from the wall");
        }
    }
}

#[test]
fn dummies_of_a_wedge_keep_seven_tenths_of_a_spacing_from_each_other() {
    for (top, bench) in wedges() {
        let points = &bench.world.walls.points.position;
        let before = |i: usize| points[..i].iter().map(move |y| (points[i] - y).norm());
        let least = (0..points.len()).flat_map(before);
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(least >= 0.7 * SPACING, "{top}: {least}");
    }
}

/// Σ V w over lattice and dummies, in the bulk and in the first row: 1 where the kernel is full.
fn sums<const D: usize>(bench: &Bench<D>, places: [[f64; D]; 2]) -> [f64; 2] {
    places.map(|place| {
        let x = bench.positions()[bench.at(place.into())];
        let world = &bench.world;
        let all = bench.positions().iter().chain(&world.walls.points.position);
        let w = |y: &Vect<D>| world.kernel.at(world.domain.nearest_image(x - y).norm()).0;
        all.map(|y| SPACING.powi(D as i32) * w(y)).sum()
    })
}

#[test]
fn the_kernel_is_as_full_next_to_a_flat_wall_as_in_the_bulk() {
    let bench = over_a_flat_wall("dummy-particles", 12, 0.5);
    let [bulk, first] = sums(&bench, [[4.25, 2.75], [4.25, 0.25]]);
    close(bulk, 1.0012, 1e-4, "the lattice sum of the kernel");
    // The same sum over the same lattice.
    close(first, bulk, 1e-14, "next to the wall");
}

#[test]
fn the_kernel_is_as_full_next_to_a_plane_as_in_the_bulk() {
    let domain = Domain {
        lower: Vect::from([0.0, 0.0, -50.0]),
        upper: Vect::from([6.0, 6.0, 50.0]),
        periodic: [true, true, false],
    };
    let place = |cell: [i64; 3]| Vect::from(cell.map(|c| (c as f64 + 0.5) * SPACING));
    let positions = product([0..12, 0..12, 0..10]).map(place).collect();
    let walls = [WallSpec::at_rest(wall(floor(0.0, 6.0)))];
    let bench = Bench::new("dummy-particles", &walls, SPACING, domain, positions);
    // Four layers.
    assert_eq!(bench.world.walls.points.position.len(), 4 * 144);
    let [bulk, first] = sums(&bench, [[3.25, 3.25, 2.25], [3.25, 3.25, 0.25]]);
    close(bulk, 1.0, 3e-3, "the lattice sum of the kernel");
    close(first, bulk, 1e-13, "next to the wall");
}

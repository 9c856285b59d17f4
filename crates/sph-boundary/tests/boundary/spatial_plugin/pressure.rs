//! Pressures at the contacts of walls in space.

use sph_boundary::WallSpec;
use sph_core::{Vect, fields};

use crate::bench::{Bench, wide};
use crate::random::Random;
use crate::spatial_plugin::shapes::{block, tank, wall};

const SPACING: f64 = 0.25;
/// Spacings along an edge of the tank.
const N: usize = 10;
const SIZE: f64 = N as f64 * SPACING;
/// Smoothing length of the bench, and the kernel's support.
const H: f64 = 2.0 * SPACING;
const SUPPORT: f64 = 2.0 * H;
const FELT: [f64; 3] = [3.0, -2.0, -9.81];

fn hydrostatic(x: &Vect<3>) -> f64 {
    1000.0 + Vect::from(FELT).dot(x)
}

/// Disordered particles in a tank around a block, with the pressure of fluid at rest under an oblique gravity.
fn filled() -> Bench<3> {
    let (low, high) = ([3.0 * SPACING; 3], [6.0 * SPACING; 3]);
    let walls = [
        WallSpec::at_rest(wall(tank([0.0; 3], [SIZE; 3]))),
        WallSpec::at_rest(wall(block("block", low, high))),
    ];
    let mut random = Random(3);
    let mut places = Vec::new();
    for k in 0..N * N * N {
        let index = [k % N, k / N % N, k / (N * N)];
        let x = index.map(|i| (i as f64 + 0.5) * SPACING);
        if index.iter().any(|i| !(3..6).contains(i)) {
            places.push(Vect::from(x.map(|x| x + random.between(-0.06, 0.06))));
        }
    }
    let mut bench = Bench::new("usaw", &walls, SPACING, wide(), places);
    bench.world.gravity = Vect::from(FELT);
    bench.set(fields::PRESSURE, hydrostatic);
    bench.wall.state(&mut bench.world).expect("a state");
    bench
}

/// ∫ p w dS over the part of a plane on which a point looks, by small squares, and ∫ w dS.
fn by_squares(x: &Vect<3>, axis: usize, plane: f64, within: impl Fn(&Vect<3>) -> bool) -> [f64; 2] {
    const PARTS: i32 = 400;
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let cell = 2.0 * SUPPORT / f64::from(PARTS);
    let kernel = sph_kernels::Kernel::sampler(&sph_kernels::wendland_c2(), 3, H);
    let mut sums = [0.0; 2];
    for (i, j) in (0..PARTS).flat_map(|i| (0..PARTS).map(move |j| (i, j))) {
        let mut place = *x;
        place[axis] = plane;
        place[u] += (f64::from(i) + 0.5) * cell - SUPPORT;
        place[v] += (f64::from(j) + 0.5) * cell - SUPPORT;
        if within(&place) {
            let weight = kernel.at((place - x).norm()).0 * cell * cell;
            sums[0] += weight * hydrostatic(&place);
            sums[1] += weight;
        }
    }
    sums
}

#[test]
fn a_linear_pressure_along_a_wall_is_exact_at_contacts() {
    let bench = filled();
    let elements = &bench.world.walls.elements;
    let positions = bench.world.free.get(fields::POSITION).expect("positions");
    let (mut checked, mut worst, mut alone) = (0, 0.0_f64, 0.0_f64);
    for (i, x) in positions.iter().enumerate().step_by(7) {
        for contact in bench.world.walls.contacts.of_particle(i) {
            let s = contact.element as usize;
            let normal = elements.normal[s];
            let axis = normal.iamax();
            let plane = x[axis] - contact.distance * normal[axis];
            let on_block = elements.wall[s] == 1;
            let [low, high] = match on_block {
                true => [3.0 * SPACING, 6.0 * SPACING],
                false => [0.0, SIZE],
            };
            let within =
                |place: &Vect<3>| (0..3).all(|k| k == axis || (low..high).contains(&place[k]));
            let [pressure, whole] = by_squares(x, axis, plane, within);
            if whole < 1e-3 / SPACING {
                continue;
            }
            // Two hundredths of a spacing are the squares' own.
            let slope = Vect::from(FELT).norm() * SPACING;
            worst = worst.max((contact.pressure - pressure / whole).abs() / slope);
            alone = alone.max((elements.pressure[s] - pressure / whole).abs() / slope);
            checked += 1;
        }
    }
    println!("{checked} contacts: {worst:.1e}, with the pressures of elements {alone:.1e}");
    assert!(checked > 100);
    assert!(worst < 0.02, "{worst}");
    assert!(alone > 0.2, "{alone}");
}

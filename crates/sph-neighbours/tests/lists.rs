//! The lists against brute force, for random clouds in 2D and 3D, periodic or not.

use proptest::prelude::*;
use sph_core::{Pool, Role, SplitMix, Store, Vect, fields};
use sph_kernels::Kernel;
use sph_kernels::lanes::{Width, force_width};
use sph_neighbours::{CellGrid, Clusters, Domain, World, kernel_sums};

fn cloud<const D: usize>(n: usize, seed: u64) -> Vec<Vect<D>> {
    let mut random = SplitMix(seed);
    let mut place = |_| Vect::from_fn(|_, _| random.unit());
    (0..n).map(&mut place).collect()
}

fn brute<const D: usize>(x: &[Vect<D>], i: usize, reach: f64, domain: &Domain<D>) -> Vec<u32> {
    (0..x.len() as u32)
        .filter(|&j| domain.nearest_image(x[i] - x[j as usize]).norm_squared() < reach * reach)
        .collect()
}

fn check<const D: usize>(n: usize, seed: u64, reach: f64, periodic: [bool; D]) {
    let domain = Domain {
        lower: Vect::zeros(),
        upper: Vect::repeat(1.0),
        periodic,
    };
    let x = cloud::<D>(n, seed);
    let grid = CellGrid::new(&x, reach, &domain);
    // Once unsorted, once in cell order: the sets must be the same.
    let sorted: Vec<Vect<D>> = grid.order().iter().map(|&o| x[o as usize]).collect();
    for points in [&x, &sorted] {
        let grid = CellGrid::new(points, reach, &domain);
        let (mut list, mut clusters, pool) =
            (Clusters::default(), Clusters::default(), Pool::default());
        list.build_each([points; 2], &grid, (reach, &domain), &pool);
        clusters.build([points; 2], &grid, (reach, &domain), &pool, None);
        for i in 0..n {
            let mut row = list.candidates(i).to_vec();
            row.sort_unstable();
            let mut shared = clusters.candidates(i).to_vec();
            assert!(!grid.is_sorted() || shared.is_sorted(), "cluster of {i}");
            shared.sort_unstable();
            shared.dedup();
            assert_eq!(shared.len(), clusters.candidates(i).len(), "cluster of {i}");
            shared.retain(|&j| {
                let apart = domain.nearest_image(points[i] - points[j as usize]);
                apart.norm_squared() < reach * reach
            });
            let brute = brute(points, i, reach, &domain);
            assert_eq!(row, brute, "particle {i}");
            assert_eq!(shared, brute, "cluster of {i}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_list_equals_brute_force_in_2d(
        n in 1usize..300, seed in any::<u64>(), reach in 0.01f64..0.45, px: bool, py: bool,
    ) {
        check::<2>(n, seed, reach, [px, py]);
    }

    #[test]
    fn the_list_equals_brute_force_in_3d(
        n in 1usize..300, seed in any::<u64>(), reach in 0.05f64..0.45, px: bool, pz: bool,
    ) {
        check::<3>(n, seed, reach, [px, false, pz]);
    }
}

fn world(n: usize, seed: u64, order: impl Fn(usize) -> usize) -> World<2> {
    let mut free = Store::new(n);
    free.add(fields::POSITION, Role::State);
    free.add(fields::IDENTITY, Role::State);
    let x = cloud::<2>(n, seed);
    for k in 0..n {
        free.get_mut(fields::POSITION).unwrap()[k] = x[order(k)];
        free.get_mut(fields::IDENTITY).unwrap()[k] = order(k) as u32;
    }
    World {
        free,
        walls: Default::default(),
        lists: Default::default(),
        domain: Domain::open(Vect::zeros(), Vect::repeat(1.0)),
        kernel: sph_kernels::wendland_c2().sampler(2, 0.05),
        spacing: 0.03,
        skin: 0.1,
        gravity: Vect::zeros(),
        steady_gravity: Vect::zeros(),
        driving: Vect::zeros(),
        time: 0.0,
        dt: 0.0,
        transported: Vec::new(),
        extent: None,
        communicator: None,
    }
}

fn sums(world: &mut World<2>) -> Vec<f64> {
    world.refresh_lists().unwrap();
    let n = world.free.len();
    let mut sums = vec![0.0; n];
    kernel_sums(world, &mut sums).unwrap();
    let mut by_identity = vec![0.0; n];
    for (sum, &id) in sums.iter().zip(world.free.get(fields::IDENTITY).unwrap()) {
        by_identity[id as usize] = *sum;
    }
    by_identity
}

#[test]
fn sums_do_not_depend_on_particle_order_beyond_rounding() {
    let n = 2000;
    let straight = sums(&mut world(n, 7, |k| k));
    let backwards = sums(&mut world(n, 7, |k| n - 1 - k));
    for (a, b) in straight.iter().zip(&backwards) {
        assert!((a - b).abs() <= 1e-12 * a, "{a} against {b}");
    }
}

#[test]
fn sums_have_the_same_bits_for_1_2_and_4_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| sums(&mut world(5000, 11, |k| k)))
    };
    let one = on(1);
    for threads in [2, 4] {
        let many = on(threads);
        assert!(
            one.iter()
                .zip(&many)
                .all(|(a, b)| a.to_bits() == b.to_bits())
        );
    }
}

#[test]
fn the_list_stands_until_half_the_skin_is_used_up() {
    let mut world = world(500, 3, |k| k);
    assert!(world.refresh_lists().unwrap());
    let half_skin = 0.5 * world.skin * world.kernel.support_radius();
    world.free.get_mut(fields::POSITION).unwrap()[17].x += 0.99 * half_skin;
    assert!(!world.refresh_lists().unwrap());
    world.free.get_mut(fields::POSITION).unwrap()[17].x += 0.02 * half_skin;
    assert!(world.refresh_lists().unwrap());
}

#[test]
fn sums_have_the_same_bits_for_2_4_and_8_lanes() {
    let mut world = world(5000, 11, |k| k);
    let mut bits = Vec::new();
    for list in [Width::Two, Width::Four, Width::Eight] {
        for sweep in [Width::Two, Width::Four, Width::Eight] {
            force_width(Some(list));
            world.rebuild_lists().unwrap();
            force_width(Some(sweep));
            bits.push(sums(&mut world).into_iter().map(f64::to_bits));
        }
    }
    force_width(None);
    let first: Vec<u64> = bits[0].clone().collect();
    assert!(bits.into_iter().all(|b| b.eq(first.iter().copied())));
}

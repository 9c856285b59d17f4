//! s(x) ∫ s w = 1 next to walls of many shapes, by a quadrature of its own.

use sph_core::Vect;
use sph_kernels::Kernel;
use sph_neighbours::Domain;

use crate::geometry::surface::boxed;
use crate::scale::walls::WallScales;
use crate::{Drawing, PlanarWalls, Polyline, SpatialWalls, WallMesh, WallSetup, WallSpec};

const H: f64 = 1.0;

fn kernel() -> impl Kernel {
    sph_kernels::by_name("wendland-c2").expect("a kernel")
}

fn scales_in<const D: usize, M: WallMesh<D>>(
    domain: Domain<D>,
    walls: &[WallSpec<D>],
) -> WallScales<D, M> {
    let kernel = kernel();
    let setup = WallSetup {
        walls,
        spacing: 0.5 * H,
        smoothing_length: H,
        kernel: &kernel,
        domain: &domain,
    };
    WallScales::new(&setup, &vec![0; walls.len()]).expect("scales")
}

/// s(x) ∫ s w over the places of a fine lattice that are `fluid`.
fn product<const D: usize, M: WallMesh<D>>(
    scales: &WallScales<D, M>,
    x: Vect<D>,
    step: f64,
    fluid: impl Fn(&Vect<D>) -> bool,
) -> f64 {
    let kernel = kernel().sampler(D, H);
    let reach = (kernel.support_radius() / step).ceil() as usize;
    let side = 2 * reach;
    // Cells of the lattice begin at the origin, so that walls at whole steps cut none.
    let base = x.map(|v| (v / step).floor());
    let place = |n: usize| {
        Vect::<D>::from_fn(|k, _| {
            let number = n / side.pow(k as u32) % side;
            (base[k] + number as f64 - reach as f64 + 0.5) * step
        })
    };
    let mut places: Vec<Vect<D>> = (0..side.pow(D as u32)).map(place).collect();
    places.retain(fluid);
    places.push(x);
    let found = scales_at(scales, &places);
    let n = places.len() - 1;
    let values = places[..n].iter().zip(&found);
    let values = values.map(|(y, scale)| scale * kernel.at((y - x).norm()).0);
    found[n] * (values.sum::<f64>() * step.powi(D as i32))
}

fn scales_at<const D: usize, M: WallMesh<D>>(
    scales: &WallScales<D, M>,
    places: &[Vect<D>],
) -> Vec<f64> {
    let (mut found, mut slopes) = (Vec::new(), Vec::new());
    scales.at(places, &[], &mut found, &mut slopes);
    found.into_iter().map(|at| at.scale).collect()
}

/// Checks s(x) ∫ s w = 1 at places next to walls to an error, on a lattice of a step.
fn check<const D: usize, M: WallMesh<D>>(
    walls: &[WallSpec<D>],
    [step, most]: [f64; 2],
    places: &[[f64; D]],
    fluid: impl Fn(&Vect<D>) -> bool,
) {
    let domain = Domain::open(Vect::repeat(-100.0), Vect::repeat(100.0));
    let scales = scales_in::<D, M>(domain, walls);
    for x in places {
        let whole = product(&scales, (*x).into(), step, &fluid);
        assert!((whole - 1.0).abs() < most, "{x:?}: {whole}");
    }
}

fn closed(corners: Vec<[f64; 2]>) -> [WallSpec<2>; 1] {
    let line = Polyline::closed("wall", corners);
    [WallSpec::at_rest(Drawing::Line(line))]
}

#[test]
fn a_corner_of_a_tank_is_a_product() {
    let tank = closed(vec![[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]]);
    let places = [[0.2, 0.2], [0.5, 0.1], [1.0, 0.6], [1.5, 1.5], [5.0, 0.3]];
    let fluid = |y: &Vect<2>| y[0] > 0.0 && y[1] > 0.0;
    check::<2, PlanarWalls>(&tank, [0.02, 3e-3], &places, fluid);
}

#[test]
fn a_block_has_a_map() {
    let block = closed(vec![[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0]]);
    let inside = |v: f64| (0.0..4.0).contains(&v);
    let places = [
        [-0.3, 2.0],
        [-0.3, -0.3],
        [-0.1, 0.4],
        [2.0, -1.0],
        [4.4, 4.0],
        [-1.5, 4.2],
    ];
    let fluid = |y: &Vect<2>| !(inside(y[0]) && inside(y[1]));
    check::<2, PlanarWalls>(&block, [0.02, 1e-2], &places, fluid);
}

#[test]
fn a_step_in_a_tank_has_a_map_beside_flat_faces() {
    let tank = closed(vec![
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 3.0],
        [20.0, 3.0],
        [20.0, 20.0],
        [0.0, 20.0],
    ]);
    let fluid = |y: &Vect<2>| {
        let over = y[0] < 8.0 || y[1] > 3.0;
        y[0] > 0.0 && y[0] < 20.0 && y[1] > 0.0 && over
    };
    let places = [
        [7.7, 0.3],
        [7.7, 3.0],
        [8.3, 3.3],
        [12.0, 3.2],
        [0.3, 0.5],
        [19.7, 3.3],
    ];
    check::<2, PlanarWalls>(&tank, [0.02, 1e-2], &places, fluid);
}

#[test]
fn a_slope_has_a_map() {
    let tank = closed(vec![[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [-20.0, 20.0]]);
    let places = [[0.3, 0.2], [0.0, 0.6], [-0.6, 1.2], [-3.0, 3.5]];
    let fluid = |y: &Vect<2>| y[1] > 0.0 && y[0] + y[1] > 0.0;
    check::<2, PlanarWalls>(&tank, [0.01, 1e-2], &places, fluid);
}

/// A floor with a ridge at the border of a periodic box: s is the same on both sides, and that of a floor far from it.
#[test]
fn a_floor_goes_on_across_periodic_borders() {
    let mut domain = Domain::open(Vect::<2>::new(0.0, -1.0), Vect::<2>::new(16.0, 20.0));
    domain.periodic[0] = true;
    let flat = Polyline::open("floor", vec![[0.0, 0.0], [16.0, 0.0]]);
    let ridge = vec![[0.0, 1.0], [1.0, 0.0], [15.0, 0.0], [16.0, 1.0]];
    let [flat, ridge] = [flat, Polyline::open("ridge", ridge)].map(|line| {
        scales_in::<2, PlanarWalls>(domain.clone(), &[WallSpec::at_rest(Drawing::Line(line))])
    });
    let at = |scales: &WallScales<2, PlanarWalls>, x: [f64; 2]| scales_at(scales, &[x.into()])[0];
    for x in [0.01, 0.4, 8.0, 15.3, 15.99] {
        assert!((at(&flat, [x, 0.25]) - 1.264_273).abs() < 1e-5, "{x}");
    }
    assert!((at(&ridge, [8.0, 0.25]) - 1.264_273).abs() < 1e-5);
    let [left, right] = [[0.3, 1.0], [15.7, 1.0]].map(|x| at(&ridge, x));
    assert!((left / right - 1.0).abs() < 2e-3, "{left} {right}");
    let [before, after] = [[15.999, 1.2], [0.001, 1.2]].map(|x| at(&ridge, x));
    assert!((before / after - 1.0).abs() < 2e-3, "{before} {after}");
}

#[test]
fn a_block_on_the_floor_of_a_tank_has_a_map_in_space() {
    let walls = [
        boxed("tank", [0.0; 3], [12.0, 10.0, 8.0]).reversed(),
        boxed("block", [5.0, 4.0, 0.0], [6.0, 6.0, 1.5]),
    ];
    let walls = walls.map(|surface| WallSpec::at_rest(Drawing::Surface(surface)));
    let inside =
        |y: &Vect<3>| (5.0..6.0).contains(&y[0]) && (4.0..6.0).contains(&y[1]) && y[2] < 1.5;
    let fluid = |y: &Vect<3>| y.iter().all(|v| *v > 0.0) && !inside(y);
    let places = [
        [0.3, 0.3, 0.3],
        [4.8, 5.0, 0.2],
        [4.8, 3.8, 1.6],
        [5.5, 5.0, 1.8],
        [6.5, 4.0, 0.5],
    ];
    check::<3, SpatialWalls>(&walls, [0.05, 1.2e-2], &places, fluid);
}

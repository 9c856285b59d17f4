//! s(x) ∫ s w = 1 next to walls of many shapes, by a quadrature of its own.

use sph_core::Vect;
use sph_kernels::Kernel;
use sph_neighbours::{Domain, Frame};

use crate::geometry::wall_mesh::WallMesh;
use crate::scale::walls::WallScales;
use crate::{
    Drawing, PlanarWalls, Polyline, RigidMotion, SpatialWalls, Surface, WallCondition, WallSetup,
    WallSpec,
};

const H: f64 = 1.0;

fn kernel() -> impl Kernel {
    sph_kernels::by_name("wendland-c2").expect("a kernel")
}

fn spec<const D: usize>(drawing: Drawing) -> WallSpec<D> {
    WallSpec {
        drawing,
        condition: WallCondition::NoSlip,
        surface_velocity: Vect::zeros(),
        motion: RigidMotion::default(),
        mover: None,
        open: false,
    }
}

fn scales<const D: usize, M: WallMesh<D>>(walls: &[WallSpec<D>]) -> WallScales<D, M> {
    let domain = Domain::open(Vect::repeat(-100.0), Vect::repeat(100.0));
    scales_in(domain, walls)
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
    let all = (0..side.pow(D as u32)).map(place).filter(|y| fluid(y));
    let mut places: Vec<Vect<D>> = all.collect();
    let sum = |places: &[Vect<D>], found: &[crate::scale::walls::ScaleAt<D>]| {
        let values = places.iter().zip(found);
        let values = values.map(|(y, at)| at.scale * kernel.at((y - x).norm()).0);
        values.sum::<f64>() * step.powi(D as i32)
    };
    places.push(x);
    let (mut found, mut slopes) = (Vec::new(), Vec::new());
    let frames: [Frame<D>; 0] = [];
    scales.at(&places, &frames, &mut found, &mut slopes);
    let n = places.len() - 1;
    found[n].scale * sum(&places[..n], &found[..n])
}

#[test]
fn a_corner_of_a_tank_is_a_product() {
    let corners = vec![[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];
    let tank = [spec(Drawing::Line(Polyline::closed("tank", corners)))];
    let scales = scales::<2, PlanarWalls>(&tank);
    for x in [[0.2, 0.2], [0.5, 0.1], [1.0, 0.6], [1.5, 1.5], [5.0, 0.3]] {
        let whole = product(&scales, x.into(), 0.02, |y| y[0] > 0.0 && y[1] > 0.0);
        assert!((whole - 1.0).abs() < 3e-3, "{x:?}: {whole}");
    }
}

#[test]
fn a_block_has_a_map() {
    let corners = vec![[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0]];
    let block = [spec(Drawing::Line(Polyline::closed("block", corners)))];
    let scales = scales::<2, PlanarWalls>(&block);
    let inside = |v: f64| (0.0..4.0).contains(&v);
    for x in [
        [-0.3, 2.0],
        [-0.3, -0.3],
        [-0.1, 0.4],
        [2.0, -1.0],
        [4.4, 4.0],
        [-1.5, 4.2],
    ] {
        let whole = product(&scales, x.into(), 0.02, |y| !(inside(y[0]) && inside(y[1])));
        assert!((whole - 1.0).abs() < 1e-2, "{x:?}: {whole}");
    }
}

#[test]
fn a_step_in_a_tank_has_a_map_beside_flat_faces() {
    let corners = vec![
        [0.0, 0.0],
        [8.0, 0.0],
        [8.0, 3.0],
        [20.0, 3.0],
        [20.0, 20.0],
        [0.0, 20.0],
    ];
    let tank = [spec(Drawing::Line(Polyline::closed("tank", corners)))];
    let scales = scales::<2, PlanarWalls>(&tank);
    let fluid = |y: &Vect<2>| {
        let over = y[0] < 8.0 || y[1] > 3.0;
        y[0] > 0.0 && y[0] < 20.0 && y[1] > 0.0 && over
    };
    for x in [
        [7.7, 0.3],
        [7.7, 3.0],
        [8.3, 3.3],
        [12.0, 3.2],
        [0.3, 0.5],
        [19.7, 3.3],
    ] {
        let whole = product(&scales, x.into(), 0.02, fluid);
        assert!((whole - 1.0).abs() < 1e-2, "{x:?}: {whole}");
    }
}

#[test]
fn a_slope_has_a_map() {
    let corners = vec![[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [-20.0, 20.0]];
    let tank = [spec(Drawing::Line(Polyline::closed("tank", corners)))];
    let scales = scales::<2, PlanarWalls>(&tank);
    for x in [[0.3, 0.2], [0.0, 0.6], [-0.6, 1.2], [-3.0, 3.5]] {
        let fluid = |y: &Vect<2>| y[1] > 0.0 && y[0] + y[1] > 0.0;
        let whole = product(&scales, x.into(), 0.01, fluid);
        assert!((whole - 1.0).abs() < 1e-2, "{x:?}: {whole}");
    }
}

fn box_of(low: [f64; 3], high: [f64; 3], name: &str, outside: bool) -> Drawing {
    let corner = |n: usize| [0, 1, 2].map(|k| if n >> k & 1 == 1 { high[k] } else { low[k] });
    // Seen from inside, anticlockwise.
    let faces = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    let triangles = faces
        .iter()
        .flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]);
    let turned = |t: [u32; 3]| if outside { [t[0], t[2], t[1]] } else { t };
    Drawing::Surface(Surface {
        name: name.into(),
        points: (0..8).map(corner).collect(),
        triangles: triangles.map(turned).collect(),
    })
}

/// A floor with a ridge at the border of a periodic box: s is the same on both sides, and that of a floor far from it.
#[test]
fn a_floor_goes_on_across_periodic_borders() {
    let mut domain = Domain::open(Vect::<2>::new(0.0, -1.0), Vect::<2>::new(16.0, 20.0));
    domain.periodic[0] = true;
    let flat = Polyline::open("floor", vec![[0.0, 0.0], [16.0, 0.0]]);
    let ridge = vec![[0.0, 1.0], [1.0, 0.0], [15.0, 0.0], [16.0, 1.0]];
    let [flat, ridge] = [flat, Polyline::open("ridge", ridge)]
        .map(|line| scales_in::<2, PlanarWalls>(domain.clone(), &[spec(Drawing::Line(line))]));
    let at = |scales: &WallScales<2, PlanarWalls>, x: [f64; 2]| {
        let (mut found, mut slopes) = (Vec::new(), Vec::new());
        scales.at(&[x.into()], &[], &mut found, &mut slopes);
        found[0].scale
    };
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
        spec(box_of([0.0; 3], [12.0, 10.0, 8.0], "tank", false)),
        spec(box_of([5.0, 4.0, 0.0], [6.0, 6.0, 1.5], "block", true)),
    ];
    let scales = scales::<3, SpatialWalls>(&walls);
    let inside =
        |y: &Vect<3>| (5.0..6.0).contains(&y[0]) && (4.0..6.0).contains(&y[1]) && y[2] < 1.5;
    let fluid = |y: &Vect<3>| y.iter().all(|v| *v > 0.0) && !inside(y);
    for x in [
        [0.3, 0.3, 0.3],
        [4.8, 5.0, 0.2],
        [4.8, 3.8, 1.6],
        [5.5, 5.0, 1.8],
        [6.5, 4.0, 0.5],
    ] {
        let whole = product(&scales, x.into(), 0.05, fluid);
        assert!((whole - 1.0).abs() < 1.2e-2, "{x:?}: {whole}");
    }
}

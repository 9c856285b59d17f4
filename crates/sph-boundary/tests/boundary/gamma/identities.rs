//! What must hold without any reference.

use sph_boundary::{ElementTree, Mesh, PeriodicBox, Polyline, Pose, Renormalisation2d};

use crate::close;
use crate::gamma::scene::{H, Scene};
use crate::random::Random;

const TANK: [[f64; 2]; 5] = [[0.0, 0.0], [5.0, 0.5], [6.0, 5.0], [3.0, 2.5], [-0.5, 6.0]];

fn points(scene: &Scene, count: usize) -> Vec<[f64; 2]> {
    let mut random = Random(4);
    let place = || [random.between(-1.0, 6.0), random.between(0.0, 6.0)];
    let inside = std::iter::repeat_with(place).filter(|p| scene.mesh.contains(*p));
    inside.take(count).collect()
}

#[test]
fn gradient_is_that_of_gamma() {
    let scene = Scene::new(vec![TANK.to_vec()], 0.3);
    let step = 1e-4;
    for [x, y] in points(&scene, 60) {
        let gammas = |[dx, dy]: [f64; 2]| -> Vec<f64> {
            let sums = scene.sums([x + dx, y + dy]);
            sums.iter().map(|s| s.gamma()).collect()
        };
        let around = |d: f64| [[d, 0.0], [-d, 0.0], [0.0, d], [0.0, -d]].map(gammas);
        let (near, far) = (around(step), around(2.0 * step));
        for (k, sum) in scene.sums([x, y]).iter().enumerate() {
            for axis in 0..2 {
                let slope = |g: &[Vec<f64>; 4]| g[2 * axis][k] - g[2 * axis + 1][k];
                let difference = (8.0 * slope(&near) - slope(&far)) / (12.0 * step);
                close(difference, sum.gradient[axis], 1e-7, [x, y]);
            }
        }
    }
}

#[test]
fn cutting_a_wall_finer_changes_nothing() {
    let scenes = [0.9, 0.3, 0.05, 0.004].map(|spacing| Scene::new(vec![TANK.to_vec()], spacing));
    let mut largest: Vec<f64> = vec![0.0; scenes[0].sums([1.0; 2]).len()];
    for point in points(&scenes[0], 200) {
        let coarse = scenes[0].sums(point);
        for scene in &scenes[1..3] {
            for (k, fine) in scene.sums(point).iter().enumerate() {
                largest[k] = largest[k].max((fine.gamma() - coarse[k].gamma()).abs());
            }
        }
        for (k, fine) in scenes[3].sums(point).iter().enumerate() {
            close(fine.gamma(), coarse[k].gamma(), 1e-12, "segments of h/175");
        }
    }
    println!("finer cutting changes γ by {largest:?}");
    // The quintic and septic splines have the largest coefficients of the closed form.
    for (k, error) in largest.iter().enumerate() {
        let tolerance = if k == 5 || k == 6 { 5e-14 } else { 1e-14 };
        assert!(*error <= tolerance, "kernel {k}: {error:e}");
    }
}

/// A vertex on a straight wall switched on and off, seen from everywhere, from itself too.
#[test]
fn a_collinear_vertex_changes_nothing() {
    let mut corners = TANK.to_vec();
    let plain = Scene::new(vec![corners.clone()], 9.0);
    corners.insert(1, [2.5, 0.25]);
    let split = Scene::new(vec![corners], 9.0);
    assert_eq!(split.mesh.nodes.len(), plain.mesh.nodes.len() + 1);
    let mut seen = points(&plain, 100);
    seen.extend([
        [2.5, 0.25],
        [2.5 + 1e-14, 0.25],
        [2.5, 0.25 - 1e-15],
        [2.0, 0.2],
    ]);
    for point in seen {
        for (a, b) in plain.sums(point).iter().zip(split.sums(point)) {
            close(a.gamma(), b.gamma(), 1e-13, point);
        }
    }
}

#[test]
fn mirrored_rotated_and_moved_walls_give_the_same() {
    let scene = Scene::new(vec![TANK.to_vec()], 0.3);
    let mirrored = TANK.iter().rev().map(|[x, y]| [-x, *y]).collect();
    let mirror = Scene::new(vec![mirrored], 0.3);
    let pose = Pose {
        translation: [-3.0, 1.5],
        ..Pose::turned_about([0.0, 0.0, 1.0], 1.1, [2.0, 1.0])
    };
    let map = pose.map();
    let line = Polyline::closed("wall", TANK.to_vec());
    let mut moved = Mesh::<2>::build(&[line], 0.3, &PeriodicBox::none()).unwrap();
    moved.move_walls(&[pose]).unwrap();
    let shape = sph_kernels::wendland_c2().shape().clone();
    let renormalisation = Renormalisation2d::new(&shape, H).unwrap();
    let tree = ElementTree::build(&moved, renormalisation.kernel_radius());
    for point in points(&scene, 200) {
        let here = scene.sums(point);
        let there = mirror.sums([-point[0], point[1]]);
        for (a, b) in here.iter().zip(&there) {
            close(a.gamma(), b.gamma(), 1e-13, point);
            close(a.gradient[0], -b.gradient[0], 1e-12, point);
        }
        let turned = renormalisation.at(map(point), &moved, &tree);
        close(
            turned.gamma(),
            here[0].gamma(),
            5e-14,
            "a few roundings of 6 m",
        );
        let [length, own] = [turned, here[0]].map(|s| s.gradient[0].hypot(s.gradient[1]));
        close(length, own, 1e-13, point);
    }
}

#[test]
fn gamma_is_exactly_one_away_from_walls() {
    let square = vec![[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]];
    let scene = Scene::new(vec![square], 0.3);
    for point in [[10.0, 10.0], [4.0 * H, 10.0], [4.0, 17.0]] {
        for sum in scene.sums(point) {
            assert_eq!((sum.gamma(), sum.gradient), (1.0, [0.0; 2]));
        }
    }
}

/// A channel drawn as two open lines across a period is the middle of a long one.
#[test]
fn a_periodic_wall_has_no_seam() {
    let domain = PeriodicBox {
        lower: [0.0; 2],
        upper: [5.0, 1.5],
        periodic: [true, false],
    };
    let floor = Polyline::open("floor", vec![[0.0, 0.0], [2.0, 0.2], [5.0, 0.0]]);
    let lid = Polyline::open("lid", vec![[5.0, 1.5], [0.0, 1.5]]);
    let mesh = Mesh::<2>::build(&[floor, lid], 0.25, &domain).unwrap();
    assert!(mesh.free_ends.is_empty());
    let mut long = vec![];
    for k in -2..3 {
        let x = 5.0 * f64::from(k);
        long.extend([[x, 0.0], [x + 2.0, 0.2]]);
    }
    long.extend([[15.0, 0.0], [15.0, 1.5], [-10.0, 1.5]]);
    let scene = Scene::new(vec![long], 0.25);
    let renormalisation = Renormalisation2d::new(sph_kernels::wendland_c2().shape(), H).unwrap();
    let tree = ElementTree::build(&mesh, renormalisation.kernel_radius());
    let seam = [
        0.0,
        1e-300,
        1e-17,
        1e-16,
        1e-12,
        5.0 - 1e-13,
        5.0f64.next_down(),
    ];
    for x in seam.into_iter().chain([0.3, 2.0, 4.9]) {
        for y in [0.0, 1e-17, 1e-9, 0.3, 1.0, 1.5 - 1e-12, 1.5] {
            if !mesh.contains([x, y]) && (x - 2.5f64).abs() < 2.4 {
                continue;
            }
            let here = renormalisation.at([x, y], &mesh, &tree).gamma();
            close(here, scene.sums([x, y])[0].gamma(), 1e-14, [x, y]);
        }
    }
}

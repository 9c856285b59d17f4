//! Closed polygons: a gear, and blocks that touch.

use crate::close;
use crate::gamma::scene::{Errors, H, Scene, tank};
use crate::random::Random;

fn gear(teeth: usize) -> Vec<[f64; 2]> {
    let corner = |i: usize| {
        let radius = if i % 4 < 2 { 2.0 } else { 1.5 };
        let turn = std::f64::consts::TAU * (i as f64 + 0.3) / (4 * teeth) as f64;
        [0.1 + radius * turn.cos(), radius * turn.sin() - 0.2]
    };
    (0..4 * teeth).map(corner).collect()
}

#[test]
fn inside_and_outside_of_a_gear() {
    let mut random = Random(3);
    let mut errors = Errors::default();
    let holding = Scene::new(vec![gear(9)], 0.1);
    let immersed = Scene::new(vec![tank(), gear(9).into_iter().rev().collect()], 0.3);
    let mut compared = 0;
    while compared < 60 {
        let point = [random.between(-3.0, 3.0), random.between(-3.0, 3.0)];
        for scene in [&holding, &immersed] {
            if scene.mesh.contains(point) {
                scene.compare(point, &mut errors);
                compared += 1;
            }
        }
    }
    for vertex in holding.mesh.nodes.iter().step_by(7) {
        let [x, y] = vertex.position;
        for d in [0.0, 1e-12, 1e-8, 1e-4] {
            holding.compare([x + d * H, y - 0.3 * d * H], &mut errors);
            immersed.compare([x + d * H, y - 0.3 * d * H], &mut errors);
        }
    }
    errors.check("gear");
}

/// The faces in contact cancel, though they are cut differently.
#[test]
fn a_block_on_a_floor() {
    let tank = vec![[-9.0, 0.0], [9.0, 0.0], [9.0, 9.0], [-9.0, 9.0]];
    let block = vec![[0.0, 0.0], [0.0, 1.0], [1.3, 1.0], [1.3, 0.0]];
    let mut step = tank.clone();
    step.splice(1..1, block.iter().copied());
    let scene = Scene::new(vec![tank, block], 0.37);
    let alone = Scene::new(vec![step], 0.37);
    for point in [
        [0.0, 0.0],
        [-1e-14, 1e-13],
        [-0.2, 0.1],
        [1.3, 0.0],
        [0.0, 0.5],
        [-0.4, 0.0],
    ] {
        for (a, b) in scene.sums(point).iter().zip(alone.sums(point)) {
            close(a.gamma(), b.gamma(), crate::gamma::TOLERANCE, point);
        }
    }
}

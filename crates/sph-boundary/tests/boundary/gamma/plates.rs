//! Thin plates with fluid on both sides.

use sph_boundary::thin_plate;

use crate::gamma::scene::{Errors, H, Scene, tank};
use crate::random::Random;

#[test]
fn plates_of_every_thickness() {
    let mut random = Random(2);
    let mut errors = Errors::default();
    let middle = [[-0.8, 0.1], [0.9, 0.3], [1.4, 1.5]];
    for thickness in [0.0, 1e-12, 1e-6, 0.1, 1.0] {
        let plate = thin_plate("plate", &middle, thickness * H).unwrap().points;
        let scene = Scene::new(vec![tank(), plate.clone()], 0.4 * H);
        let mut points: Vec<[f64; 2]> = plate.clone();
        points.extend(scene.mesh.nodes.iter().rev().take(12).map(|v| v.position));
        for (i, [x, y]) in plate.iter().enumerate() {
            for distance in [1e-12, 1e-9, 1e-6, 1e-3, 1e-1, 1.0] {
                let turn = random.between(0.0, std::f64::consts::TAU);
                let d = distance * H;
                points.push([x + d * turn.cos(), y + d * turn.sin()]);
                // Off the faces, on both sides, and on them.
                let [u, v] = plate[(i + 1) % plate.len()];
                let along = random.between(0.0, 1.0);
                let [p, q] = [x + along * (u - x), y + along * (v - y)];
                points.extend([[p, q + d], [p, q - d], [p, q]]);
            }
        }
        points.extend([0; 20].map(|_| [0; 2].map(|_| random.between(-3.0, 3.0))));
        for point in points {
            // Deep in the solid γ vanishes and is taken for 1 by convention.
            if scene.mesh.contains(point) || thickness < 0.5 {
                scene.compare(point, &mut errors);
            }
        }
    }
    errors.check("plates");
}

#[test]
fn fluid_angles_of_a_plate_of_zero_thickness() {
    let plate = thin_plate("plate", &[[0.0, 0.0], [2.0, 1.0]], 0.0).unwrap();
    let scene = Scene::new(vec![tank(), plate.points], 0.5);
    let of_plate = scene.mesh.nodes.iter().filter(|v| v.wall == 1);
    let mut thetas: Vec<f64> = of_plate.map(|v| v.theta).collect();
    thetas.sort_by(f64::total_cmp);
    // Three per side and two ends.
    assert_eq!(thetas, [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1.0, 1.0]);
    for sum in scene.sums([1.0, 0.5]) {
        assert_eq!(sum.contact_fraction, 1.0, "half the fluid on each side");
        assert!((sum.gamma() - 1.0).abs() < 1e-13);
    }
}

//! Wedges of 10°, 20°, … 350°, at all distances from the faces and the vertex.

use crate::gamma::scene::{Errors, H, Scene};
use crate::random::Random;

/// A wedge of the given angle, closed far away.
fn wedge(vertex: [f64; 2], first_arm: f64, angle: f64) -> Vec<[f64; 2]> {
    let far = |k: i32| {
        let direction = first_arm + angle * f64::from(k) / 8.0;
        [
            vertex[0] + 10.0 * H * direction.cos(),
            vertex[1] + 10.0 * H * direction.sin(),
        ]
    };
    std::iter::once(vertex).chain((0..=8).map(far)).collect()
}

#[test]
fn every_wedge_at_every_distance() {
    let mut random = Random(1);
    let mut errors = Errors::default();
    for tens in 1..=35 {
        let angle = f64::from(10 * tens).to_radians();
        let vertex = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        let arm = random.between(0.0, 6.0);
        let scene = Scene::new(
            vec![wedge(vertex, arm, angle)],
            random.between(0.2, 0.9) * H,
        );
        let polar = |r: f64, phi: f64| [vertex[0] + r * phi.cos(), vertex[1] + r * phi.sin()];
        let mut points = vec![vertex];
        for _ in 0..4 {
            points.push(polar(
                random.between(0.0, 3.5 * H),
                arm + angle * random.between(0.0, 1.0),
            ));
        }
        for distance in [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0] {
            let d = distance * H;
            points.push(polar(d, arm + angle * random.between(0.0, 1.0)));
            // Close to both faces, and at random places of them.
            for (face, side) in [(arm, 1.0), (arm + angle, -1.0)] {
                let [x, y] = polar(random.between(0.0, 2.0) * H, face);
                points.push([x - side * d * face.sin(), y + side * d * face.cos()]);
            }
        }
        // A rounding error on the other side.
        let [x, y] = polar(0.6 * H, arm);
        points.push([x + 1e-16 * arm.sin(), y - 1e-16 * arm.cos()]);
        // Vertices between two collinear segments, and their surroundings.
        for vertex in &scene.mesh.nodes[1..3] {
            let [x, y] = vertex.position;
            points.push([x, y]);
            points.push([x + 1e-13 * H, y - 2e-13 * H]);
            points.push([x - 1e-16, y + 1e-16]);
        }
        for point in points {
            scene.compare(point, &mut errors);
        }
    }
    errors.check("wedges");
}

//! Walls that accelerate: the pressure of the fluid in a box that is taken along.

use crate::walls::bench::{Flowing, flowing};

/// A closed box full of fluid, without gravity, that accelerates along x, or with changes of that.
fn full_box(treatment: &str, changes: &str) -> Flowing<2> {
    let walls = format!("walls={{{treatment}={{}}}}");
    flowing(include_str!("full-box.toml"), &[&walls, changes])
}

/// Slope of the pressure along x by least squares, Pa/m.
fn slope(places: &[f64], pressures: &[f64]) -> f64 {
    let n = places.len() as f64;
    let mean = |v: &[f64]| v.iter().sum::<f64>() / n;
    let (x, p) = (mean(places), mean(pressures));
    let pairs = places.iter().zip(pressures);
    let (mut over, mut under) = (0.0, 0.0);
    for (xi, pi) in pairs {
        over += (xi - x) * (pi - p);
        under += (xi - x).powi(2);
    }
    over / under
}

#[test]
fn in_a_box_that_accelerates_the_pressure_falls_by_density_times_acceleration_to_4_per_cent() {
    for treatment in ["usaw", "dummy-particles"] {
        let acceleration = 5.0;
        let mut flow = full_box(treatment, "");
        flow.until(0.3);
        let ([mut inside, mut at_wall, mut force], mut count) = ([0.0; 3], 0.0);
        while flow.0.flow.world.time < 0.6 {
            flow.step();
            let x: Vec<f64> = flow.positions().iter().map(|x| x[0]).collect();
            inside += slope(&x, flow.pressures());
            let points = &flow.0.flow.world.walls.points;
            let places = points.position.iter().zip(&points.pressure);
            // Dummies that see no fluid have no pressure.
            let (x, p): (Vec<f64>, Vec<f64>) = places
                .filter(|(_, p)| **p != 0.0)
                .map(|(x, p)| (x[0], *p))
                .unzip();
            at_wall += slope(&x, &p);
            force += flow.force("box").force[0];
            count += 1.0;
        }
        let expected = -1000.0 * acceleration * count;
        let force = force / count / (-flow.mass() * acceleration);
        let [inside, at_wall] = [inside, at_wall].map(|s| s / expected);
        println!("{treatment}: {inside:.4} inside, {at_wall:.4} at the wall, force {force:.4}");
        assert!((inside - 1.0).abs() < 0.04, "{treatment}: {inside}");
        assert!((at_wall - 1.0).abs() < 0.04, "{treatment}: {at_wall}");
        assert!((force - 1.0).abs() < 0.04, "{treatment}: {force}");
        assert_eq!(flow.escaped(), 0);
    }
}

/// Along x = 0.1 m sin(2πt/T) with the velocity of the start: the fluid goes with the box.
#[test]
fn a_shaken_box_keeps_its_particles_which_move_by_an_eighth_of_its_speed_at_most() {
    for treatment in ["usaw", "dummy-particles"] {
        let shaken = "wall.box.motion.translate={along=[1.0,0.0],sine={amplitude=0.1,period=0.5}} \
                      body.fluid.velocity=[1.2566370614359172,0.0]";
        let mut flow = full_box(treatment, shaken);
        let count = flow.positions().len();
        let mut fastest: f64 = 0.0;
        while flow.0.flow.world.time < 1.0 {
            flow.step();
            let wall = flow.0.flow.world.walls.points.velocity[0];
            let speeds = flow.velocities().iter().map(|u| (u - wall).norm());
            fastest = speeds.fold(fastest, f64::max);
            assert_eq!(flow.escaped(), 0);
        }
        assert_eq!(flow.positions().len(), count);
        println!("{treatment}: {fastest:.3} m/s against the box");
        assert!(fastest < 0.157, "{treatment}: {fastest} m/s");
    }
}

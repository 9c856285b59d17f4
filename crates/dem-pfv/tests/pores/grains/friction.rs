//! Sliding and rolling on planes.

use dem_pfv::grains::{Grain, GrainSystem, LinearElastic, RollingResistance, Setup, Vector};

use crate::close;
use crate::grains::{GRAVITY, RADIUS, STIFFNESS, floor, grain, law, run, spin, velocity};

/// A ball in equilibrium on a slope of the angle θ that falls towards +x.
fn on_slope(law: LinearElastic, angle: f64, ball: impl Fn(Grain) -> Grain) -> GrainSystem {
    let weight = GRAVITY * angle.cos();
    let ball = ball(grain(0.0, 0.0, RADIUS - weight / STIFFNESS));
    let gravity = [GRAVITY * angle.sin(), 0.0, -weight];
    let setup = Setup::new(vec![ball], law)
        .walls([floor()])
        .gravity(gravity);
    GrainSystem::new(setup).expect("a ball")
}

/// Arms are shorter than R by half the overlap, so that all ratios are off by δ/R at most.
fn depth() -> f64 {
    GRAVITY / STIFFNESS / RADIUS
}

#[test]
fn a_sliding_ball_ends_rolling_at_five_sevenths() {
    let speed = 0.5;
    let mut system = on_slope(law(0.5, 0.3, 0.1), 0.0, |g| g.moving([speed, 0.0, 0.0]));
    let slides = 2.0 * speed / (7.0 * 0.3 * GRAVITY);
    let step = 0.2 * system.critical_step();
    // While it slides it loses µ g.
    let steps = (0.5 * slides / step) as usize;
    run(&mut system, step, steps);
    let slid = |system: &GrainSystem| system.contacts().map(|c| c.sliding).collect::<Vec<_>>();
    assert_eq!(slid(&system), [true]);
    let braking = 0.3 * GRAVITY;
    let left = speed - braking * system.time;
    close(velocity(&system, 0).x, left, braking * 2.0 * step);
    run(&mut system, step, 6 * steps);
    assert_eq!(slid(&system), [false]);
    let rolling = 5.0 / 7.0 * speed;
    close(velocity(&system, 0).x, rolling, depth() * rolling);
    close(spin(&system, 0).y * RADIUS, rolling, depth() * rolling);
}

/// Before it accelerates evenly the spring takes up F = 2/7 m g sin θ, which costs F/k_t of the way at most.
#[test]
fn a_ball_rolls_down_at_five_sevenths() {
    let friction: f64 = 0.3;
    let angle = (0.9 * 3.5 * friction).atan();
    let mut system = on_slope(law(0.5, friction, 0.1), angle, |g| g);
    let step = 0.2 * system.critical_step();
    run(&mut system, step, 4000);
    let time = system.time - 0.5 * step;
    let acceleration = 5.0 / 7.0 * GRAVITY * angle.sin();
    let spring = 2.0 / 7.0 * GRAVITY * angle.sin() / (0.5 * STIFFNESS);
    let expected = acceleration * time;
    let error = depth() * expected + spring / time;
    close(velocity(&system, 0).x, expected, error);
}

#[test]
fn beyond_seven_halves_of_the_friction_it_slips() {
    let friction: f64 = 0.2;
    let angle = (1.2 * 3.5 * friction).atan();
    let mut system = on_slope(law(0.5, friction, 0.0), angle, |g| g);
    let step = 0.2 * system.critical_step();
    run(&mut system, step, 4000);
    let time = system.time - 0.5 * step;
    let acceleration = GRAVITY * (angle.sin() - friction * angle.cos());
    // The spring is taut after µ F_n / k_t.
    let spring = friction * GRAVITY / (0.5 * STIFFNESS);
    let expected = acceleration * time;
    let error = spring / time + depth() * expected;
    close(velocity(&system, 0).x, expected, error);
    let turning = 2.5 * friction * GRAVITY * angle.cos() / RADIUS * time;
    let error = 3.0 * (spring / time / RADIUS + depth() * turning);
    close(spin(&system, 0).y, turning, error);
}

fn resisting(coefficient: f64) -> LinearElastic {
    let rolling = RollingResistance {
        coefficient,
        stiffness: 1.0,
    };
    LinearElastic {
        rolling: Some(rolling),
        ..law(0.5, 1.0, 0.2)
    }
}

/// It stays up to tan θ = η and rolls at 5/7 g cos θ (tan θ − η) beyond.
#[test]
fn rolling_resistance_holds_up_to_its_angle() {
    let eta: f64 = 0.2;
    let mut held = on_slope(resisting(eta), (0.98 * eta).atan(), |g| g);
    held.set_damping(0.3).expect("damping");
    let step = 0.2 * held.critical_step();
    run(&mut held, step, 20_000);
    // What is left of a swing is far below the speed gained in one step of free rolling.
    close(velocity(&held, 0).norm(), 0.0, 1e-3 * GRAVITY * step);

    let angle = (1.5 * eta).atan();
    let mut rolling = on_slope(resisting(eta), angle, |g| g);
    run(&mut rolling, step, 20_000);
    let time = rolling.time - 0.5 * step;
    let expected = 5.0 / 7.0 * GRAVITY * angle.cos() * (angle.tan() - eta) * time;
    // Both springs must first be taut: the rolling one after θ R = η R F_n / (k_t R).
    let springs = (eta + 2.0 / 7.0 * angle.tan()) * GRAVITY / (0.5 * STIFFNESS);
    let error = 3.0 * depth() * expected + 3.0 * springs / time;
    close(velocity(&rolling, 0).x, expected, error);
}

/// A spinning top on a flat floor: spin about the normal meets no resistance.
#[test]
fn spin_about_the_normal_is_free() {
    let mut system = on_slope(law(0.5, 0.3, 0.0), 0.0, |g| Grain {
        spin: Vector::new(0.0, 0.0, 5.0),
        ..g
    });
    let step = 0.2 * system.critical_step();
    run(&mut system, step, 1000);
    assert_eq!(spin(&system, 0).z, 5.0);
    // The orientation turned by ω t, within the third order of Cayley's form.
    let [w, _, _, z] = system.grains.orientation[0];
    let angle = 5.0 * system.time;
    let error = angle * (5.0 * step).powi(2) / 12.0 + 1e-12;
    close(2.0 * z.atan2(w), angle, error);
}

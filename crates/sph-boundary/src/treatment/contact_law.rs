//! What counts between two walls that touch.

use sph_core::Vect;

use crate::Touch;

/// Share of the velocity that is left of an impact on a spring and a damper that never pull, with the damping ratio ζ ≤ 1
/// (Schwager & Pöschel 2007): exp(−ζ/s · atan2(2 ζ s, 2 ζ² − 1)), s = √(1 − ζ²).
fn left_over(ratio: f64) -> f64 {
    let s = (1.0 - ratio * ratio).sqrt();
    (-ratio / s * (2.0 * ratio * s).atan2(2.0 * ratio * ratio - 1.0)).exp()
}

/// The damping ratio that leaves a share of the velocity; 1, which leaves e⁻², for shares below.
fn damping_ratio(restitution: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        match left_over(middle) > restitution {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

/// What counts between two walls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Law {
    /// k, Pa/m.
    pub stiffness: f64,
    /// Mass m that swings on the contact, kg.
    mass: f64,
    /// Damping ratio ζ.
    ratio: f64,
    friction: f64,
}

impl Law {
    /// Between two walls, one of which may be fixed, with at least `least` N/m on the smaller face.
    pub fn of(pair: [Option<Touch>; 2], least: f64) -> Self {
        let law = |t: Touch| Law {
            stiffness: t.stiffness.max(least / t.face),
            mass: t.mass,
            ratio: damping_ratio(t.restitution),
            friction: t.friction,
        };
        match pair {
            [Some(a), Some(b)] => law(Touch {
                mass: a.mass * b.mass / (a.mass + b.mass),
                face: a.face.min(b.face),
                stiffness: a.stiffness.min(b.stiffness),
                restitution: a.restitution.min(b.restitution),
                friction: (a.friction * b.friction).sqrt(),
                ..a
            }),
            [Some(one), None] | [None, Some(one)] => law(one),
            [None, None] => Law {
                stiffness: 0.0,
                mass: 0.0,
                ratio: 0.0,
                friction: 0.0,
            },
        }
    }

    /// The force on the first of a pair, N, from an area that is one of `all` at which the pair touches; `missing` m of the gap,
    /// at a velocity against the second.
    pub fn force<const D: usize>(
        &self,
        away: &Vect<D>,
        missing: f64,
        velocity: &Vect<D>,
        [area, all]: [f64; 2],
    ) -> Vect<D> {
        let critical = 2.0 * (self.stiffness * self.mass / all).sqrt();
        let parting = velocity.dot(away);
        let push = area * (self.stiffness * missing - self.ratio * critical * parting).max(0.0);
        let along = velocity - away * parting;
        let speed = along.norm();
        if speed == 0.0 {
            return away * push;
        }
        let rub = (self.friction * push).min(critical * area * speed);
        away * push - along * (rub / speed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By small steps: the share that is left is the one that was asked for.
    #[test]
    fn a_damped_impact_leaves_the_share_that_was_asked_for() {
        for restitution in [1.0, 0.8, 0.5, 0.2] {
            let ratio = damping_ratio(restitution);
            let (mut x, mut v, dt) = (0.0, 1.0, 1e-5);
            loop {
                let push = x + 2.0 * ratio * v;
                if push < 0.0 || x < 0.0 {
                    break;
                }
                v -= dt * push;
                x += dt * v;
            }
            assert!((v + restitution).abs() < 1e-3, "{restitution}: {v}");
        }
        assert!(damping_ratio(0.0) > 0.999_999);
    }
}

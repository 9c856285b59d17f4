//! Contact law of two walls that touch.

use sph_core::Vect;

use crate::Touch;

/// Contact law of two walls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Law {
    /// k, Pa/m.
    pub stiffness: f64,
    /// Mass m that swings on the contact, kg.
    mass: f64,
    /// Share of the force that is left while the walls part: e².
    left: f64,
    friction: f64,
}

impl Law {
    /// Between two walls, one of which may be fixed, with at least `least` N/m on the smaller face.
    pub fn new(pair: [Option<Touch>; 2], least: f64) -> Self {
        let law = |t: Touch| Law {
            stiffness: t.stiffness.max(least / t.face),
            mass: t.mass,
            left: t.restitution * t.restitution,
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
                left: 0.0,
                friction: 0.0,
            },
        }
    }

    /// The force on the first of a pair, N, from an area that is one of `all` at which the pair touches; `missing` m of
    /// the gap, at a velocity against the second.
    pub fn force<const D: usize>(
        &self,
        away: &Vect<D>,
        missing: f64,
        velocity: &Vect<D>,
        [area, all]: [f64; 2],
    ) -> Vect<D> {
        let critical = 2.0 * (self.stiffness * self.mass / all).sqrt();
        let parting = velocity.dot(away);
        let left = if parting > 0.0 { self.left } else { 1.0 };
        let push = area * left * self.stiffness * missing;
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

    /// By small steps: the share that is left is the given one, also of a body far heavier than that
    /// whose contact it is.
    #[test]
    fn an_impact_leaves_the_share_that_was_asked_for() {
        for (restitution, mass) in [(1.0, 1.0), (0.5, 1.0), (0.2, 1e4), (0.0, 1e4)] {
            let touch = Touch {
                mass: 1.0,
                inertia: 1.0,
                face: 1.0,
                stiffness: 1.0,
                restitution,
                friction: 0.0,
                dry: false,
            };
            let law = Law::new([Some(touch), None], 0.0);
            let (mut x, mut v, dt) = (0.0, Vect::<2>::new(-1.0, 0.0), 1e-3 * f64::sqrt(mass));
            for _ in 0..10_000 {
                if x < 0.0 {
                    v += law.force(&Vect::<2>::x(), -x, &v, [1.0, 1.0]) * (dt / mass);
                }
                x += dt * v[0];
            }
            assert!((v[0] - restitution).abs() < 2e-3, "{restitution}: {v}");
        }
    }
}

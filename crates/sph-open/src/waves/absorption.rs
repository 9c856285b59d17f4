//! A paddle that absorbs waves that come back to it: the gauge of its face, and its motion besides the prescribed one.

use std::f64::consts::{FRAC_PI_2, TAU};

use sph_boundary::{Course, Drawing, MoverSetting, RigidState, SinePart};
use sph_core::Vect;
use sph_neighbours::DepthGauge;

use crate::waves::{Component, Paddle};

/// Unit axis about which a flap turns forward, up × along; along z in the plane.
pub(crate) fn forward<const D: usize>(along: &Vect<D>) -> [f64; 3] {
    match D {
        2 => [0.0, 0.0, -along[0]],
        _ => [-along[1], along[0], 0.0],
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Face<const D: usize> {
    /// The gauge where it is drawn, at its lowest point that moves.
    drawn: DepthGauge<D>,
    /// Height of the still level over the hinge, m; none for a piston.
    arm: Option<f64>,
}

impl<const D: usize> Face<D> {
    /// The foremost of a wall; none if it has no breadth.
    pub fn foremost(
        setting: &MoverSetting<'_, D>,
        along: Vect<D>,
        hinge: Option<Vect<D>>,
        level: f64,
        reach: f64,
    ) -> Option<Self> {
        let points = setting.pieces().flat_map(Drawing::points);
        let points: Vec<Vect<D>> = points.map(Vect::from).collect();
        let most =
            |of: &dyn Fn(&Vect<D>) -> f64| points.iter().map(of).reduce(f64::max).unwrap_or(0.0);
        let front = most(&|p| p.dot(&along));
        let side = |p: &Vect<D>| match D {
            3 => p[1] * along[0] - p[0] * along[1],
            _ => 0.0,
        };
        let sideways = [-most(&|p| -side(p)), most(&side)];
        if D == 3 && sideways[1] <= sideways[0] {
            return None;
        }
        let origin = hinge.unwrap_or_else(Vect::zeros);
        let drawn = DepthGauge {
            place: origin + along * (front - origin.dot(&along)),
            along,
            lean: 0.0,
            reach,
            sideways,
        };
        let arm = hinge.map(|h| level - h[D - 1]);
        Some(Face { drawn, arm })
    }

    /// The depth gauge of the face.
    pub fn gauge(&self, now: &RigidState<D>) -> DepthGauge<D> {
        let ([way, _], mut gauge) = (self.movement(now), self.drawn);
        match self.arm {
            None => gauge.place += gauge.along * way,
            Some(arm) => gauge.lean = (way / arm).tan(),
        }
        gauge
    }

    /// Way and velocity at the still level, m and m/s; of a flap the arc.
    fn movement(&self, state: &RigidState<D>) -> [f64; 2] {
        let Some(arm) = self.arm else {
            let way = Vect::from(state.pose.translation).dot(&self.drawn.along);
            return [way, state.velocity.dot(&self.drawn.along)];
        };
        let up = state.pose.rotation.map(|row| row[D - 1]);
        let angle = Vect::from(up).dot(&self.drawn.along).atan2(up[D - 1]);
        let axis = forward(&self.drawn.along);
        let rate: f64 = (0..3).map(|k| axis[k] * state.angular_velocity[k]).sum();
        [arm * angle, arm * rate]
    }

    /// Way and velocity besides the prescribed motion.
    pub fn free_motion(&self, now: &RigidState<D>, plan: &RigidState<D>) -> [f64; 2] {
        let (now, plan) = (self.movement(now), self.movement(plan));
        [now[0] - plan[0], now[1] - plan[1]]
    }

    /// The prescribed motion, and a way, a velocity and an acceleration besides.
    pub fn moved(
        &self,
        plan: RigidState<D>,
        [way, velocity]: [f64; 2],
        acceleration: f64,
    ) -> RigidState<D> {
        let Some(arm) = self.arm else {
            let mut state = plan;
            let along = self.drawn.along * way;
            (0..D).for_each(|k| state.pose.translation[k] += along[k]);
            state.velocity += self.drawn.along * velocity;
            state.acceleration += self.drawn.along * acceleration;
            return state;
        };
        let axis = forward(&self.drawn.along);
        let mut state = plan.turned_by(axis.map(|e| e * way / arm));
        for (k, e) in axis.iter().enumerate() {
            state.angular_velocity[k] += e * velocity / arm;
            state.angular_acceleration[k] += e * acceleration / arm;
        }
        state
    }
}

/// Within how many periods the paddle is led back to where it would be without waves that come back.
const PERIODS: f64 = 10.0;

/// Share of its reach at which a sight looks in the mean, ∫ q f dq/∫ f dq.
pub(crate) const MEAN_WAY: f64 = 0.3;

/// Absorption from the elevation at the paddle.
///
/// With X = ½ S sin ωt at the still level the water beside a paddle is higher by e₀ times what is a quarter of a period ahead of
/// X, and by E X. A wave of the elevation η_r that comes back leaves through the paddle if this moves, besides what it makes, as
///
///   u' = −ω/(e₀ + i E) (η − η_made) ,   or   τ du'/dt + u' = −ω/e₀ (η − η_made),   τ = E/(ω e₀)
///
/// (Schäffer & Jakobsen 2003). Both are the same at the frequency of the peak, which is taken; in long waves ω/e₀ is √(g/d),
/// as the absorption of Altomare et al. 2017 has it. Where E is negative (flaps) τ would be an advance: it is left out, and
/// |E|/(2 e₀) of a wave comes back.
#[derive(Clone, Debug)]
pub(crate) struct Absorption {
    /// η of the waves that are made, at the paddle, m.
    made: Course,
    /// η at time 0, which a course leaves out, m.
    first: f64,
    /// Still depth, m.
    depth: f64,
    /// ω/e₀, 1/s.
    gain: f64,
    /// τ, s.
    lag: f64,
    /// Time in which the paddle is led back, s.
    back: f64,
}

impl Absorption {
    /// For waves with their motion at the still level, tuned to a period; `least` is the least lag, s.
    pub fn tuned(
        paddle: Paddle,
        waves: &[Component],
        (ramp, period, least): (f64, f64, f64),
        second: bool,
        [depth, gravity]: [f64; 2],
    ) -> Self {
        let mut parts = Vec::new();
        for w in waves {
            let moved = w.amplitude / paddle.transfer(w.wavenumber, depth);
            let sine = |amplitude: f64, times: f64, phase: f64| SinePart {
                amplitude,
                frequency: times * w.frequency,
                phase,
            };
            parts.push(sine(w.amplitude, 1.0, w.phase + FRAC_PI_2));
            let stays = paddle.near_field(w.frequency, depth, gravity);
            parts.push(sine(moved * stays, 1.0, w.phase));
            if second {
                // The bound wave of twice the frequency (Stokes).
                let bound = w.amplitude * w.amplitude * w.wavenumber * w.bound(depth);
                parts.push(sine(bound, 2.0, 2.0 * w.phase + FRAC_PI_2));
            }
        }
        let begins = |p: &SinePart| p.amplitude * p.phase.sin();
        let first = match ramp > 0.0 {
            true => 0.0,
            false => parts.iter().map(begins).sum(),
        };
        let omega = TAU / period;
        let leaves = paddle.transfer(crate::waves::wavenumber(omega, depth, gravity), depth);
        let stays = paddle.near_field(omega, depth, gravity);
        Absorption {
            made: Course::Sum {
                parts: parts.into(),
                ramp,
            },
            first,
            depth,
            gain: omega / leaves,
            lag: (stays / (omega * leaves)).max(least),
            back: PERIODS * period,
        }
    }

    /// Way and velocity besides the prescribed motion, `dt` later: with the depth of the water before the paddle,
    /// `None` for a dry paddle.
    pub fn next(
        &self,
        [way, velocity]: [f64; 2],
        seen: Option<f64>,
        time: f64,
        dt: f64,
    ) -> [f64; 2] {
        let made = self.made.at(time).value + self.first;
        let more = seen.map_or(0.0, |seen| seen - self.depth - made);
        let aim = -self.gain * more - way / self.back;
        let part = 1.0 - (-dt / self.lag).exp();
        let velocity = velocity + (aim - velocity) * part;
        [way + dt * velocity, velocity]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An added motion can be read off again, of a piston and of a flap, along any direction.
    #[test]
    fn an_added_motion_is_read_back() {
        for arm in [None, Some(0.5)] {
            let drawn = DepthGauge {
                place: Vect::<3>::zeros(),
                along: Vect::<3>::new(0.6, -0.8, 0.0),
                lean: 0.0,
                reach: 0.1,
                sideways: [0.0, 1.0],
            };
            let face = Face { drawn, arm };
            let plan = face.moved(RigidState::default(), [0.02, 0.1], 0.0);
            let now = face.moved(plan, [0.01, -0.3], 2.0);
            let [way, velocity] = face.free_motion(&now, &plan);
            assert!((way - 0.01).abs() < 1e-15 && (velocity + 0.3).abs() < 1e-15);
            let top = now
                .movement((Vect::<3>::new(0.0, 0.0, 0.5)).into())
                .velocity;
            assert!((top.dot(&face.drawn.along) + 0.2).abs() < 2e-2, "{top}");
        }
    }

    const WATER: [f64; 2] = [0.5, 9.81];

    /// The reflected part of a wave of the amplitude 1 that runs against the paddle: with X = −H η/(iω) and
    /// η = 2 + (i e₀ + E) X it is (1 − (e₀ + i E) H/ω)/(1 + (e₀ − i E) H/ω).
    fn comes_back(paddle: Paddle, omega: f64, response: [f64; 2]) -> f64 {
        let k = crate::waves::wavenumber(omega, WATER[0], WATER[1]);
        let e0 = paddle.transfer(k, WATER[0]);
        let e = paddle.near_field(omega, WATER[0], WATER[1]);
        let [re, im] = response.map(|h| h / omega);
        let times = |e: f64| [e0 * re - e * im, e0 * im + e * re];
        let ([a, b], [c, d]) = (times(e), times(-e));
        ((1.0 - a).hypot(b)) / ((1.0 + c).hypot(d))
    }

    fn response(absorption: &Absorption, omega: f64) -> [f64; 2] {
        let x = omega * absorption.lag;
        let size = absorption.gain / (1.0 + x * x);
        [size, -size * x]
    }

    #[test]
    fn nothing_comes_back_to_a_piston_at_the_peak_and_less_than_with_a_gain_for_long_waves_beside_it()
     {
        let peak = TAU / 1.2;
        let piston = Paddle::Piston;
        let own = Absorption::tuned(piston, &[], (0.0, 1.2, 0.0), false, WATER);
        let at = |omega: f64| comes_back(piston, omega, response(&own, omega));
        assert!(at(peak) < 1e-12, "{}", at(peak));
        let long = (WATER[1] / WATER[0]).sqrt();
        for over in [0.8, 1.0, 1.25, 1.5] {
            let simple = comes_back(piston, over * peak, [long, 0.0]);
            let found = at(over * peak);
            assert!(found < simple, "{over}: {found} {simple}");
        }
    }

    /// Of a flap hinged at the floor E is negative here. Without the advance −E/(2 e₀) is left.
    #[test]
    fn a_flap_has_no_advance() {
        let (peak, flap) = (TAU / 1.2, Paddle::Flap(0.0));
        let own = Absorption::tuned(flap, &[], (0.0, 1.2, 0.0), false, WATER);
        assert_eq!(own.lag, 0.0);
        let e = flap.near_field(peak, WATER[0], WATER[1]);
        let left = -0.5 * e * own.gain / peak;
        let found = comes_back(flap, peak, response(&own, peak));
        assert!(found > 0.99 * left && found <= left, "{found} {left}");
    }

    /// The water that a paddle makes, and nothing else, leaves it alone.
    #[test]
    fn a_paddle_alone_does_what_it_is_told() {
        let wave = Component {
            amplitude: 0.03,
            frequency: 5.0,
            wavenumber: crate::waves::wavenumber(5.0, WATER[0], WATER[1]),
            phase: 0.4,
        };
        let period = TAU / 5.0;
        let own = Absorption::tuned(Paddle::Piston, &[wave], (0.0, period, 0.0), true, WATER);
        let made = |t: f64| own.made.at(t).value + own.first;
        let mut state = [0.0; 2];
        for n in 0..1000 {
            let t = f64::from(n) * 1e-3;
            state = own.next(state, Some(WATER[0] + made(t)), t, 1e-3);
        }
        assert!(state[0].abs() < 1e-12, "{state:?}");
        // At the start the crest of first order is a cos φ, that of second order and E X come on top.
        let first = 0.03 * 0.4_f64.cos();
        let start = made(0.0);
        assert!(start > first && start < 1.5 * first, "{start}");
    }
}

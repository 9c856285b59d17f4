//! A paddle that makes waves.

use std::sync::Arc;

use sph_boundary::{
    Course, Load, Mover, MoverEntry, MoverRefusal, MoverSetting, RigidMotion, RigidState, Rotation,
    SinePart, Translation,
};
use sph_core::{Vect, plugin};
use sph_neighbours::DepthGauge;

use crate::refuse;
use crate::waves::absorption::{Absorption, Face, MEAN_WAY, forward};
use crate::waves::paddle::Paddle;
use crate::waves::superposition::{Component, Waves, second_order};

/// A paddle that makes waves: a piston that slides, or a flap that turns about its `hinge`.
///
/// Every wave a cos(ωt − kx + φ) needs the stroke S = 2a/(H/S) of linear theory, X = ½ S sin(ωt + φ) at the still level. With
/// `order = 2` a piston for regular waves has Madsen's correction, which keeps a free wave of twice the frequency from being made:
///
///   X₂ = H²/(32 d) [3 cosh kd/sinh³ kd − 2/(H/S)] sin 2ωt.
///
/// Irregular and focused waves, and flaps, are of first order. The paddle begins where it is drawn and at rest, and rises to its
/// motion within `ramp`. With `absorb` it measures the depth of the water within two smoothing lengths, and moves besides so that
/// waves that come back leave through it:
///
///   τ du'/dt + u' = −ω/e₀ (η − η_made) − X'/10T,   τ = E/(ω e₀)
///
/// with e₀ = H/S, E the elevation that stays at the paddle over its displacement, ω that of the peak; no wave of this frequency
/// comes back to a piston, by linear theory, and |E|/(2 e₀) of it to a flap, whose E is negative. The last term leads it back to its place.
///
/// Source: Biesel 1951 (linear); Madsen 1971, as in Hughes 1993 (second order); Schäffer & Jakobsen 2003, Altomare et al. 2017
/// (absorption; the filter with one lag is ours).
///
/// ```toml
/// [wall.piston.mover.wave-maker]
/// level = "0.5 m"
/// waves = { regular = { height = "8 cm", period = "1.2 s" } }
/// ```
#[plugin(MoverEntry [2 => WaveMaker<2>, 3 => WaveMaker<3>], "wave-maker",
    "a piston or a flap that makes waves: regular, irregular, focused; it may absorb waves that come back",
    source: "Biesel 1951; Madsen 1971; Schäffer & Jakobsen 2003", cfg(not(test)))]
#[derive(Debug)]
#[serde(bound = "")]
#[schemars(rename = "WaveMaker", bound = "")]
pub struct WaveMaker<const D: usize> {
    /// Height of the still level, from the origin.
    #[parameter(unit: "m")]
    level: f64,
    /// Height of the floor, from the origin.
    #[parameter(default, unit: "m")]
    floor: f64,
    /// The waves.
    waves: Waves,
    /// 1, or 2 for regular waves of a piston; if left out, 2 where that is possible.
    order: Option<u8>,
    /// The point about which a flap turns; a piston if left out.
    #[parameter(unit: "m")]
    hinge: Option<Vec<f64>>,
    /// Direction in which waves run, horizontal; +x if left out. Its length does not matter.
    #[parameter(unit: "1")]
    along: Option<Vec<f64>>,
    /// Time in which the motion rises; two periods if left out.
    #[parameter(unit: "s", min: 0.0)]
    ramp: Option<f64>,
    /// True if waves that come back leave through the paddle.
    #[parameter(default)]
    absorb: bool,
    #[serde(skip)]
    motion: RigidMotion<D>,
    #[serde(skip)]
    feedback: Option<(Face<D>, Absorption)>,
}

type MoverResult<T> = Result<T, MoverRefusal>;

impl<const D: usize> WaveMaker<D> {
    /// Depth of the water and size of gravity.
    fn water(&self, setting: &MoverSetting<'_, D>) -> MoverResult<[f64; 2]> {
        let gravity = setting.gravity;
        let g = -gravity[D - 1];
        if !(g > 0.0 && gravity.norm() <= g * (1.0 + 1e-12)) {
            let why = "waves need gravity, downwards along the last axis: set `numerics.gravity`";
            return refuse("", why);
        }
        let depth = self.level - self.floor;
        if !(depth > 0.0 && depth.is_finite()) {
            return refuse("level", "the level is to be above the `floor`");
        }
        Ok([depth, g])
    }

    fn direction(&self) -> MoverResult<Vect<D>> {
        let Some(along) = &self.along else {
            return Ok(Vect::from_fn(|k, _| if k == 0 { 1.0 } else { 0.0 }));
        };
        if along.len() != D {
            let why = format!("{} numbers where {D} were expected", along.len());
            return refuse("along", why);
        }
        let given = Vect::<D>::from_column_slice(along);
        match given.try_normalize(0.0) {
            Some(unit) if unit[D - 1] == 0.0 && unit.iter().all(|x| x.is_finite()) => Ok(unit),
            _ => {
                let why = "waves run horizontally: the last number is 0, another is not";
                refuse("along", why)
            }
        }
    }

    fn paddle(&self) -> MoverResult<Paddle> {
        let Some(hinge) = &self.hinge else {
            return Ok(Paddle::Piston);
        };
        if hinge.len() != D || hinge.iter().any(|x| !x.is_finite()) {
            let why = format!("a place of {D} finite numbers was expected");
            return refuse("hinge", why);
        }
        match hinge[D - 1] < self.level {
            true => Ok(Paddle::Flap(hinge[D - 1] - self.floor)),
            false => refuse("hinge", "a flap turns about a hinge below the level"),
        }
    }

    fn second_order(&self, paddle: Paddle, depth: f64, waves: &[Component]) -> MoverResult<bool> {
        let fits = matches!((paddle, self.waves), (Paddle::Piston, Waves::Regular(_)));
        let unfit = "second order is for regular waves of a piston: take 1";
        second_order(waves, depth, self.order, (fits, unfit))
    }

    /// The motion at the still level, m.
    fn strokes(&self, paddle: Paddle, [depth, gravity]: [f64; 2]) -> MoverResult<Vec<SinePart>> {
        let waves = self.waves.components(depth, gravity, 0.0)?;
        let part = |w: &Component| SinePart {
            amplitude: w.amplitude / paddle.transfer(w.wavenumber, depth),
            frequency: w.frequency,
            phase: w.phase,
        };
        let mut parts: Vec<SinePart> = waves.iter().map(part).collect();
        if self.second_order(paddle, depth, &waves)? {
            let first = waves[0];
            let kd = first.wavenumber * depth;
            let height = 2.0 * first.amplitude;
            let bound = 3.0 * kd.cosh() / kd.sinh().powi(3);
            let drawn = 2.0 / paddle.transfer(first.wavenumber, depth);
            parts.push(SinePart {
                amplitude: height * height / (32.0 * depth) * (bound - drawn),
                frequency: 2.0 * first.frequency,
                phase: 2.0 * first.phase,
            });
        }
        Ok(parts)
    }

    fn feedback(
        &self,
        paddle: Paddle,
        along: Vect<D>,
        water: [f64; 2],
        ramp: f64,
        setting: &MoverSetting<'_, D>,
    ) -> MoverResult<Option<(Face<D>, Absorption)>> {
        if !self.absorb {
            return Ok(None);
        }
        let hinge = self.hinge.as_ref().map(|h| Vect::from_column_slice(h));
        let reach = 2.0 * setting.smoothing_length;
        let Some(face) = Face::foremost(setting, along, hinge, self.level, reach) else {
            return refuse("absorb", "the paddle has no breadth across the waves");
        };
        let [_, period] = self.waves.size();
        let waves = self.waves.components(water[0], water[1], 0.0)?;
        let second = self.second_order(paddle, water[0], &waves)?;
        let least = MEAN_WAY * reach / (water[0] * water[1]).sqrt();
        let timing = (ramp, period, least);
        let absorption = Absorption::tuned(paddle, &waves, timing, second, water);
        Ok(Some((face, absorption)))
    }
}

impl<const D: usize> Mover<D> for WaveMaker<D> {
    fn prepare(&mut self, setting: &MoverSetting<'_, D>) -> MoverResult<()> {
        let water = self.water(setting)?;
        self.waves.check(water[0], water[1], 0.0)?;
        let [_, period] = self.waves.size();
        let ramp = self.ramp.unwrap_or(2.0 * period);
        if !(ramp >= 0.0 && ramp.is_finite()) {
            return refuse("ramp", "a time from 0 on was expected");
        }
        let (paddle, along) = (self.paddle()?, self.direction()?);
        self.feedback = self.feedback(paddle, along, water, ramp, setting)?;
        let mut parts = self.strokes(paddle, water)?;
        let mut motion = RigidMotion::default();
        match &self.hinge {
            None => motion.translations.push(Translation {
                along: along.into(),
                course: Course::Sum {
                    parts: parts.into(),
                    ramp,
                },
            }),
            Some(hinge) => {
                // Small angles: the way at the still level over its height above the hinge.
                let arm = self.level - hinge[D - 1];
                parts.iter_mut().for_each(|p| p.amplitude /= arm);
                let mut axis = forward(&along);
                // In the plane angles go anticlockwise.
                if D == 2 {
                    parts.iter_mut().for_each(|p| p.amplitude *= axis[2]);
                    axis[2] = 1.0;
                }
                motion.rotation = Some(Rotation {
                    centre: std::array::from_fn(|k| hinge[k]),
                    axis,
                    course: Course::Sum {
                        parts: Arc::from(parts),
                        ramp,
                    },
                });
            }
        }
        self.motion = motion;
        Ok(())
    }
    fn start(&self) -> RigidState<D> {
        self.motion.state(0.0)
    }
    fn needs_forces(&self) -> bool {
        false
    }
    fn looks(&self, now: &RigidState<D>) -> Option<DepthGauge<D>> {
        self.feedback.as_ref().map(|(face, _)| face.gauge(now))
    }
    fn next(&self, now: &RigidState<D>, load: &Load<D>, time: f64, dt: f64) -> RigidState<D> {
        let plan = self.motion.state(time + dt);
        let Some((face, absorption)) = &self.feedback else {
            return plan;
        };
        let besides = face.free_motion(now, &self.motion.state(time));
        let next = absorption.next(besides, load.depth, time, dt);
        face.moved(plan, next, (next[1] - besides[1]) / dt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setting<const D: usize>() -> MoverSetting<'static, D> {
        MoverSetting {
            wall: "paddle",
            fluid: &[],
            walls: &[],
            spacing: 0.02,
            smoothing_length: 0.04,
            densities: [1000.0; 2],
            sound_speed: 20.0,
            gravity: Vect::from_fn(|k, _| if k + 1 == D { -9.81 } else { 0.0 }),
            flush: true,
        }
    }

    fn maker<const D: usize>(text: &str) -> WaveMaker<D> {
        toml::from_str(text).unwrap_or_else(|e| panic!("{e}"))
    }

    const REGULAR: &str = "level = 0.5\nwaves = { regular = { height = 0.06, period = 1.4 } }\n";

    /// The stroke of `wavemaker-2d`: 58.85 mm of height for 50 mm.
    #[test]
    fn a_piston_has_the_stroke_of_linear_theory() {
        let mut piston = maker::<2>(&format!("{REGULAR}order = 1\nramp = 0\n"));
        piston.prepare(&setting()).expect("settled");
        let at = |t: f64| piston.next(&piston.start(), &Load::of_gravity(Vect::zeros()), t, 0.0);
        let stroke = at(0.35).pose.translation[0] - at(1.05).pose.translation[0];
        let transfer = 0.06 / stroke;
        let k = crate::waves::wavenumber(std::f64::consts::TAU / 1.4, 0.5, 9.81);
        assert!((transfer / Paddle::Piston.transfer(k, 0.5) - 1.0).abs() < 1e-12);
        assert!(at(0.0).velocity[0] > 0.0 && at(0.0).pose.translation[0] == 0.0);
    }

    /// In long waves the fluid of a wave of steady form has u = c η/(d + η) at all depths (Goring 1978): of second order,
    /// X₂ = (b − a²/d)/(2kd) sin 2ωt, with b the second harmonic of Stokes' wave.
    #[test]
    fn second_order_is_that_of_long_waves_where_they_are_long() {
        let (depth, period, a) = (0.5, 40.0, 1e-6);
        let text = format!(
            "level = {depth}\nwaves = {{ regular = {{ height = {}, period = {period} }} }}",
            2.0 * a
        );
        let piston = maker::<2>(&text);
        let parts = piston.strokes(Paddle::Piston, [depth, 9.81]);
        let parts = parts.expect("parts");
        let k = crate::waves::wavenumber(std::f64::consts::TAU / period, depth, 9.81);
        let kd: f64 = k * depth;
        let b = a * a * k * kd.cosh() * (2.0 + (2.0 * kd).cosh()) / (4.0 * kd.sinh().powi(3));
        let long = (b - a * a / depth) / (2.0 * kd);
        let error = (parts[1].amplitude / long - 1.0).abs();
        assert!(error < kd.powi(4), "{error} of {kd}");
    }

    #[test]
    fn a_flap_turns_its_top_the_way_the_waves_run() {
        let flap = format!("{REGULAR}hinge = [0.0, 0.1]\nramp = 0\n");
        let mut plane = maker::<2>(&flap);
        plane.prepare(&setting()).expect("settled");
        let top = plane.next(&plane.start(), &Load::of_gravity(Vect::zeros()), 0.1, 0.0);
        assert!(top.movement([0.0, 0.5]).velocity[0] > 0.0);
        let text = format!("{REGULAR}hinge = [0.0, 0.0, 0.1]\nalong = [3, 4, 0]\nramp = 0\n");
        let mut space = maker::<3>(&text);
        space.prepare(&setting()).expect("settled");
        let top = space.next(&space.start(), &Load::of_gravity(Vect::zeros()), 0.1, 0.0);
        let u = top.movement([0.0, 0.0, 0.5]).velocity;
        assert!(u[0] > 0.0 && (u[0] * 4.0 - u[1] * 3.0).abs() < 1e-12, "{u}");
    }

    #[test]
    fn impossible_wave_makers_are_refused_at_their_key() {
        let refused = |text: &str| {
            let mut maker = maker::<2>(text);
            maker.prepare(&setting()).expect_err("refused").key
        };
        assert_eq!(refused(&REGULAR.replace("0.5", "-0.5")), "level");
        assert_eq!(refused(&REGULAR.replace("0.06", "0.6")), "waves.regular");
        assert_eq!(refused(&format!("{REGULAR}hinge = [0.0, 0.7]")), "hinge");
        let flap = format!("{REGULAR}hinge = [0.0, 0.0]\norder = 2");
        assert_eq!(refused(&flap), "order");
        assert_eq!(refused(&format!("{REGULAR}along = [0.0, 1.0]")), "along");
        assert_eq!(refused(&REGULAR.replace("1.4", "6.0")), "order");
        let mut dry = maker::<2>(REGULAR);
        let none = MoverSetting {
            gravity: Vect::zeros(),
            ..setting()
        };
        let refusal = dry.prepare(&none).expect_err("refused");
        assert!(refusal.why.contains("gravity"));
    }
}

//! A paddle that makes waves.

use std::sync::Arc;

use sph_boundary::{
    Course, Load, Mover, MoverEntry, MoverRefusal, MoverSetting, RigidMotion, RigidState, Rotation,
    SinePart, Translation,
};
use sph_core::{Vect, plugin};
use sph_neighbours::DepthGauge;

use crate::waves::absorption::{Absorption, MEAN_WAY};
use crate::waves::face::{Face, forward};
use crate::waves::paddle::Paddle;
use crate::waves::superposition::{Component, Waves};

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
    feedback: Option<Feedback<D>>,
}

/// The gauge of a paddle, and its feedback.
#[derive(Clone, Debug)]
struct Feedback<const D: usize> {
    face: Face<D>,
    absorption: Absorption,
}

type MoverResult<T> = Result<T, MoverRefusal>;

fn refuse<T>(key: &str, why: impl Into<String>) -> MoverResult<T> {
    Err(MoverRefusal::at_key(key, why))
}

impl<const D: usize> WaveMaker<D> {
    /// Depth of the water and size of gravity.
    fn water(&self, setting: &MoverSetting<'_, D>) -> MoverResult<[f64; 2]> {
        let gravity = setting.gravity;
        let g = -gravity[D - 1];
        if !(g > 0.0 && gravity.norm() <= g * (1.0 + 1e-12)) {
            return refuse(
                "",
                "waves need gravity, downwards along the last axis: set `numerics.gravity`",
            );
        }
        let depth = self.level - self.floor;
        if !(depth > 0.0 && depth.is_finite()) {
            return refuse("level", "the level is to be above the `floor`");
        }
        Ok([depth, g])
    }

    /// The direction of the waves.
    fn direction(&self) -> MoverResult<Vect<D>> {
        let along = match &self.along {
            None => return Ok(Vect::from_fn(|k, _| if k == 0 { 1.0 } else { 0.0 })),
            Some(along) => along,
        };
        if along.len() != D {
            let why = format!("{} numbers where {D} were expected", along.len());
            return refuse("along", why);
        }
        let given = Vect::<D>::from_column_slice(along);
        match given.try_normalize(0.0) {
            Some(unit) if unit[D - 1] == 0.0 && unit.iter().all(|x| x.is_finite()) => Ok(unit),
            _ => refuse(
                "along",
                "waves run horizontally: the last number is 0, another is not",
            ),
        }
    }

    fn paddle(&self) -> MoverResult<Paddle> {
        let Some(hinge) = &self.hinge else {
            return Ok(Paddle::Piston);
        };
        if hinge.len() != D || hinge.iter().any(|x| !x.is_finite()) {
            return refuse(
                "hinge",
                format!("a place of {D} finite numbers was expected"),
            );
        }
        match hinge[D - 1] < self.level {
            true => Ok(Paddle::Flap(hinge[D - 1] - self.floor)),
            false => refuse("hinge", "a flap turns about a hinge below the level"),
        }
    }

    /// True if the motion has the correction of second order.
    fn second_order(&self, paddle: Paddle, depth: f64, first: &Component) -> MoverResult<bool> {
        let fits = matches!((paddle, self.waves), (Paddle::Piston, Waves::Regular(_)));
        match self.order {
            Some(1) => return Ok(false),
            None if !fits => return Ok(false),
            Some(2) if !fits => {
                return refuse(
                    "order",
                    "second order is for regular waves of a piston: take 1",
                );
            }
            None | Some(2) => {}
            Some(other) => return refuse("order", format!("1 or 2 was expected, not {other}")),
        }
        match first.fits_second_order(depth) {
            Ok(()) => Ok(true),
            Err(why) => refuse("order", why),
        }
    }

    /// The motion at the still level, m.
    fn strokes(&self, paddle: Paddle, [depth, gravity]: [f64; 2]) -> MoverResult<Vec<SinePart>> {
        let waves = self.waves.components(depth, gravity);
        let Some(first) = waves.first() else {
            return refuse(
                "waves",
                "there is no wave in the `band`: `repeat` is too short",
            );
        };
        let part = |w: &Component| SinePart {
            amplitude: w.amplitude / paddle.transfer(w.wavenumber, depth),
            frequency: w.frequency,
            phase: w.phase,
        };
        let mut parts: Vec<SinePart> = waves.iter().map(part).collect();
        if self.second_order(paddle, depth, first)? {
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

    /// The additional motion of a paddle that absorbs.
    fn feedback(
        &self,
        paddle: Paddle,
        along: Vect<D>,
        water: [f64; 2],
        ramp: f64,
        setting: &MoverSetting<'_, D>,
    ) -> MoverResult<Option<Feedback<D>>> {
        if !self.absorb {
            return Ok(None);
        }
        let hinge = self.hinge.as_ref().map(|h| Vect::from_column_slice(h));
        let reach = 2.0 * setting.smoothing_length;
        let Some(face) = Face::foremost(setting, along, hinge, self.level, reach) else {
            return refuse("absorb", "the paddle has no breadth across the waves");
        };
        let [_, period] = self.waves.size();
        let waves = self.waves.components(water[0], water[1]);
        let second = match waves.first() {
            Some(first) => self.second_order(paddle, water[0], first)?,
            None => false,
        };
        let least = MEAN_WAY * reach / (water[0] * water[1]).sqrt();
        let timing = (ramp, period, least);
        Ok(Some(Feedback {
            face,
            absorption: Absorption::tuned(paddle, &waves, timing, second, water),
        }))
    }
}

impl<const D: usize> Mover<D> for WaveMaker<D> {
    fn prepare(&mut self, setting: &MoverSetting<'_, D>) -> MoverResult<()> {
        let water = self.water(setting)?;
        let faulty = |(key, why): (&str, String)| MoverRefusal::at_key(key, why);
        self.waves.check(water[0], water[1], 0.0).map_err(faulty)?;
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
        self.feedback.as_ref().map(|f| f.face.gauge(now))
    }
    fn next(&self, now: &RigidState<D>, load: &Load<D>, time: f64, dt: f64) -> RigidState<D> {
        let plan = self.motion.state(time + dt);
        let Some(Feedback { face, absorption }) = &self.feedback else {
            return plan;
        };
        let besides = face.free_motion(now, &self.motion.state(time));
        let next = absorption.next(besides, load.depth, time, dt);
        face.moved(plan, next, (next[1] - besides[1]) / dt)
    }
}

#[cfg(test)]
mod tests;

//! Waves that come and go through an open face.

use std::f64::consts::TAU;
use std::sync::OnceLock;

use sph_core::{Vect, plugin};

use crate::waves::dispersion::wavenumber_on;
use crate::waves::orbits::Orbits;
use crate::waves::superposition::{Waves, second_order};
use crate::{
    Entering, FaceValues, Moment, OpenBoundary, OpenBoundaryEntry, OpenRefusal, OpenSetting, refuse,
};

/// Waves come in through the face on a current, and waves that come to it go out.
///
/// Behind the face is the water of linear waves on a uniform current, regular waves to second order ([`Waves`]): its surface,
/// pressure p₀ and velocity u₀. Where a current comes in, or waves without a current, the face imposes u₀ at every depth, below
/// its own surface; a wave that runs to it is reflected.
///
/// Elsewhere, and where a current goes out against the waves, the face yields. A wave that runs to it has p' = −ρ C u' at every depth, with u' inwards and its speed C = σ/k
/// in the water at rest. So
///
///   p = p₀ − ρ C (u_n − u₀ₙ)
///
/// ([`FaceValues::yielding`]), and no wave of the period comes back, whatever its height. Of other periods with the speed C'
/// |C' − C|/(C' + C) comes back by linear theory, and of a change of the mean level, C' = √(gd). The level at the face follows
/// from the same: what runs high goes out.
///
/// Source: linear theory; Verbrugghe et al. 2019 (open faces with the orbits of waves; C = √(gd) there).
///
/// ```toml
/// [wall.inlet.open-boundary.waves]
/// level = "0.5 m"
/// current = "0.2 m/s"
/// waves = { regular = { height = "8 cm", period = "1.2 s" } }
/// ```
#[plugin(OpenBoundaryEntry [2, 3], "waves", "waves come in on a current, and waves that come to the face go out",
    source: "Stokes 1847; Verbrugghe et al. 2019", cfg(not(test)))]
#[derive(Debug)]
pub struct WaveFace {
    /// Height of the still level, from the origin.
    #[parameter(unit: "m")]
    level: f64,
    /// Height of the floor, from the origin.
    #[parameter(default, unit: "m")]
    floor: f64,
    /// Velocity of the current into the fluid; below 0 it goes out. Give the water at the start the same velocity.
    #[parameter(default, unit: "m/s")]
    current: f64,
    /// The waves that come in; none if left out.
    waves: Option<Waves>,
    /// Period of the waves that go out, for an observer at rest; that of `waves` if left out.
    #[parameter(unit: "s", above: 0.0)]
    period: Option<f64>,
    /// 1, or 2 for regular waves; if left out, 2 where that is possible.
    order: Option<u8>,
    /// Time in which the waves rise; two periods if left out.
    #[parameter(unit: "s", min: 0.0)]
    ramp: Option<f64>,
    /// True if the face yields; if left out, so where a current goes out, or nothing comes in.
    yields: Option<bool>,
    /// Name of the phase that comes in; that of the fluid in front of the face if left out.
    #[parameter(default)]
    phase: Option<String>,
    #[serde(skip)]
    settled: OnceLock<WaveFaceState>,
}

#[derive(Clone, Debug)]
struct WaveFaceState {
    orbits: Orbits,
    /// C, m/s.
    speed: f64,
    ramp: f64,
    yields: bool,
}

impl WaveFaceState {
    /// Share of the waves' amplitudes at a time.
    fn share(&self, time: f64) -> f64 {
        match time < self.ramp {
            true => 0.5 - 0.5 * (0.5 * TAU * time / self.ramp).cos(),
            false => 1.0,
        }
    }
}

impl WaveFace {
    fn settled(&self, gravity: f64) -> Result<WaveFaceState, OpenRefusal> {
        if gravity.is_nan() || gravity <= 0.0 {
            return refuse("level", "waves need gravity: set `numerics.gravity`");
        }
        let depth = self.level - self.floor;
        if !(depth > 0.0 && depth.is_finite()) {
            return refuse("level", "the still level is to be above the `floor`");
        }
        if !self.current.is_finite() {
            return refuse("current", "a velocity was expected");
        }
        let period = match (self.period, &self.waves) {
            (Some(period), _) => period,
            (None, Some(waves)) => waves.size()[1],
            (None, None) => {
                return refuse("period", "which waves are to go out? Give their period");
            }
        };
        if !(period > 0.0 && period.is_finite()) {
            return refuse("period", "a time above 0 was expected");
        }
        let waves = match &self.waves {
            None => Vec::new(),
            Some(waves) => {
                waves.check(depth, gravity, self.current)?;
                waves.components(depth, gravity, self.current)?
            }
        };
        let fits = matches!(self.waves, Some(Waves::Regular(_)));
        let unfit = "second order is for regular waves: take 1";
        let orbits = Orbits {
            depth,
            gravity,
            current: self.current,
            second: second_order(&waves, depth, self.order, (fits, unfit))?,
            waves,
        };
        let ramp = self.ramp.unwrap_or(2.0 * period);
        if !(ramp >= 0.0 && ramp.is_finite()) {
            return refuse("ramp", "a time from 0 on was expected");
        }
        // Waves that run to the face have the current −U. Where it keeps them from it there are only changes of the level.
        let omega = TAU / period;
        let speed = wavenumber_on(omega, depth, gravity, -self.current)
            .map_or((gravity * depth).sqrt(), |k| omega / k + self.current);
        let comes_in = self.current > 0.0 || (self.current == 0.0 && self.waves.is_some());
        Ok(WaveFaceState {
            orbits,
            speed,
            ramp,
            yields: self.yields.unwrap_or(!comes_in),
        })
    }
}

impl<const D: usize> OpenBoundary<D> for WaveFace {
    fn prepare(&self, setting: &OpenSetting<'_>) -> Result<(), OpenRefusal> {
        setting.check_phase(&self.phase)?;
        let settled = self.settled(setting.gravity)?;
        setting.check_speed("current", settled.orbits.fastest())?;
        self.settled.get_or_init(|| settled);
        Ok(())
    }
    fn entering(&self) -> Entering {
        Entering::in_phase(&self.phase)
    }
    fn keeps_rows_even(&self) -> bool {
        true
    }
    fn outside(&self, moment: &Moment<'_, D>) -> Vec<FaceValues<D>> {
        let Some(settled) = self.settled.get() else {
            return vec![FaceValues::dry(); moment.places.len()];
        };
        let orbits = &settled.orbits;
        let share = settled.share(moment.time);
        let elevation = orbits.elevation(moment.time, share);
        let up: Vect<D> = -moment.gravity / moment.gravity.norm();
        moment.each(|place, inside| {
            let height = moment.height(&place.centre) - self.level;
            let water = orbits.at(height, elevation, moment.time, share);
            let level = place.normal - up * place.normal.dot(&up);
            let forward = level.try_normalize(1e-9).unwrap_or_else(Vect::zeros);
            let velocity = forward * water.along + up * water.up;
            let side = match D {
                2 => place.measure,
                _ => place.measure.sqrt(),
            };
            let tall = (side * level.norm()).max(f64::MIN_POSITIVE);
            match settled.yields {
                true => {
                    let [p, z] = [water.pressure, settled.speed].map(|x| inside.density * x);
                    FaceValues::yielding(place, inside, p, velocity, z)
                }
                false => FaceValues {
                    velocity,
                    share: Some(((elevation - height) / tall + 0.5).clamp(0.0, 1.0)),
                    ..FaceValues::dry()
                },
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FaceElement, FluidMean};

    fn law(table: &str) -> WaveFace {
        toml::from_str(table).expect("a law")
    }

    fn refusal(table: &str) -> OpenRefusal {
        let why = law(table).settled(9.81);
        why.map(|_| ()).expect_err("refused")
    }

    #[test]
    fn impossible_waves_are_refused_at_their_key() {
        let waves = "waves = { regular = { height = 0.08, period = 1.2 } }\n";
        let of = |more: &str| refusal(&format!("level = 0.5\n{more}"));
        let blocked = of(&format!("current = -1.0\n{waves}"));
        assert!(blocked.key == "waves.regular" && blocked.why.contains("against a current"));
        let breaks = of("current = -0.2\nwaves = { regular = { height = 0.25, period = 1.2 } }");
        assert!(breaks.key == "waves.regular" && breaks.why.contains("breaks"));
        assert_eq!(of("current = -0.2").key, "period");
        assert_eq!(of(&format!("floor = 0.6\n{waves}")).key, "level");
        assert_eq!(of(&format!("order = 3\n{waves}")).key, "order");
        let long = "order = 2\nwaves = { regular = { height = 0.05, period = 6.0 } }";
        assert!(of(long).why.contains("too long and high"));
        let calm = law(&format!("level = 0.5\n{waves}")).settled(0.0);
        assert!(calm.is_err_and(|why| why.why.contains("gravity")));
    }

    #[test]
    fn faces_that_impose_the_flow_are_those_that_let_fluid_in() {
        let yields = |more: &str| {
            let settled = law(&format!("level = 0.5\nperiod = 1.2\n{more}")).settled(9.81);
            settled.expect("a law").yields
        };
        let waves = "waves = { regular = { height = 0.02, period = 1.2 } }";
        assert!(yields("") && yields("current = -0.2"));
        assert!(yields(&format!("current = -0.2\n{waves}")));
        assert!(!yields(waves) && !yields("current = 0.2"));
        assert!(!yields(&format!("current = 0.2\n{waves}")));
        assert!(yields(&format!("current = 0.2\nyields = true\n{waves}")));
    }

    /// A wave that runs to the face has the pressure and the velocity that the face imposes, at every depth: neither
    /// changes.
    #[test]
    fn a_wave_that_comes_to_a_face_goes_out() {
        let (depth, gravity, omega, current) = (0.5, 9.81, TAU / 1.2, -0.2);
        let law = law("level = 0.5\ncurrent = -0.2\nperiod = 1.2");
        let own = law.settled(gravity).expect("a law");
        law.settled.get_or_init(|| own);
        // It runs with the current that goes out.
        let k = wavenumber_on(omega, depth, gravity, -current).expect("a wave");
        let sigma = omega + k * current;
        for height in [0.05, 0.25, 0.45] {
            let place = FaceElement::<2> {
                centre: Vect::<2>::new(5.0, height),
                normal: Vect::<2>::new(-1.0, 0.0),
                measure: 0.03,
                along: 0.5,
                across: 0.5,
                rectangle: None,
            };
            let out = 0.03 * sigma * (k * height).cosh() / (k * depth).sinh();
            let inside = FluidMean::<2> {
                wet: true,
                pressure: 1000.0 * (gravity * (depth - height) + sigma / k * out),
                filled: 1.0,
                velocity: Vect::<2>::new(0.2 + out, 0.0),
                impedance: 16_000.0,
                density: 1000.0,
                ..FluidMean::nothing()
            };
            let moment = Moment {
                places: &[place],
                inside: &[inside],
                time: 3.0,
                gravity: Vect::<2>::new(0.0, -gravity),
            };
            let outside = law.outside(&moment)[0];
            let p = outside.pressure - inside.pressure;
            let u = outside.velocity - inside.velocity;
            assert!(p.abs() < 1e-9 && u.norm() < 1e-12, "{height}: {p}, {u}");
        }
    }
}

//! The waves of a maker.

use std::f64::consts::{PI, TAU};

use sph_boundary::MoverRefusal;
use sph_core::parameters;

use crate::refuse;
use crate::waves::dispersion::wavenumber_on;
use crate::waves::spectrum::{jonswap, phases};

/// One linear wave, η = a cos(ωt − kx + φ) with x from the paddle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// a, m.
    pub amplitude: f64,
    /// ω, rad/s.
    pub frequency: f64,
    /// k, 1/m.
    pub wavenumber: f64,
    /// φ, rad.
    pub phase: f64,
}

impl Component {
    /// The bound wave of twice the frequency over a²k (Stokes' second order), η₂ = a²k · ¼ cosh kd (2 + cosh 2kd)/sinh³ kd.
    pub(crate) fn bound(&self, depth: f64) -> f64 {
        let coth = 1.0 / (self.wavenumber * depth).tanh();
        // cosh 2x = 1 + 2 sinh² x.
        0.25 * coth * (3.0 * (coth * coth - 1.0) + 2.0)
    }
}

/// True if waves are of second order: if the `order` is 2, or none is named and it `fits` them; `unfit` is the refusal where it
/// does not. Regular waves are to be so low and short that second order describes them, H L²/d³ < 8π²/3 (Madsen 1971).
pub(crate) fn second_order(
    waves: &[Component],
    depth: f64,
    order: Option<u8>,
    (fits, unfit): (bool, &str),
) -> Result<bool, MoverRefusal> {
    match order {
        Some(1) => return Ok(false),
        None if !fits => return Ok(false),
        Some(2) if !fits => return refuse("order", unfit),
        None | Some(2) => {}
        Some(other) => return refuse("order", format!("1 or 2 was expected, not {other}")),
    }
    let Some(first) = waves.first() else {
        return Ok(false);
    };
    let length = TAU / first.wavenumber;
    let ursell = 2.0 * first.amplitude * length * length / depth.powi(3);
    let limit = 8.0 * PI.powi(2) / 3.0;
    if ursell < limit {
        return Ok(true);
    }
    let why = format!(
        "the waves are too long and high for second order: H L²/d³ = {ursell:.1}, and Madsen's limit is {limit:.1}; take \
         `order = 1`, or lower waves"
    );
    refuse("order", why)
}

/// The waves of a maker.
#[parameters]
#[derive(Copy)]
pub enum Waves {
    /// One wave after the other, all of them the same.
    Regular(Regular),
    /// A sea with a spectrum, from a seed.
    Irregular(Irregular),
    /// The waves of a spectrum that meet with their crests.
    Focused(Focused),
}

/// Regular waves.
#[parameters]
pub struct Regular {
    /// Height from trough to crest.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Period.
    #[parameter(unit: "s", above: 0.0)]
    pub period: f64,
}

/// A sea with the spectrum of JONSWAP.
#[parameters]
pub struct Irregular {
    /// Significant height H_m0.
    #[parameter(unit: "m", above: 0.0)]
    pub height: f64,
    /// Period of the peak.
    #[parameter(unit: "s", above: 0.0)]
    pub period: f64,
    /// Peak enhancement γ.
    #[parameter(default: 3.3, unit: "1", min: 1.0)]
    pub enhancement: f64,
    /// Time after which the sea repeats itself: its waves have the multiples of one over it for frequencies.
    #[parameter(unit: "s", above: 0.0)]
    pub repeat: f64,
    /// Lowest and highest frequency over that of the peak.
    #[parameter(default: [0.5, 2.0], unit: "1")]
    pub band: [f64; 2],
    /// The seed of the phases.
    pub seed: u64,
}

/// A group that focuses: amplitudes in proportion to the spectrum, crests at one place and time.
#[parameters]
pub struct Focused {
    /// Height of the crest over the still level, the sum of all amplitudes.
    #[parameter(unit: "m", above: 0.0)]
    pub crest: f64,
    /// Period of the peak.
    #[parameter(unit: "s", above: 0.0)]
    pub period: f64,
    /// Peak enhancement γ.
    #[parameter(default: 3.3, unit: "1", min: 1.0)]
    pub enhancement: f64,
    /// Lowest and highest frequency over that of the peak.
    #[parameter(default: [0.5, 2.0], unit: "1")]
    pub band: [f64; 2],
    /// Place at which the crests meet, as a distance from the paddle.
    #[parameter(unit: "m")]
    pub at: f64,
    /// When they meet.
    #[parameter(unit: "s")]
    pub time: f64,
}

const GROUP: f64 = 64.0;

impl Waves {
    /// Height and period that stand for the waves: those of regular waves, the significant height and the period of the peak of
    /// a sea, twice the crest of a group.
    pub fn size(&self) -> [f64; 2] {
        match self {
            Waves::Regular(w) => [w.height, w.period],
            Waves::Irregular(w) => [w.height, w.period],
            Waves::Focused(w) => [2.0 * w.crest, w.period],
        }
    }

    /// Checks the numbers in water of a depth, m, that runs with the waves at the velocity `current`, m/s.
    pub(crate) fn check(&self, depth: f64, gravity: f64, current: f64) -> Result<(), MoverRefusal> {
        let name = match self {
            Waves::Regular(_) => "waves.regular",
            Waves::Irregular(_) => "waves.irregular",
            Waves::Focused(_) => "waves.focused",
        };
        let refused = |why: String| refuse(name, why);
        let [height, period] = self.size();
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !positive(height) || !positive(period) {
            return refused("heights and periods are numbers above 0".into());
        }
        let Some(k) = wavenumber_on(TAU / period, depth, gravity, current) else {
            return refused(format!(
                "no wave with a period of {period} s runs against a current of {:.4} m/s in water {depth:.4} m deep",
                -current
            ));
        };
        let breaks = 0.142 * TAU / k * (k * depth).tanh();
        if height > breaks {
            return refused(format!(
                "a wave of {height:.4} m breaks: with this period and depth none is higher than {breaks:.4} m (Miche)"
            ));
        }
        let (gamma, [low, high]) = match self {
            Waves::Regular(_) => return Ok(()),
            Waves::Irregular(w) => (w.enhancement, w.band),
            Waves::Focused(w) => (w.enhancement, w.band),
        };
        if !(gamma >= 1.0 && gamma.is_finite()) {
            return refused(format!("`enhancement` is at least 1, and here {gamma}"));
        }
        if !(low > 0.0 && low < 1.0 && high > 1.0 && high.is_finite()) {
            return refused("`band` has a number below 1 and one above it".into());
        }
        match self {
            Waves::Irregular(w) if !(w.repeat >= 5.0 * w.period && w.repeat.is_finite()) => {
                refused("`repeat` is to be five periods at least".into())
            }
            Waves::Focused(w) if !(positive(w.at) && positive(w.time)) => {
                refused("`at` and `time` are numbers above 0".into())
            }
            _ => Ok(()),
        }
    }

    /// The linear waves of which they consist, in water of a depth, m, that runs with them, or against them, at the velocity
    /// `current`, m/s. Those that no current lets run against it are left out.
    ///
    /// # Errors
    /// Waves of which the current stops all.
    pub fn components(
        &self,
        depth: f64,
        gravity: f64,
        current: f64,
    ) -> Result<Vec<Component>, MoverRefusal> {
        let one = |frequency: f64, amplitude: f64, phase: f64| {
            let omega = TAU * frequency;
            Some(Component {
                amplitude,
                frequency: omega,
                wavenumber: wavenumber_on(omega, depth, gravity, current)?,
                phase,
            })
        };
        let waves = match self {
            Waves::Regular(w) => Vec::from_iter(one(1.0 / w.period, 0.5 * w.height, 0.0)),
            Waves::Irregular(w) => {
                let sea = [w.height, 1.0 / w.period, w.enhancement];
                let all = jonswap(sea, 1.0 / w.repeat, w.band.map(|f| f / w.period));
                let both = all.into_iter().zip(phases(w.seed));
                both.filter_map(|([f, a], phase)| one(f, a, phase))
                    .collect()
            }
            Waves::Focused(w) => {
                let [low, high] = w.band.map(|f| f / w.period);
                let sea = [1.0, 1.0 / w.period, w.enhancement];
                let all = jonswap(sea, (high - low) / GROUP, [low, high]);
                let whole: f64 = all.iter().map(|[_, a]| a * a).sum();
                let meets = |[f, a]: [f64; 2]| {
                    let wave = one(f, w.crest * a * a / whole, 0.0)?;
                    Some(Component {
                        phase: wave.wavenumber * w.at - wave.frequency * w.time,
                        ..wave
                    })
                };
                all.into_iter().filter_map(meets).collect()
            }
        };
        match waves.is_empty() {
            true => refuse(
                "waves",
                "there is no wave in the `band`: `repeat` is too short",
            ),
            false => Ok(waves),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waves(table: &str) -> Waves {
        toml::from_str(table).expect("waves")
    }

    fn level(waves: &[Component], x: f64, t: f64) -> f64 {
        let one =
            |w: &Component| w.amplitude * (w.frequency * t - w.wavenumber * x + w.phase).cos();
        waves.iter().map(one).sum()
    }

    #[test]
    fn a_focused_group_meets_where_and_when_it_is_asked_to() {
        let waves = waves("focused = { crest = 0.08, period = 1.2, at = 3.0, time = 9.0 }");
        assert_eq!(waves.check(0.5, 9.81, 0.0), Ok(()));
        let all = waves.components(0.5, 9.81, 0.0).expect("waves");
        assert!((level(&all, 3.0, 9.0) - 0.08).abs() < 1e-14);
        for [x, t] in [[3.0, 9.6], [2.5, 9.0], [3.0, 3.0], [0.0, 9.0]] {
            assert!(level(&all, x, t) < 0.07, "{x} {t}");
        }
    }

    #[test]
    fn a_sea_repeats_itself_and_is_the_same_for_a_seed() {
        let sea = |seed: u64| {
            let sea = format!("height = 0.06, period = 1.2, repeat = 24.0, seed = {seed}");
            let waves = waves(&format!("irregular = {{ {sea} }}"));
            waves.components(0.5, 9.81, 0.0).expect("waves")
        };
        let all = sea(7);
        assert_eq!(all, sea(7));
        assert_ne!(all, sea(8));
        assert!((level(&all, 2.0, 5.0) - level(&all, 2.0, 29.0)).abs() < 1e-12);
        let n = 2400;
        let squares = (0..n).map(|j| level(&all, 2.0, 0.01 * j as f64).powi(2));
        let mean = squares.sum::<f64>() / n as f64;
        assert!((4.0 * mean.sqrt() / 0.06 - 1.0).abs() < 1e-9, "{mean}");
    }

    #[test]
    fn waves_that_break_are_refused() {
        let waves = waves("regular = { height = 0.4, period = 1.2 }");
        let MoverRefusal { key, why } = waves.check(0.5, 9.81, 0.0).expect_err("refused");
        assert!(key == "waves.regular" && why.contains("breaks"), "{why}");
    }
}

//! The probe of reflected waves.

use std::f64::consts::TAU;
use std::sync::Mutex;

use sph_core::{StepError, plugin};
use sph_neighbours::World;
use sph_probes::{Curves, Gathers, Level, Probe, ProbeColumn, ProbeEntry};

use crate::waves::{Amplitude, Separated, separated, wavenumber_on};

/// Waves that run along the first axis and those that come back, from gauges at three places or more.
///
/// From `from` to `to` the levels are taken apart into the frequencies that are multiples of 1/(to − from), between `lowest` and
/// `highest`; the window is to hold a whole number of periods. Every frequency is [separated] by least squares, with the
/// wavenumbers of linear waves, on a `current` if there is one. The columns are significant heights 4 √(Σ ½ a²), m, of both, √(reflected/incident energy), and
/// the period of the largest incident wave, s; of regular waves the height is 1/√2 of the significant one, 2a. They are NaN
/// before the window ends, 0 for the height of a missing wave. The curve has both amplitudes over the frequency.
///
/// Frequencies at which the places cannot separate the two waves (a third of the best case, `clear` in
/// [`Separated`]) are left out.
///
/// Source: Mansard & Funke 1980; the sums over time are discrete Fourier transforms by the trapezoidal rule.
///
/// ```toml
/// [probe.back]
/// kind = "reflection"
/// at = [3.0, 3.3, 3.75]
/// depth = "0.5 m"
/// from = "12 s"
/// to = "24 s"
/// lowest = "0.6 Hz"
/// highest = "1 Hz"
/// ```
#[plugin(ProbeEntry [2, 3], "reflection", "waves that run down a flume and that come back, from three gauges",
    source: "Mansard & Funke 1980", cfg(not(test)))]
pub struct ReflectionProbe {
    /// Places along the first axis: three or more, with unequal distances.
    #[parameter(unit: "m", min_items: 2)]
    pub at: Vec<f64>,
    /// Second coordinate of the gauges in three dimensions.
    #[parameter(default, unit: "m")]
    pub across: f64,
    /// Depth of the still water.
    #[parameter(unit: "m", above: 0.0)]
    pub depth: f64,
    /// Beginning of the window.
    #[parameter(unit: "s")]
    pub from: f64,
    /// End of the window.
    #[parameter(unit: "s")]
    pub to: f64,
    /// The lowest frequency.
    #[parameter(unit: "Hz", above: 0.0)]
    pub lowest: f64,
    /// The highest frequency.
    #[parameter(unit: "Hz", above: 0.0)]
    pub highest: f64,
    /// Velocity of the current along the first axis.
    #[parameter(default, unit: "m/s")]
    pub current: f64,
    #[serde(skip)]
    sums: Mutex<Sums>,
}

/// Sums so far: the last row (time, levels), and ∫ η cos ωt dt, −∫ η sin ωt dt for every gauge and frequency.
#[derive(Clone, Debug, Default)]
struct Sums {
    last: Option<Vec<f64>>,
    integrals: Vec<f64>,
}

/// Places separate waves if they do so a third as well as the best ones.
const CLEAR: f64 = 1.0 / 3.0;

fn refused(reason: impl ToString) -> StepError {
    StepError::stage("probe `reflection`", reason)
}

impl ReflectionProbe {
    /// Numbers n of the frequencies n/(to − from).
    fn numbers(&self) -> std::ops::RangeInclusive<usize> {
        let window = self.to - self.from;
        // A frequency that is a multiple but for rounding is one.
        let first = (self.lowest * window - 1e-6).ceil().max(1.0) as usize;
        let last = (self.highest * window + 1e-6).floor().max(0.0) as usize;
        first..=last
    }

    fn check(&self, gravity: f64) -> Result<(), StepError> {
        if gravity <= 0.0 || self.depth <= 0.0 {
            return Err(refused("waves need gravity and a `depth` above 0"));
        }
        if self.at.len() < 2 || self.at.iter().any(|x| !x.is_finite()) {
            let why = "two or more places `at` were expected, better three";
            return Err(refused(why));
        }
        if !(self.to > self.from && self.from >= 0.0 && self.to.is_finite()) {
            return Err(refused("`to` is to be later than `from`"));
        }
        if self.numbers().is_empty() || self.numbers().count() > 10_000 {
            return Err(refused(
                "no frequency, or more than 10000, between `lowest` and `highest` is a multiple of 1/(to − from)",
            ));
        }
        let highest = TAU * *self.numbers().end() as f64 / (self.to - self.from);
        let against = -self.current.abs();
        if wavenumber_on(highest, self.depth, gravity, against).is_none() {
            return Err(refused(format!(
                "no wave of the `highest` frequency runs against a `current` of {} m/s",
                self.current
            )));
        }
        Ok(())
    }

    fn take(&self, time: f64, levels: Vec<f64>) -> Result<(), StepError> {
        let mut sums = self.sums.lock().map_err(|_| refused("a thread failed"))?;
        let count = 2 * self.numbers().count() * self.at.len();
        sums.integrals.resize(count, 0.0);
        let row = [vec![time], levels].concat();
        if let Some(last) = sums.last.replace(row.clone()) {
            self.add(&mut sums.integrals, &last, &row);
        }
        Ok(())
    }

    /// The part of the integrals between two rows that lies in the window, the levels straight between them.
    fn add(&self, integrals: &mut [f64], last: &[f64], row: &[f64]) {
        let (t0, t1) = (last[0], row[0]);
        let (begin, end) = (t0.max(self.from), t1.min(self.to));
        if end <= begin {
            return;
        }
        let at = |gauge: usize, t: f64| {
            let share = (t - t0) / (t1 - t0);
            last[1 + gauge] + share * (row[1 + gauge] - last[1 + gauge])
        };
        let (half, count) = (0.5 * (end - begin), self.numbers().count());
        for gauge in 0..self.at.len() {
            let ends = [begin, end].map(|t| (t, at(gauge, t)));
            for (j, n) in self.numbers().enumerate() {
                let omega = TAU * n as f64 / (self.to - self.from);
                let place = 2 * (gauge * count + j);
                for (t, level) in ends {
                    let (sine, cosine) = (omega * t).sin_cos();
                    integrals[place] += half * level * cosine;
                    integrals[place + 1] -= half * level * sine;
                }
            }
        }
    }

    /// Frequencies, Hz, with the waves of each; nothing before the window ends.
    fn found(&self, gravity: f64) -> Result<Vec<(f64, Separated)>, StepError> {
        let sums = self.sums.lock().map_err(|_| refused("a thread failed"))?;
        let last = sums.last.as_ref();
        let ended = last.is_some_and(|row| row[0] >= self.to - 1e-9);
        if !ended || sums.integrals.is_empty() {
            return Ok(Vec::new());
        }
        let window = self.to - self.from;
        let count = self.numbers().count();
        let of = |(j, n): (usize, usize)| {
            let frequency = n as f64 / window;
            let on = |u: f64| wavenumber_on(TAU * frequency, self.depth, gravity, u);
            let k = [on(self.current)?, on(-self.current)?];
            let gauges: Vec<(f64, Amplitude)> = (self.at.iter().enumerate())
                .map(|(gauge, x)| {
                    let place = 2 * (gauge * count + j);
                    let part = |c: usize| 2.0 / window * sums.integrals[place + c];
                    (*x, Amplitude::new(part(0), part(1)))
                })
                .collect();
            let waves = separated(k, &gauges)?;
            (waves.clear >= CLEAR).then_some((frequency, waves))
        };
        Ok(self.numbers().enumerate().filter_map(of).collect())
    }
}

/// Significant heights of both directions, √ of their energies' ratio, period of the largest wave.
fn summed(found: &[(f64, Separated)]) -> Vec<f64> {
    if found.is_empty() {
        return vec![f64::NAN; 4];
    }
    let energy = |of: fn(&Separated) -> Amplitude| -> f64 {
        found.iter().map(|(_, w)| 0.5 * of(w).norm().powi(2)).sum()
    };
    let (incident, reflected) = (energy(|w| w.incident), energy(|w| w.reflected));
    let incident_of = |(_, w): &(f64, Separated)| w.incident.norm();
    let largest = (found.iter()).max_by(|a, b| incident_of(a).total_cmp(&incident_of(b)));
    let peak = largest.map_or(f64::NAN, |(f, _)| 1.0 / f);
    vec![
        4.0 * incident.sqrt(),
        4.0 * reflected.sqrt(),
        (reflected / incident).sqrt(),
        peak,
    ]
}

impl<const D: usize> Probe<D> for ReflectionProbe {
    fn columns(&self) -> Vec<ProbeColumn> {
        let names = [".incident", ".reflected", ".coefficient", ".period"];
        let all = names.into_iter().zip(["m", "m", "1", "s"]);
        all.map(|(suffix, unit)| ProbeColumn::named(suffix, unit))
            .collect()
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        self.check(world.gravity.norm())?;
        Ok(summed(&self.found(world.gravity.norm())?))
    }

    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        Some(self)
    }

    fn as_gathers(&self) -> Option<&dyn Gathers<D>> {
        Some(self)
    }
}

impl<const D: usize> Curves<D> for ReflectionProbe {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        let all = [("frequency", "Hz"), ("incident", "m"), ("reflected", "m")];
        all.map(|(name, unit)| ProbeColumn::named(name, unit))
            .into()
    }

    fn curves(&self, world: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        let found = self.found(world.gravity.norm())?;
        let row = |(f, w): &(f64, Separated)| vec![*f, w.incident.norm(), w.reflected.norm()];
        Ok(found.iter().map(row).collect())
    }
}

impl<const D: usize> Gathers<D> for ReflectionProbe {
    fn gather(&self, world: &World<D>) -> Result<(), StepError> {
        let gauge = |x: &f64| {
            let level = Level::over(vec![*x, self.across]);
            let measured = Probe::<D>::measure(&level, world)?[0];
            match measured.is_finite() {
                true => Ok(measured - self.depth),
                false => Err(refused(format!("there is no water at {x} m"))),
            }
        };
        let levels: Vec<f64> = self.at.iter().map(gauge).collect::<Result<_, _>>()?;
        self.take(world.time, levels)
    }

    fn gathered(&self) -> Vec<u64> {
        let Ok(sums) = self.sums.lock() else {
            return Vec::new();
        };
        let last = sums.last.iter().flatten();
        last.chain(&sums.integrals).map(|x| x.to_bits()).collect()
    }

    fn recall(&self, gathered: &[u64]) {
        let row = 1 + self.at.len();
        // Values gathered by another scene are of other gauges.
        let fits = gathered.len() == row + 2 * self.numbers().count() * self.at.len();
        if let (true, Ok(mut sums)) = (fits, self.sums.lock()) {
            let all: Vec<f64> = gathered.iter().map(|b| f64::from_bits(*b)).collect();
            sums.last = Some(all[..row].to_vec());
            sums.integrals = all[row..].to_vec();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAVITY: f64 = 9.81;

    fn wavenumber(omega: f64, current: f64) -> f64 {
        wavenumber_on(omega, 0.5, GRAVITY, current).expect("a wave")
    }

    fn probe(lowest: f64, highest: f64, [from, to]: [f64; 2]) -> ReflectionProbe {
        let band = format!("lowest = {lowest}\nhighest = {highest}\nfrom = {from}\nto = {to}");
        let places = "at = [3.0, 3.3, 3.75]\ndepth = 0.5";
        toml::from_str(&format!("{places}\n{band}")).expect("a probe")
    }

    /// Feeds it the levels of waves (frequency, amplitude there, amplitude back, phase), every 20 ms, in steps that do
    /// not meet the window's ends.
    fn fed(probe: &ReflectionProbe, waves: &[[f64; 4]]) {
        let mut t = 0.003;
        while t < probe.to + 0.05 {
            let level = |x: &f64| -> f64 {
                let one = |[f, there, back, phase]: &[f64; 4]| {
                    let omega = TAU * f;
                    let [k, l] = [1.0, -1.0].map(|sign| wavenumber(omega, sign * probe.current));
                    there * (omega * t - k * x + phase).cos() + back * (omega * t + l * x).cos()
                };
                waves.iter().map(one).sum()
            };
            let levels = probe.at.iter().map(level).collect();
            probe.take(t, levels).expect("taken");
            t += 0.02;
        }
    }

    #[test]
    fn regular_waves_and_what_comes_back_at_rest_and_on_a_current() {
        [0.0, 0.3, -0.2].into_iter().for_each(regular_on);
    }

    fn regular_on(current: f64) {
        let mut probe = probe(1.0 / 1.2, 1.0 / 1.2, [6.0, 18.0]);
        probe.current = current;
        fed(&probe, &[[1.0 / 1.2, 0.04, 0.003, 0.7]]);
        let [incident, reflected, coefficient, period] =
            summed(&probe.found(GRAVITY).expect("found"))[..]
        else {
            panic!("four columns")
        };
        // Levels that are straight between rows lose (ωΔt)²/12 = 0.09 %.
        let [incident, reflected] = [incident, reflected].map(|h| h / std::f64::consts::SQRT_2);
        assert!((incident / 0.08 - 1.0).abs() < 2e-3, "{incident}");
        assert!((reflected / 0.006 - 1.0).abs() < 5e-3, "{reflected}");
        assert!((coefficient - 0.075).abs() < 4e-4, "{coefficient}");
        assert!((period - 1.2).abs() < 1e-12, "{period}");
    }

    #[test]
    fn a_sea_is_taken_apart_wave_by_wave() {
        let probe = probe(0.5, 1.2, [5.0, 25.0]);
        let waves = [
            [0.55, 0.01, 0.001, 0.3],
            [0.8, 0.02, 0.0, 2.0],
            [1.1, 0.005, 0.001, 5.0],
        ];
        fed(&probe, &waves);
        let found = probe.found(GRAVITY).expect("found");
        assert_eq!(found.len(), 15);
        for (f, w) in &found {
            let own = waves.iter().find(|v| (v[0] - f).abs() < 1e-9);
            let [there, back] = own.map_or([0.0; 2], |v| [v[1], v[2]]);
            let off = [w.incident.norm() - there, w.reflected.norm() - back];
            assert!(off.iter().all(|x| x.abs() < 4e-5), "{f} Hz: {w:?}");
        }
    }

    #[test]
    fn nothing_is_told_before_the_window_ends() {
        let probe = probe(0.5, 1.2, [5.0, 25.0]);
        probe.take(0.0, vec![0.0; 3]).expect("taken");
        probe.take(24.0, vec![0.1; 3]).expect("taken");
        assert!(summed(&probe.found(GRAVITY).expect("found"))[0].is_nan());
    }
}

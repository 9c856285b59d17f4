//! Round numbers along an axis, and how they are written.

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Ticks {
    /// Marked and labelled.
    pub(crate) major: Vec<(f64, String)>,
    /// Marked only.
    pub(crate) minor: Vec<f64>,
    /// Power of ten by which all labels are to be multiplied, such as `×10⁵`.
    pub(crate) factor: Option<String>,
}

impl Ticks {
    /// Labelled ones alone, whose labels leave a power of ten out.
    fn with_power(major: Vec<(f64, String)>, power: i32) -> Self {
        Ticks {
            major,
            minor: Vec::new(),
            factor: (power != 0).then(|| format!("×{}", power_of_ten(power))),
        }
    }
}

/// About `wanted` multiples of 1, 2 or 5 times a power of ten within `lo`…`hi`.
pub(crate) fn linear(lo: f64, hi: f64, wanted: usize) -> Ticks {
    let slack = 1e-9;
    let marks = |wanted: usize| {
        let step = round_step((hi - lo) / wanted.max(1) as f64);
        let first = (lo / step - slack).ceil();
        let more = ((hi / step + slack).floor() - first).clamp(0.0, 60.0) as usize;
        let values = (0..=more).map(|i| (first + i as f64) * step);
        (step, values.collect::<Vec<f64>>())
    };
    let (mut step, mut values) = marks(wanted);
    // One number alone shows no scale.
    for finer in 1..4 {
        if values.len() < 2 {
            (step, values) = marks(wanted + finer);
        }
    }
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let power = shared_power(largest);
    let unit = 10_f64.powi(power);
    let decimals = (-(step / unit).log10() - slack).ceil().clamp(0.0, 12.0) as usize;
    let label = |v: f64| minus(format!("{:.decimals$}", v / unit + 0.0));
    let major = values.into_iter().map(|v| (v, label(v)));
    Ticks::with_power(major.collect(), power)
}

/// Powers of ten within `lo`…`hi`, both positive, with minor ticks between;
/// round numbers instead where that leaves fewer than two.
pub(crate) fn logarithmic(lo: f64, hi: f64, wanted: usize) -> Ticks {
    let slack = 1e-9;
    let first = (lo.log10() - slack).ceil() as i32;
    let last = (hi.log10() + slack).floor() as i32;
    if last - first < 1 {
        let ticks = ones_twos_and_fives(lo, hi);
        if ticks.major.len() > 2 {
            return ticks;
        }
        let mut ticks = linear(lo, hi, wanted);
        ticks.major.retain(|(v, _)| *v > 0.0);
        return ticks;
    }
    let stride = ((last - first) as usize).div_ceil(wanted.max(2)).max(1) as i32;
    let labelled = |k: &i32| k.rem_euclid(stride) == 0;
    let parts = ((first - 1)..=last).flat_map(|k| {
        let inner = if stride == 1 { 2..10 } else { 1..2 };
        inner.map(move |m| f64::from(m) * 10_f64.powi(k))
    });
    Ticks {
        major: (first..=last)
            .filter(labelled)
            .map(|k| (10_f64.powi(k), power_of_ten(k)))
            .collect(),
        minor: parts.filter(|v| (lo..=hi).contains(v)).collect(),
        factor: None,
    }
}

/// 1, 2 and 5 times the powers of ten within `lo`…`hi`, both positive: nearly even on a logarithmic axis.
fn ones_twos_and_fives(lo: f64, hi: f64) -> Ticks {
    let power = shared_power(hi);
    let [first, last] = [lo, hi].map(|v| v.log10().floor() as i32);
    let all = (first..=last).flat_map(|k| [1.0, 2.0, 5.0].map(|m| (m, k)));
    let marks = all.map(|(m, k)| {
        let label = format!("{}", m * 10_f64.powi(k - power));
        (m * 10_f64.powi(k), minus(label))
    });
    let major = marks.filter(|(v, _)| (lo..=hi).contains(v));
    Ticks::with_power(major.collect(), power)
}

/// The power of ten that labels up to `largest` leave out.
fn shared_power(largest: f64) -> i32 {
    let exponent = || largest.log10().floor() as i32;
    let power = if largest > 0.0 { exponent() } else { 0 };
    if (-3..5).contains(&power) { 0 } else { power }
}

/// `lo`…`hi` widened so that it has an extent; finite ends assumed.
pub(crate) fn widened(lo: f64, hi: f64) -> [f64; 2] {
    let least = 1e-12 * lo.abs().max(hi.abs());
    if hi - lo > least {
        return [lo, hi];
    }
    let half = if lo == 0.0 { 0.5 } else { 0.05 * lo.abs() };
    [lo - half, hi + half]
}

/// The simulated time in seconds as a stamp.
pub(crate) fn time_stamp(time: f64) -> String {
    let decimals = match time == 0.0 || !time.is_finite() {
        true => 3,
        false => (2.0 - time.abs().log10().floor()).clamp(3.0, 9.0) as usize,
    };
    minus(format!("t = {time:.decimals$} s"))
}

fn round_step(raw: f64) -> f64 {
    if !raw.is_finite() || raw <= 0.0 {
        return 1.0;
    }
    let unit = 10_f64.powf(raw.log10().floor());
    let rest = raw / unit;
    // The nearest of 1, 2, 5 and 10 on a logarithmic scale.
    let nearest = [(2.0, 1.0), (10.0, 2.0), (50.0, 5.0)];
    let round = nearest.into_iter().find(|(limit, _)| rest * rest < *limit);
    round.map_or(10.0, |(_, round)| round) * unit
}

fn minus(text: String) -> String {
    text.replace('-', "−")
}

fn power_of_ten(power: i32) -> String {
    let raised = |c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        c => char::from_u32(0x2070 + c as u32 - '0' as u32).unwrap_or(c),
    };
    let exponent: String = power.to_string().chars().map(raised).collect();
    format!("10{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        let labels = ticks.major.iter().map(|(_, label)| label.as_str());
        labels.collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        let of = |lo: f64, hi: f64| labels(&linear(lo, hi, 4)).join(" ");
        assert_eq!(of(-0.013, 0.61), "0.0 0.2 0.4 0.6");
        assert_eq!(of(-1.0, 1.0), "−1.0 −0.5 0.0 0.5 1.0");
        assert_eq!(of(998.0, 1002.0), "998 999 1000 1001 1002");
    }

    #[test]
    fn one_tick_is_not_enough() {
        assert_eq!(labels(&linear(-0.99, 0.99, 2)), ["−0.5", "0.0", "0.5"]);
    }

    #[test]
    fn large_and_small_numbers_share_a_power_of_ten() {
        let ticks = linear(0.0, 3.1e5, 3);
        assert_eq!(labels(&ticks), ["0", "1", "2", "3"]);
        assert_eq!(ticks.factor.as_deref(), Some("×10⁵"));
        assert_eq!(linear(0.0, 2e-6, 2).factor.as_deref(), Some("×10⁻⁶"));
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten() {
        let ticks = logarithmic(5e-4, 2.0, 8);
        assert_eq!(labels(&ticks), ["10⁻³", "10⁻²", "10⁻¹", "10⁰"]);
        assert!(ticks.minor.contains(&0.02) || ticks.minor.iter().any(|v| (v - 0.02).abs() < 1e-9));
        assert!(logarithmic(1e-40, 1e40, 6).major.len() <= 9);
        assert!(logarithmic(2.0, 7.0, 5).major.len() >= 3);
        assert_eq!(labels(&logarithmic(0.3, 9.0, 6)), ["0.5", "1", "2", "5"]);
        let ticks = logarithmic(2.4e-7, 3.1e-6, 6);
        assert_eq!(labels(&ticks), ["0.5", "1", "2"]);
        assert_eq!(ticks.factor.as_deref(), Some("×10⁻⁶"));
    }

    #[test]
    fn degenerate_ranges_do_no_harm() {
        for [lo, hi] in [
            widened(3.0, 3.0),
            widened(0.0, 0.0),
            [0.0, f64::MIN_POSITIVE],
        ] {
            assert!(lo < hi && linear(lo, hi, 5).major.len() < 62);
        }
    }

    #[test]
    fn stamps_have_three_significant_digits() {
        assert_eq!(time_stamp(0.35), "t = 0.350 s");
        assert_eq!(time_stamp(0.00123), "t = 0.00123 s");
        assert_eq!(time_stamp(12.0), "t = 12.000 s");
    }
}

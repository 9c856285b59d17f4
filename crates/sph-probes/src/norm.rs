//! The norms in which errors are reported.

/// √(Σ V |u − e|² / Σ V |e|²) over values of `components` numbers each.
pub fn l2(values: &[f64], exact: &[f64], volume: &[f64], components: usize) -> f64 {
    let (mut difference, mut size) = (0.0, 0.0);
    let pairs = values.chunks(components).zip(exact.chunks(components));
    for ((u, e), v) in pairs.zip(volume) {
        difference += v * u.iter().zip(e).map(|(u, e)| (u - e).powi(2)).sum::<f64>();
        size += v * e.iter().map(|e| e * e).sum::<f64>();
    }
    (difference / size).sqrt()
}

/// |Σ V u·e / Σ V e² − 1| over values of `components` numbers each.
pub fn amplitude(values: &[f64], exact: &[f64], volume: &[f64], components: usize) -> f64 {
    let (mut product, mut size) = (0.0, 0.0);
    let pairs = values.chunks(components).zip(exact.chunks(components));
    for ((u, e), v) in pairs.zip(volume) {
        product += v * u.iter().zip(e).map(|(u, e)| u * e).sum::<f64>();
        size += v * e.iter().map(|e| e * e).sum::<f64>();
    }
    (product / size - 1.0).abs()
}

/// Σ | |u| − |e| | / Σ |e|.
pub fn l1(values: &[f64], exact: &[f64], components: usize) -> f64 {
    let pairs = values.chunks(components).zip(exact.chunks(components));
    let (mut difference, mut total) = (0.0, 0.0);
    for (u, e) in pairs {
        difference += (size(u) - size(e)).abs();
        total += size(e);
    }
    difference / total
}

/// max |u − e| / max |e|.
pub fn linf(values: &[f64], exact: &[f64], components: usize) -> f64 {
    let pairs = values.chunks(components).zip(exact.chunks(components));
    let (mut difference, mut largest) = (0.0_f64, 0.0_f64);
    for (u, e) in pairs {
        let d: Vec<f64> = u.iter().zip(e).map(|(u, e)| u - e).collect();
        difference = difference.max(size(&d));
        largest = largest.max(size(e));
    }
    difference / largest
}

/// √(Σ V |u|² / Σ V) / scale: the root mean square against a scale, for fields at rest.
pub fn rms(values: &[f64], volume: &[f64], components: usize, scale: f64) -> f64 {
    let mut sum = 0.0;
    for (u, v) in values.chunks(components).zip(volume) {
        sum += v * u.iter().map(|x| x * x).sum::<f64>();
    }
    (sum / volume.iter().sum::<f64>()).sqrt() / scale
}

fn size(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Linear interpolation of a series; `None` outside its times.
pub fn at(times: &[f64], values: &[f64], t: f64) -> Option<f64> {
    let after = times.partition_point(|x| *x < t);
    if after == 0 {
        return (times.first() == Some(&t)).then(|| values[0]);
    }
    let (t0, t1) = (times[after - 1], *times.get(after)?);
    let (v0, v1) = (values[after - 1], values[after]);
    Some(v0 + (v1 - v0) * (t - t0) / (t1 - t0))
}

/// Centred moving mean over a width in time; values that are not finite are left out.
pub fn moving_mean(times: &[f64], values: &[f64], width: f64) -> Vec<f64> {
    let mean = |t: &f64| {
        let from = times.partition_point(|x| *x < t - 0.5 * width);
        let to = times.partition_point(|x| *x <= t + 0.5 * width);
        let finite = || values[from..to].iter().filter(|v| v.is_finite());
        finite().sum::<f64>() / finite().count() as f64
    };
    times.iter().map(mean).collect()
}

/// Root mean square of the difference at the reference's times over the reference's range.
pub fn rms_over_range(differences: &[f64], reference: &[f64]) -> f64 {
    let mean = differences.iter().map(|d| d * d).sum::<f64>() / differences.len() as f64;
    mean.sqrt() / range(reference)
}

/// The largest of all values less the least.
fn range(values: &[f64]) -> f64 {
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Time weight of each sample of a series: half the gaps on both sides. A reference may be denser in some places; with
/// these weights every moment counts alike.
pub fn time_weights(times: &[f64]) -> Vec<f64> {
    let last = times.len().saturating_sub(1);
    let width = |k: usize| 0.5 * (times[(k + 1).min(last)] - times[k.saturating_sub(1)]).abs();
    (0..times.len()).map(width).collect()
}

/// |range of the values / range of the reference − 1|: the error of a wave's height.
pub fn range_error(values: &[f64], reference: &[f64]) -> f64 {
    (range(values) / range(reference) - 1.0).abs()
}

/// Time of the largest value; `None` without values.
pub fn peak_time(times: &[f64], values: &[f64]) -> Option<f64> {
    let pairs = times.iter().zip(values).filter(|(_, v)| v.is_finite());
    pairs.max_by(|a, b| a.1.total_cmp(b.1)).map(|(t, _)| *t)
}

/// The delay τ in [−`most`, `most`] at which the series correlates best with a reference, s:
/// positive where the series comes later. 400 delays are tried and the best refined by a parabola.
///
/// The correlation is that of the values at the reference's times plus τ, both less their means.
pub fn lag([times, values]: [&[f64]; 2], [at, reference]: [&[f64]; 2], most: f64) -> Option<f64> {
    const TRIED: i32 = 200;
    let correlation = |tau: f64| -> Option<f64> {
        let shifted = at.iter().map(|t| self::at(times, values, t + tau));
        let pairs = shifted.zip(reference).filter_map(|(v, r)| Some((v?, *r)));
        let pairs: Vec<(f64, f64)> = pairs.filter(|(v, _)| v.is_finite()).collect();
        if 2 * pairs.len() < at.len() || pairs.len() < 3 {
            return None;
        }
        let n = pairs.len() as f64;
        let mean = |f: fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / n;
        let (mv, mr) = (mean(|p| p.0), mean(|p| p.1));
        let of = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
            pairs.iter().map(|(v, r)| f(v - mv, r - mr)).sum()
        };
        Some(of(&|v, r| v * r) / (of(&|v, _| v * v) * of(&|_, r| r * r)).sqrt())
    };
    let step = most / f64::from(TRIED);
    let delay = |k: i32| f64::from(k) * step;
    let tried = (-TRIED..=TRIED).filter_map(|k| Some((k, correlation(delay(k))?)));
    let (k, best) = tried.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let beside = (correlation(delay(k - 1)), correlation(delay(k + 1)));
    let refined = match beside {
        (Some(before), Some(after)) if k.abs() < TRIED => {
            let bend = before - 2.0 * best + after;
            if bend < 0.0 {
                0.5 * (before - after) / bend
            } else {
                0.0
            }
        }
        _ => 0.0,
    };
    Some(delay(k) + refined * step)
}

/// Mean over time by trapezia; the value itself if there is one only, `None` without values.
pub fn mean(times: &[f64], values: &[f64]) -> Option<f64> {
    let finite = times.iter().zip(values).filter(|(_, v)| v.is_finite());
    let (times, values): (Vec<f64>, Vec<f64>) = finite.unzip();
    if let [only] = values[..] {
        return Some(only);
    }
    let weights = time_weights(&times);
    let whole: f64 = weights.iter().sum();
    let sum: f64 = values.iter().zip(&weights).map(|(v, w)| v * w).sum();
    (whole > 0.0).then(|| sum / whole)
}

/// Period of an oscillation, s: the mean time between crossings of the mean in the same direction,
/// interpolated linearly. `None` if there are not two of either direction.
///
/// Crossings upward and downward are counted by themselves, so that a mean that is a little off does no harm.
pub fn period(times: &[f64], values: &[f64]) -> Option<f64> {
    let mean = mean(times, values)?;
    let finite = times.iter().zip(values).filter(|(_, v)| v.is_finite());
    let about: Vec<(f64, f64)> = finite.map(|(t, v)| (*t, v - mean)).collect();
    let crossings = |upward: bool| -> Vec<f64> {
        let sign = if upward { 1.0 } else { -1.0 };
        let pairs = about.windows(2);
        let crossed = pairs.filter(|w| sign * w[0].1 < 0.0 && sign * w[1].1 >= 0.0);
        let place = |w: &[(f64, f64)]| w[0].0 - w[0].1 * (w[1].0 - w[0].0) / (w[1].1 - w[0].1);
        crossed.map(place).collect()
    };
    let (mut span, mut count) = (0.0, 0);
    for found in [crossings(true), crossings(false)] {
        if let [first, .., last] = found[..] {
            span += last - first;
            count += found.len() - 1;
        }
    }
    (count > 0).then(|| span / count as f64)
}

/// Least-squares slope of y over x.
pub fn slope(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let xy: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let xx: f64 = x.iter().map(|x| (x - mx).powi(2)).sum();
    xy / xx
}

/// Slope of the least-squares line of y over x, and the root mean square of y about it; NaN of fewer than three points.
pub fn line(x: &[f64], y: &[f64]) -> [f64; 2] {
    if x.len() < 3 {
        return [f64::NAN; 2];
    }
    let slope = slope(x, y);
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (mx, my) = (mean(x), mean(y));
    let about = x.iter().zip(y).map(|(x, y)| y - my - slope * (x - mx));
    let squares: f64 = about.map(|d| d * d).sum();
    [slope, (squares / x.len() as f64).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_of_known_differences() {
        let (u, e, v) = ([1.1, 2.2], [1.0, 2.0], [1.0, 1.0]);
        assert!((l2(&u, &e, &v, 1) - 0.1).abs() < 1e-14);
        assert!((l1(&u, &e, 1) - 0.1).abs() < 1e-14);
        assert!((linf(&u, &e, 1) - 0.1).abs() < 1e-14);
        assert!((linf(&[3.0, 4.0], &[0.0, 1.0], 2) - 18f64.sqrt()).abs() < 1e-14);
        assert!((rms_over_range(&[0.1, -0.1], &[0.0, 2.0]) - 0.05).abs() < 1e-14);
        assert_eq!(time_weights(&[0.0, 1.0, 3.0, 4.0]), [0.5, 1.5, 1.5, 0.5]);
        assert_eq!(time_weights(&[]), [0.0; 0]);
        let mean = moving_mean(&[0.0, 1.0, 2.0, 3.0], &[1.0, 3.0, 5.0, 40.0], 2.0);
        assert_eq!(mean, [2.0, 3.0, 16.0, 22.5]);
        assert_eq!(at(&[0.0, 1.0], &[5.0, 7.0], 0.5), Some(6.0));
        assert_eq!(at(&[0.0, 1.0], &[5.0, 7.0], 1.5), None);
        assert_eq!(at(&[0.0, 1.0], &[5.0, 7.0], 0.0), Some(5.0));
    }

    #[test]
    fn a_late_and_high_wave_is_told_so() {
        let t: Vec<f64> = (0..500).map(|k| 0.01 * f64::from(k)).collect();
        let wave = |late: f64, high: f64| -> Vec<f64> {
            t.iter().map(|t| high * (4.0 * (t - late)).sin()).collect()
        };
        let (values, reference) = (wave(0.123, 1.1), wave(0.0, 1.0));
        let middle = 100..400;
        let rest = [&t[middle.clone()], &reference[middle.clone()]];
        let found = lag([&t, &values], rest, 0.5).expect("a lag");
        assert!((found - 0.123).abs() < 1e-4, "{found}");
        assert!((range_error(&values, &reference) - 0.1).abs() < 1e-3);
        let peak = peak_time(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, -1.0]);
        assert_eq!(peak, Some(0.0));
        assert_eq!(lag([&t, &values], [&[9.0], &[1.0]], 0.5), None);
    }

    #[test]
    fn a_period_is_measured_off_the_mean_and_through_decay() {
        let t: Vec<f64> = (0..900).map(|k| 0.01 * f64::from(k)).collect();
        let wave: Vec<f64> = t
            .iter()
            .map(|t| 3.0 + (-0.1 * t).exp() * (4.0 * t).cos())
            .collect();
        let exact = std::f64::consts::TAU / 4.0;
        let found = period(&t, &wave).expect("a period");
        assert!((found / exact - 1.0).abs() < 2e-3, "{found}");
        // One period and a bit has three crossings, half a one has not enough.
        assert!(period(&t[..170], &wave[..170]).is_none_or(|p| (p / exact - 1.0).abs() < 0.1));
        assert_eq!(period(&t[..50], &wave[..50]), None);
        assert_eq!(period(&[], &[]), None);
        assert_eq!(mean(&[0.0, 1.0, 3.0], &[1.0, 2.0, 4.0]), Some(7.5 / 3.0));
        assert_eq!(mean(&[1.0], &[5.0]), Some(5.0));
        assert_eq!(mean(&[1.0], &[f64::NAN]), None);
    }
}

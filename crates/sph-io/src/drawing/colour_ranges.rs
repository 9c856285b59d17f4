//! Values at the ends of the colours of pictures, alike for all pictures of a run.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Share of the values beyond either end, so that one does not make all others alike.
const BEYOND: f64 = 0.01;
/// A range that begins above zero by less than this share of its upper end begins at zero.
const FROM_ZERO: f64 = 0.5;

/// The ranges of fields by their names. A range that is not given holds 98 % of the values of the first picture in which they
/// differ, between round numbers; it becomes twice to two and a half times as wide, or wider, where 1 % of the values of a
/// later picture lie beyond an end.
///
/// ```
/// let mut ranges = sph_io::ColourRanges::default();
/// let values: Vec<f64> = (0..100).map(|k| 0.09 * f64::from(k)).collect();
/// assert!(ranges.next("speed", &[0.0, 0.0]).is_none());
/// assert_eq!(ranges.next("speed", &values), Some(([0.0, 9.0], false)));
/// assert_eq!(ranges.next("speed", &[5.0, 9.0]), Some(([0.0, 9.0], false)));
/// assert_eq!(ranges.next("speed", &[5.0, 12.0]), Some(([0.0, 20.0], true)));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ColourRanges(BTreeMap<String, [f64; 2]>);

impl ColourRanges {
    /// The range for the next picture of a field, and whether it is wider than before; none while all values are alike.
    pub fn next(&mut self, field: &str, values: &[f64]) -> Option<([f64; 2], bool)> {
        let seen = quantiles(values.iter().copied());
        let Some(before) = self.0.get(field).copied() else {
            let range = rounded(seen?)?;
            self.0.insert(field.into(), range);
            return Some((range, false));
        };
        let [low, high] = seen.unwrap_or(before);
        if before[0] <= low && high <= before[1] {
            return Some((before, false));
        }
        let wide =
            round_up((high.max(before[1]) - low.min(before[0])).max(1.5 * (before[1] - before[0])));
        // The end that holds stays where it is.
        let wider = match (low < before[0], high > before[1]) {
            (false, _) => [before[0], before[0] + wide],
            (true, false) => [before[1] - wide, before[1]],
            (true, true) => rounded([low, high])?,
        };
        self.0.insert(field.into(), wider);
        Some((wider, true))
    }
}

/// The values beyond which 1 % of all lie at either end; none if there is no finite one, or they are alike.
pub fn quantiles(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let mut finite: Vec<f64> = values.filter(|v| v.is_finite()).collect();
    let last = finite.len().checked_sub(1)?;
    let cut = ((BEYOND * finite.len() as f64) as usize).min(last / 2);
    let mut at = |k: usize| *finite.select_nth_unstable_by(k, f64::total_cmp).1;
    let ends = [at(cut), at(last - cut)];
    (ends[0] < ends[1] && (ends[1] - ends[0]).is_finite()).then_some(ends)
}

/// Round numbers that hold both; from zero where the lower one is not far above it.
fn rounded([low, high]: [f64; 2]) -> Option<[f64; 2]> {
    let from_zero = (0.0..=FROM_ZERO * high).contains(&low);
    let low = if from_zero { 0.0 } else { low };
    let step = 0.1 * round_up(high - low);
    let ends = [(low / step).floor() * step, (high / step).ceil() * step];
    (ends[0] < ends[1] && (ends[1] - ends[0]).is_finite()).then_some(ends)
}

/// The least of 1, 2 and 5 times a power of ten that is not less.
fn round_up(x: f64) -> f64 {
    let unit = 10f64.powi(x.log10().floor() as i32);
    let factors = [1.0, 2.0, 5.0].into_iter();
    let fits = factors.map(|f| f * unit).find(|r| *r >= x * (1.0 - 1e-9));
    fits.unwrap_or(10.0 * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drop_far_beyond_all_others_does_not_stretch_the_colours() {
        let mut values: Vec<f64> = (0..300).map(|k| f64::from(k) * 10.0).collect();
        values.extend([-1e5, f64::NAN, f64::INFINITY]);
        let mut ranges = ColourRanges::default();
        let first = ranges.next("pressure", &values);
        assert_eq!(first, Some(([0.0, 3000.0], false)));
        // Alike in all later pictures that it holds, also after a restart.
        let text = serde_json::to_string(&ranges).expect("text");
        let mut again: ColourRanges = serde_json::from_str(&text).expect("read");
        assert_eq!(again.next("pressure", &[0.0, 1.0]), first);
    }

    #[test]
    fn a_range_grows_in_few_steps_and_keeps_the_end_that_holds() {
        let mut ranges = ColourRanges::default();
        let mut next = |field, values: [f64; 2]| ranges.next(field, &values).expect("a range");
        let mut wider = 0;
        for k in 1..=1000 {
            let (range, grown) = next("u", [0.0, f64::from(k)]);
            assert_eq!(range[0], 0.0);
            wider += usize::from(grown);
        }
        assert!((5..=11).contains(&wider), "{wider}");
        assert_eq!(next("x", [998.2, 1001.0]), ([998.0, 1001.0], false));
        assert_eq!(next("x", [990.0, 1001.0]), ([981.0, 1001.0], true));
        assert_eq!(next("y", [-3.0, 3.0]), ([-3.0, 3.0], false));
    }
}

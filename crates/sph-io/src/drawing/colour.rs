//! Colours, maps from numbers to colours, and the values at their ends, alike for all pictures of a run.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// An opaque sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(
    /// Red, green and blue from 0 to 255.
    pub [u8; 3],
);

impl Colour {
    pub(crate) const WHITE: Self = Self::hex(0xffffff);
    /// Text and frames.
    pub(crate) const INK: Self = Self::hex(0x262626);
    pub(crate) const WALL: Self = Self::hex(0x3a3a3a);
    pub(crate) const FAINT: Self = Self::hex(0xdddddd);
    /// Series in the background of a plot.
    pub(crate) const PALE: Self = Self::hex(0xc4c4c4);
    pub(crate) const HIGHLIGHT: Self = Self::hex(0xffe08a);
    pub(crate) const RING: Self = Self::hex(0xd0021b);
    /// Particles without a finite value.
    pub(crate) const MISSING: Self = Self::hex(0xff00ff);

    /// The same, darker: the rim of a sphere.
    pub(crate) fn darker(self) -> Self {
        Self(self.0.map(|part| (f64::from(part) * 0.55) as u8))
    }

    /// The colour written `0xrrggbb`.
    pub(crate) const fn hex(code: u32) -> Self {
        Self([(code >> 16) as u8, (code >> 8) as u8, code as u8])
    }
}

/// Distinct colours for the series of a plot (Okabe and Ito, safe for the colour-blind).
pub(crate) const SERIES: [Colour; 7] = [
    Colour::hex(0x0072b2),
    Colour::hex(0xd55e00),
    Colour::hex(0x009e73),
    Colour::hex(0xcc79a7),
    Colour::hex(0xe69f00),
    Colour::hex(0x56b4e9),
    Colour::hex(0x444444),
];

/// A perceptually even map from 0…1 to colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ColourMap {
    /// Viridis (van der Walt and Smith, public domain): magnitudes, pressures.
    #[default]
    Viridis,
    /// Cool to warm (Moreland 2009, doi:10.1007/978-3-642-10520-3_9) with grey
    /// in the middle: signed quantities. Its automatic range is symmetric.
    CoolWarm,
}

impl ColourMap {
    /// The colour at `x`; beyond 0…1 that of the end.
    ///
    /// ```
    /// use sph_io::{Colour, ColourMap};
    /// assert_eq!(ColourMap::CoolWarm.at(0.5), Colour([0xdd, 0xdd, 0xdd]));
    /// assert_eq!(ColourMap::Viridis.at(-3.0), ColourMap::Viridis.at(0.0));
    /// ```
    pub fn at(self, x: f64) -> Colour {
        let knots: &[u32] = match self {
            Self::Viridis => &VIRIDIS,
            Self::CoolWarm => &COOL_WARM,
        };
        let last = knots.len() - 1;
        let place = x.clamp(0.0, 1.0) * last as f64;
        // A NaN becomes 0 in the conversion.
        let left = (place as usize).min(last - 1);
        let part = place - left as f64;
        let (a, b) = (Colour::hex(knots[left]), Colour::hex(knots[left + 1]));
        let mix = |i: usize| f64::from(a.0[i]) * (1.0 - part) + f64::from(b.0[i]) * part;
        Colour([0, 1, 2].map(|i| mix(i).round() as u8))
    }
}

const VIRIDIS: [u32; 18] = [
    0x440154, 0x481769, 0x472a7a, 0x433d84, 0x3d4e8a, 0x355e8d, 0x2e6d8e, 0x297b8e, 0x23898e,
    0x1f978b, 0x21a585, 0x2eb37c, 0x46c06f, 0x65cb5e, 0x89d548, 0xb0dd2f, 0xd8e219, 0xfde725,
];

const COOL_WARM: [u32; 33] = [
    0x3b4cc0, 0x445acc, 0x4e68d7, 0x5875e1, 0x6282ea, 0x6c8ef1, 0x779af7, 0x82a5fb, 0x8db0fe,
    0x98b9ff, 0xa3c2ff, 0xaec9fd, 0xb8d0f9, 0xc2d5f4, 0xccd9ee, 0xd5dbe6, 0xdddddd, 0xe5d8d1,
    0xecd3c6, 0xf1ccb9, 0xf5c4ad, 0xf7bba0, 0xf7b194, 0xf7a687, 0xf49a7b, 0xf18d6f, 0xec7f63,
    0xe57057, 0xde614c, 0xd55042, 0xcb3e38, 0xc0282f, 0xb40426,
];

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
    fn ends_are_the_ends_of_the_tables() {
        assert_eq!(ColourMap::Viridis.at(0.0), Colour::hex(0x440154));
        assert_eq!(ColourMap::Viridis.at(1.0), Colour::hex(0xfde725));
        assert_eq!(ColourMap::CoolWarm.at(7.0), Colour::hex(0xb40426));
    }

    #[test]
    fn viridis_gets_steadily_lighter() {
        let light = |i: u32| {
            let [r, g, b] = ColourMap::Viridis.at(f64::from(i) / 100.0).0.map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((0..100).all(|i| light(i + 1) > light(i)));
    }

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

//! Colours, and maps from numbers to colours.

/// An opaque sRGB colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(
    /// Red, green and blue from 0 to 255.
    pub [u8; 3],
);

impl Colour {
    /// Paper.
    pub(crate) const WHITE: Self = Self::hex(0xffffff);
    /// Text and frames.
    pub(crate) const INK: Self = Self::hex(0x262626);
    /// Walls.
    pub(crate) const WALL: Self = Self::hex(0x3a3a3a);
    /// Grid lines.
    pub(crate) const FAINT: Self = Self::hex(0xdddddd);
    /// Series in the background of a plot.
    pub(crate) const PALE: Self = Self::hex(0xc4c4c4);
    /// Colour of highlights in a plot, behind its lines.
    pub(crate) const HIGHLIGHT: Self = Self::hex(0xffe08a);
    /// Colour of rings around marked particles.
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
}

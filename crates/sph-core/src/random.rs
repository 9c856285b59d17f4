//! Random numbers that are the same on every machine.

/// Numbers without a pattern from a seed, the same on every machine: splitmix64 (Steele, Lea & Flood 2014).
#[derive(Clone, Debug)]
pub struct SplitMix(pub u64);

#[expect(
    clippy::should_implement_trait,
    reason = "the numbers have no end, so that an iterator's option would always be there"
)]
impl SplitMix {
    /// 64 bits.
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_of_seed_zero_is_the_published_one() {
        assert_eq!(SplitMix(0).next(), 0xe220_a839_7b1d_cdaf);
    }
}

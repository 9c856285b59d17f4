//! Reductions of many values to a number.

/// Reduction of values to a number. NaN where there is none, but for sums, counts and shares of something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reduce {
    /// The least.
    Min,
    /// The largest.
    Max,
    /// Σ w v/Σ w.
    Mean,
    /// Σ w v.
    Sum,
    /// √(Σ w v²/Σ w).
    Rms,
    /// The weight of the values, Σ w.
    Total,
    /// The weight over that of all particles of the phase.
    Share,
    /// The least value that a share q of the weight does not exceed.
    Quantile(f64),
    /// The largest value that a share q of the weight does not fall below.
    QuantileDown(f64),
    /// The first value from below beyond which a share of the weight lies, not included.
    FromBelow(f64),
    /// The same from above.
    FromAbove(f64),
}

/// Values with their weights, as far as they are not all one.
#[derive(Clone, Copy)]
pub(crate) struct WeightedValues<'a> {
    pub values: &'a [f64],
    pub weights: Option<&'a [f64]>,
    /// The weight of all particles of the phase.
    pub whole: f64,
}

impl WeightedValues<'_> {
    fn total(&self) -> f64 {
        self.weights
            .map_or(self.values.len() as f64, |w| w.iter().sum())
    }

    fn sum(&self, of: impl Fn(f64) -> f64) -> f64 {
        match self.weights {
            None => self.values.iter().map(|v| of(*v)).sum(),
            Some(weights) => self
                .values
                .iter()
                .zip(weights)
                .map(|(v, w)| w * of(*v))
                .sum(),
        }
    }

    /// The reduced value.
    pub fn reduced(&self, how: Reduce) -> f64 {
        let values = || self.values.iter().copied();
        match how {
            Reduce::Min => values().fold(f64::NAN, f64::min),
            Reduce::Max => values().fold(f64::NAN, f64::max),
            Reduce::Sum => self.sum(|v| v),
            Reduce::Mean => self.sum(|v| v) / self.total(),
            Reduce::Rms => (self.sum(|v| v * v) / self.total()).sqrt(),
            Reduce::Total => self.total(),
            Reduce::Share => self.total() / self.whole,
            Reduce::Quantile(share) => self.quantile(share),
            Reduce::QuantileDown(share) => {
                let values: Vec<f64> = values().map(|v| -v).collect();
                let values = &values;
                -WeightedValues { values, ..*self }.quantile(share)
            }
            Reduce::FromBelow(share) => self.beyond(share, false),
            Reduce::FromAbove(share) => self.beyond(share, true),
        }
    }

    fn quantile(&self, share: f64) -> f64 {
        let Some(weights) = self.weights else {
            let mut values = self.values.to_vec();
            if values.is_empty() {
                return f64::NAN;
            }
            // The last of the share, counted from one.
            let last = (share * values.len() as f64).ceil() as usize;
            let last = last.clamp(1, values.len()) - 1;
            return *values.select_nth_unstable_by(last, f64::total_cmp).1;
        };
        let mut pairs: Vec<_> = self.values.iter().copied().zip(weights).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut sum, wanted) = (0.0, share * self.total());
        let found = pairs.iter().find(|(_, weight)| {
            sum += **weight;
            sum >= wanted
        });
        found.or(pairs.last()).map_or(f64::NAN, |pair| pair.0)
    }

    fn beyond(&self, share: f64, from_above: bool) -> f64 {
        let ones;
        let weights = match self.weights {
            Some(weights) => weights,
            None => {
                ones = vec![1.0; self.values.len()];
                &ones
            }
        };
        let mut pairs: Vec<_> = self.values.iter().copied().zip(weights).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let left_out = share * pairs.iter().map(|pair| pair.1).sum::<f64>();
        if from_above {
            pairs.reverse();
        }
        let mut sum = 0.0;
        let found = pairs.iter().find(|(_, weight)| {
            sum += **weight;
            sum > left_out
        });
        found.map_or(f64::NAN, |pair| pair.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reductions_are_what_their_formulas_say() {
        let weighed = WeightedValues {
            values: &[3.0, -1.0, 2.0],
            weights: Some(&[1.0, 2.0, 1.0]),
            whole: 8.0,
        };
        let of = |how| weighed.reduced(how);
        assert_eq!([of(Reduce::Min), of(Reduce::Max)], [-1.0, 3.0]);
        assert_eq!([of(Reduce::Sum), of(Reduce::Mean)], [3.0, 0.75]);
        assert_eq!(of(Reduce::Rms), (15.0_f64 / 4.0).sqrt());
        assert_eq!([of(Reduce::Total), of(Reduce::Share)], [4.0, 0.5]);
        let quantiles = [0.0, 0.5, 0.51, 1.0].map(|q| of(Reduce::Quantile(q)));
        assert_eq!(quantiles, [-1.0, -1.0, 2.0, 3.0]);
        assert_eq!(of(Reduce::QuantileDown(0.5)), 2.0);
        assert_eq!(of(Reduce::FromBelow(0.5)), 2.0);
        assert_eq!(of(Reduce::FromAbove(0.5)), -1.0);
    }

    #[test]
    fn nothing_has_no_mean_and_a_sum_of_nothing() {
        let nothing = WeightedValues {
            values: &[],
            weights: None,
            whole: 0.0,
        };
        for how in [
            Reduce::Min,
            Reduce::Max,
            Reduce::Mean,
            Reduce::Quantile(0.5),
        ] {
            assert!(nothing.reduced(how).is_nan(), "{how:?}");
        }
        assert_eq!(nothing.reduced(Reduce::Sum), 0.0);
        assert_eq!(nothing.reduced(Reduce::Total), 0.0);
    }
}

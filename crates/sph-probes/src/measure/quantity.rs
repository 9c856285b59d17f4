//! Quantities of single particles, and reductions of many values to a number.

use sph_core::{fields, parameters};

use super::particles::{AXES, MADE, MeasuredParticles, Values, parts};

/// A quantity that every particle has, by its name: a column, of several components their magnitude (`pressure`), a
/// component of one (`velocity.x`), or one that is made of columns (`x`, `speed`, `kinetic_energy`).
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity(String);

impl Quantity {
    /// The quantity of a name.
    pub fn named(name: &str) -> Self {
        Quantity(name.into())
    }

    /// The unit of a quantity that is no column.
    pub fn unit(&self) -> Option<&'static str> {
        let made = MADE.iter().find(|(name, _)| *name == self.0);
        made.map(|(_, unit)| *unit)
    }

    /// The column that has to be computed for it.
    pub fn column(&self) -> Option<&str> {
        self.unit().is_none().then(|| parts(&self.0).0)
    }

    /// The values of all particles.
    ///
    /// # Errors
    /// If there is no such column or component.
    pub fn values<'a, const D: usize, P: MeasuredParticles<D>>(
        &self,
        of: &'a P,
    ) -> Result<Values<'a, P::Unit>, P::Error> {
        let value: Box<dyn Fn(usize) -> f64> = match self.0.as_str() {
            "speed" => return of.speeds(),
            // ½ m u², per metre of depth in 2D.
            "kinetic_energy" => {
                let ((m, _), u) = (of.column(fields::MASS.name)?, of.velocities()?);
                Box::new(move |k| 0.5 * m(k) * u[k].norm_squared())
            }
            // −m g·r, per metre of depth in 2D; it counts from the origin.
            "potential_energy" => {
                let ((m, _), x) = (of.column(fields::MASS.name)?, of.positions()?);
                let g = of.gravity()?;
                Box::new(move |k| -(m(k) * g.dot(&x[k])))
            }
            name => match AXES.iter().position(|axis| *axis == name) {
                Some(axis) => {
                    let (x, axis) = (of.positions()?, axis.min(D - 1));
                    Box::new(move |k| x[k][axis])
                }
                None => return of.column(name),
            },
        };
        Ok((value, self.unit().unwrap_or_default().into()))
    }
}

/// A reduction of many values to a number.
#[parameters]
#[derive(Copy, PartialEq)]
#[serde(rename_all = "lowercase")]
pub enum Reduction {
    /// The least value.
    Min,
    /// The largest value.
    Max,
    /// Σ w v/Σ w.
    #[default]
    Mean,
    /// Σ w v.
    Sum,
    /// √(Σ w v²/Σ w).
    Rms,
    /// The weight of the particles that count, Σ w: their number, mass or volume.
    Total,
    /// Their weight over that of all particles of the phase.
    Share,
}

impl Reduction {
    /// All of them, with their names in scenes.
    pub const ALL: [(Reduction, &'static str); 7] = [
        (Reduction::Min, "min"),
        (Reduction::Max, "max"),
        (Reduction::Mean, "mean"),
        (Reduction::Sum, "sum"),
        (Reduction::Rms, "rms"),
        (Reduction::Total, "total"),
        (Reduction::Share, "share"),
    ];

    /// Its name in scenes.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}

/// Reduction of values to a number. NaN where there is none, but for sums, counts and shares of something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reduce {
    /// By one of the reductions that scenes name.
    By(Reduction),
    /// The least value that a share q of the weight does not exceed.
    Quantile(f64),
    /// The largest value that a share q of the weight does not fall below.
    QuantileDown(f64),
    /// The first value from below beyond which a share of the weight lies, not included.
    FromBelow(f64),
    /// The same from above.
    FromAbove(f64),
}

impl From<Reduction> for Reduce {
    fn from(how: Reduction) -> Self {
        Reduce::By(how)
    }
}

/// Values with their weights, as far as they are not all one.
#[derive(Clone, Copy)]
pub struct WeightedValues<'a> {
    /// The values.
    pub values: &'a [f64],
    /// Their weights.
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
            Some(weights) => {
                let weighed = self.values.iter().zip(weights);
                weighed.map(|(v, w)| w * of(*v)).sum()
            }
        }
    }

    /// The reduced value.
    pub fn reduced(&self, how: impl Into<Reduce>) -> f64 {
        let values = || self.values.iter().copied();
        match how.into() {
            Reduce::By(Reduction::Min) => values().fold(f64::NAN, f64::min),
            Reduce::By(Reduction::Max) => values().fold(f64::NAN, f64::max),
            Reduce::By(Reduction::Sum) => self.sum(|v| v),
            Reduce::By(Reduction::Mean) => self.sum(|v| v) / self.total(),
            Reduce::By(Reduction::Rms) => (self.sum(|v| v * v) / self.total()).sqrt(),
            Reduce::By(Reduction::Total) => self.total(),
            Reduce::By(Reduction::Share) => self.total() / self.whole,
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
        let wanted = share * weights.iter().sum::<f64>();
        let pairs = self.sorted();
        let last = || pairs.last().map(|pair| pair.0);
        reached(&pairs, |sum| sum >= wanted)
            .or_else(last)
            .unwrap_or(f64::NAN)
    }

    fn beyond(&self, share: f64, from_above: bool) -> f64 {
        let mut pairs = self.sorted();
        let left_out = share * pairs.iter().map(|pair| pair.1).sum::<f64>();
        if from_above {
            pairs.reverse();
        }
        reached(&pairs, |sum| sum > left_out).unwrap_or(f64::NAN)
    }

    /// Values with their weights, from the least up.
    fn sorted(&self) -> Vec<(f64, f64)> {
        let weight = |k: usize| self.weights.map_or(1.0, |all| all[k]);
        let values = self.values.iter().enumerate();
        let mut pairs: Vec<_> = values.map(|(k, value)| (*value, weight(k))).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        pairs
    }
}

/// The first value up to which the sum of the weights is enough.
fn reached(pairs: &[(f64, f64)], enough: impl Fn(f64) -> bool) -> Option<f64> {
    let mut sum = 0.0;
    let mut sums = pairs.iter().map(|(value, weight)| {
        sum += weight;
        (*value, sum)
    });
    sums.find(|(_, sum)| enough(*sum)).map(|(value, _)| value)
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
        let of = |how: Reduction| weighed.reduced(how);
        assert_eq!([of(Reduction::Min), of(Reduction::Max)], [-1.0, 3.0]);
        assert_eq!([of(Reduction::Sum), of(Reduction::Mean)], [3.0, 0.75]);
        assert_eq!(of(Reduction::Rms), (15.0_f64 / 4.0).sqrt());
        assert_eq!([of(Reduction::Total), of(Reduction::Share)], [4.0, 0.5]);
        let quantiles = [0.0, 0.5, 0.51, 1.0].map(|q| weighed.reduced(Reduce::Quantile(q)));
        assert_eq!(quantiles, [-1.0, -1.0, 2.0, 3.0]);
        assert_eq!(weighed.reduced(Reduce::QuantileDown(0.5)), 2.0);
        assert_eq!(weighed.reduced(Reduce::FromBelow(0.5)), 2.0);
        assert_eq!(weighed.reduced(Reduce::FromAbove(0.5)), -1.0);
    }

    #[test]
    fn nothing_has_no_mean_and_a_sum_of_nothing() {
        let nothing = WeightedValues {
            values: &[],
            weights: None,
            whole: 0.0,
        };
        for how in [Reduction::Min, Reduction::Max, Reduction::Mean] {
            assert!(nothing.reduced(how).is_nan(), "{how:?}");
        }
        assert!(nothing.reduced(Reduce::Quantile(0.5)).is_nan());
        assert_eq!(nothing.reduced(Reduction::Sum), 0.0);
        assert_eq!(nothing.reduced(Reduction::Total), 0.0);
    }
}

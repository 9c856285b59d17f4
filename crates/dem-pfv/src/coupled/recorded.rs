//! Pressures on a wall that another computation or a measurement has left.

use serde::{Deserialize, Serialize};

use crate::Axis;

/// p(x, t) on a wall, linear between places and between times, constant beyond the first and the last of both: the
/// load of a free surface on a bed, one way.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Recorded {
    /// Axis of the places.
    pub axis: Axis,
    /// Places along it, ascending, m.
    pub places: Vec<f64>,
    /// Times, ascending, s.
    pub times: Vec<f64>,
    /// Pressures (Pa) at all places at the first time, then at the second, and so on.
    pub pressures: Vec<f64>,
}

impl Recorded {
    /// Pressure (Pa) at a place (m) and a time (s).
    pub fn pressure(&self, place: f64, time: f64) -> f64 {
        let width = self.places.len();
        let (row, next, share) = bracket(&self.times, time);
        let at = |row: usize| {
            let row = &self.pressures[row * width..][..width];
            interpolated(&self.places, row, place)
        };
        at(row) + share * (at(next) - at(row))
    }

    /// The fault of the record, if there is one.
    pub fn problem(&self) -> Option<&'static str> {
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        let whole = self.places.len() * self.times.len();
        match () {
            () if whole == 0 || self.pressures.len() != whole => {
                Some("needs one pressure for each place and time, and one at least")
            }
            () if ![&self.places, &self.times, &self.pressures]
                .iter()
                .all(|n| finite(n)) =>
            {
                Some("has numbers that are not finite")
            }
            () if !self.places.is_sorted() => Some("has places that do not ascend"),
            () if !self.times.is_sorted() => Some("has times that do not ascend"),
            () => None,
        }
    }
}

/// A value that is linear between places, constant beyond the ends.
fn interpolated(places: &[f64], values: &[f64], x: f64) -> f64 {
    let (here, next, share) = bracket(places, x);
    values[here] + share * (values[next] - values[here])
}

/// The two of ascending numbers between which x lies, and how far it is from the first to the second.
fn bracket(numbers: &[f64], x: f64) -> (usize, usize, f64) {
    let after = numbers.partition_point(|n| *n <= x);
    let last = numbers.len() - 1;
    match after {
        0 => (0, 0, 0.0),
        after if after > last => (last, last, 0.0),
        after => {
            let [from, to] = [numbers[after - 1], numbers[after]];
            (after - 1, after, (x - from) / (to - from))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bilinear_load_comes_back_and_stays_beyond_the_ends() {
        let (places, times) = (vec![0.0, 0.5, 2.0], vec![0.0, 0.1, 0.4, 1.0]);
        let load = |x: f64, t: f64| (3.0 - 2.0 * x) * (1.0 + 5.0 * t);
        let rows = times
            .iter()
            .flat_map(|t| places.iter().map(|x| load(*x, *t)));
        let recorded = Recorded {
            axis: Axis::X,
            pressures: rows.collect(),
            places,
            times,
        };
        assert_eq!(recorded.problem(), None);
        for [x, t] in [[0.0, 0.0], [0.2, 0.05], [1.7, 0.39], [2.0, 1.0], [0.5, 0.4]] {
            let off = (recorded.pressure(x, t) - load(x, t)).abs();
            assert!(off < 1e-12, "{off} Pa at {x} m and {t} s");
        }
        assert_eq!(recorded.pressure(-1.0, -1.0), load(0.0, 0.0));
        assert_eq!(recorded.pressure(9.0, 9.0), load(2.0, 1.0));
    }

    #[test]
    fn tables_that_do_not_fit_are_named() {
        let good = Recorded {
            axis: Axis::X,
            places: vec![0.0, 1.0],
            times: vec![0.0],
            pressures: vec![1.0, 2.0],
        };
        let with = |change: fn(&mut Recorded)| {
            let mut recorded = good.clone();
            change(&mut recorded);
            recorded.problem().unwrap_or("nothing").to_string()
        };
        assert!(with(|r| r.pressures = vec![1.0]).contains("one pressure for each"));
        assert!(with(|r| r.times = vec![]).contains("one at least"));
        assert!(with(|r| r.places = vec![1.0, 0.0]).contains("places"));
        assert!(with(|r| r.times = vec![f64::NAN]).contains("finite"));
    }
}

//! Walls that change their shape: places along x that are lifted, and walls that grains make.

use sph_core::course::{Course, Stage};

/// A lift along y, linear between places along x and constant beyond the first and the last: a floor that follows the
/// level of a bed. In the plane only.
#[derive(Clone, Debug, PartialEq)]
pub struct Bend {
    /// Places along x where the wall is drawn, ascending, m.
    pub places: Vec<f64>,
    /// The lift at each place over time, m.
    pub lifts: Vec<Course>,
}

impl Bend {
    /// Lift (m), its rate and its acceleration at a place (m) and a time (s).
    #[must_use]
    pub fn at(&self, x: f64, time: f64) -> Stage {
        let after = self.places.partition_point(|p| *p <= x);
        let (next, before) = (after.min(self.places.len() - 1), after.saturating_sub(1));
        let here = self.lifts[before].at(time);
        if next == before {
            return here;
        }
        let there = self.lifts[next].at(time);
        let [from, to] = [self.places[before], self.places[next]];
        let share = ((x - from) / (to - from)).max(0.0);
        let between = |a: f64, b: f64| a + share * (b - a);
        Stage {
            value: between(here.value, there.value),
            rate: between(here.rate, there.rate),
            acceleration: between(here.acceleration, there.acceleration),
        }
    }

    /// True if it is one: as many lifts as places, which ascend.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let places = &self.places;
        !places.is_empty()
            && places.len() == self.lifts.len()
            && places.iter().all(|x| x.is_finite())
            && places.windows(2).all(|p| p[0] < p[1])
            && self.lifts.iter().all(Course::is_sound)
    }
}

/// A wall whose surface is a bed of grains: the data to lay its [`Bed`](sph_core::bed::Bed). Walls that stand in the
/// bed have the same.
#[derive(Clone, Debug, PartialEq)]
pub struct Erodible {
    /// Name of the wall whose surface is the bed.
    pub wall: String,
    /// Distance of the places at which the level is known, m.
    pub cell: f64,
    /// Start of the bed along x and y, m; −∞ for as far as the wall goes.
    pub from: [f64; 2],
    /// End of the bed, m; ∞ for as far as the wall goes.
    pub to: [f64; 2],
    /// The level under which there are no grains, m; −∞ without.
    pub rock: f64,
    /// Height over the bed within which walls that stand in it stretch, m.
    pub fade: f64,
}

impl Erodible {
    /// True if all its numbers are possible.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let ordered = (0..2).all(|k| self.from[k] < self.to[k]);
        positive(self.cell) && positive(self.fade) && ordered && self.rock < f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lift_is_linear_between_places_and_keeps_what_it_has_beyond() {
        let lifts = [1.0, 3.0, -1.0].map(|speed| Course::Steady { speed });
        let bend = Bend {
            places: vec![1.0, 2.0, 4.0],
            lifts: lifts.into(),
        };
        assert!(bend.is_sound());
        for (x, rate) in [
            (0.0, 1.0),
            (1.0, 1.0),
            (1.5, 2.0),
            (2.0, 3.0),
            (3.5, 0.0),
            (4.0, -1.0),
            (9.0, -1.0),
        ] {
            let stage = bend.at(x, 0.5);
            assert_eq!([stage.value, stage.rate], [0.5 * rate, rate], "at {x} m");
        }
        let none = Bend {
            places: Vec::new(),
            lifts: Vec::new(),
        };
        assert!(!none.is_sound());
    }
}

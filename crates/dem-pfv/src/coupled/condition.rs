//! Conditions of the fluid at the walls.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use sph_core::parameters;

use crate::Axis;
use crate::coupled::{CoupledError, Vector};
use crate::flow::{Boundary, PoreGeometry};
use crate::triangulation::Vertex;

/// A wall as the fluid sees it.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct WallBoundary {
    /// The value given there.
    pub condition: FlowCondition,
    /// True if fluid sticks to the wall; otherwise it slides, as on a plane of symmetry.
    pub sticks: bool,
}

/// Condition of the flow at a wall. Pressures are piezometric: zero everywhere in fluid at rest. Where two walls with
/// pressures meet, the later one counts. The fluid pushes a wall with the pressure inside; a piston's stress is the
/// total one.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub enum FlowCondition {
    /// No flow: undrained.
    Closed,
    /// One pressure, Pa: drained.
    Pressure(f64),
    /// The load of a wave.
    Wave(Wave),
    /// Result of another computation, such as a free surface with waves above a bed. Replace it as often as it changes.
    Recorded(Recorded),
    /// An even inflow, m/s; negative lets fluid out.
    Inflow(f64),
}

/// p = (amplitude + ramp · t) cos(π (x − crest) / half_length), times sin(2π t / period) if there is one: waves on the
/// bed's surface, the mean pressure removed. Source: Catalano 2012, §6.3.2 (ramps) and §6.4 (standing waves).
#[parameters]
#[derive(Copy, PartialEq, Serialize)]
pub struct Wave {
    /// Axis along which it runs.
    #[parameter(default)]
    pub axis: Axis,
    /// Place of the crest, m.
    #[parameter(default, unit: "m")]
    pub crest: f64,
    /// Half the length of the wave, m.
    #[parameter(unit: "m", above: 0.0)]
    pub half_length: f64,
    /// Amplitude of the pressure at the start, Pa.
    #[parameter(default, unit: "Pa")]
    pub amplitude: f64,
    /// Growth of the amplitude, Pa/s.
    #[parameter(default, unit: "Pa/s")]
    pub ramp: f64,
    /// Period, s; the load stands still if left out.
    #[parameter(unit: "s", above: 0.0)]
    pub period: Option<f64>,
}

impl Wave {
    /// Pressure (Pa) at a place (m) and a time (s).
    pub fn pressure(&self, place: &Vector, time: f64) -> f64 {
        let phase = PI * (place[self.axis.number()] - self.crest) / self.half_length;
        let swing = self.period.map_or(1.0, |t| (2.0 * PI * time / t).sin());
        (self.amplitude + self.ramp * time) * phase.cos() * swing
    }
}

impl WallBoundary {
    /// No flow, and no grip.
    pub fn closed() -> Self {
        Self {
            condition: FlowCondition::Closed,
            sticks: false,
        }
    }

    /// A given pressure (Pa) without grip.
    pub fn drained(pressure: f64) -> Self {
        Self {
            condition: FlowCondition::Pressure(pressure),
            sticks: false,
        }
    }

    pub(crate) fn check(&self, wall: usize) -> Result<(), CoupledError> {
        let bad = |problem| Err(CoupledError::BadCondition(wall, problem));
        let finite = |numbers: &[f64]| numbers.iter().all(|x| x.is_finite());
        match &self.condition {
            FlowCondition::Closed => Ok(()),
            FlowCondition::Pressure(p) if !p.is_finite() => bad("is a pressure that is not finite"),
            FlowCondition::Inflow(v) if !v.is_finite() => bad("is an inflow that is not finite"),
            FlowCondition::Pressure(_) | FlowCondition::Inflow(_) => Ok(()),
            FlowCondition::Recorded(recorded) => recorded.problem().map_or(Ok(()), bad),
            FlowCondition::Wave(w) => {
                let lengths = [w.half_length, w.period.unwrap_or(1.0)];
                match () {
                    () if !finite(&[w.crest, w.amplitude, w.ramp]) || !finite(&lengths) => {
                        bad("has numbers that are not finite")
                    }
                    () if lengths.iter().any(|l| *l <= 0.0) => {
                        bad("has a length or a period that is not positive")
                    }
                    () => Ok(()),
                }
            }
        }
    }

    /// True if its values change while the clock runs.
    pub(crate) fn varies(&self) -> bool {
        matches!(
            self.condition,
            FlowCondition::Wave(_) | FlowCondition::Recorded(_)
        )
    }

    /// True if both give a pressure, or neither does: then a change needs no new matrix.
    pub(crate) fn like(&self, other: &Self) -> bool {
        self.sticks == other.sticks && self.presses() == other.presses()
    }

    /// True if it gives a pressure.
    fn presses(&self) -> bool {
        !matches!(
            self.condition,
            FlowCondition::Closed | FlowCondition::Inflow(_)
        )
    }

    /// Sets the given values at a time (s) in the conditions of the flow.
    fn apply_at(&self, boundary: &mut Boundary, pores: &PoreGeometry, wall: usize, time: f64) {
        match &self.condition {
            FlowCondition::Closed => {}
            FlowCondition::Pressure(p) => boundary.pressure(pores, wall, |_| Some(*p)),
            FlowCondition::Wave(w) => {
                boundary.pressure(pores, wall, |x| Some(w.pressure(&x, time)))
            }
            FlowCondition::Recorded(r) => {
                boundary.pressure(pores, wall, |x| Some(r.pressure(x[r.axis.number()], time)));
            }
            FlowCondition::Inflow(v) => {
                boundary.inflow(pores, wall, *v, |_| true);
            }
        }
    }
}

/// The conditions of all walls at a time (s).
pub(crate) fn boundary(sides: &[WallBoundary], pores: &PoreGeometry, time: f64) -> Boundary {
    let mut boundary = Boundary::closed(pores);
    for (wall, side) in sides.iter().enumerate() {
        side.apply_at(&mut boundary, pores, wall, time);
    }
    boundary
}

/// Flux into the pores through every wall, m³/s, from that through each cell with a given pressure.
pub(crate) fn inflows(sides: &[WallBoundary], pores: &PoreGeometry, influx: &[f64]) -> Vec<f64> {
    let mut owners = vec![usize::MAX; influx.len()];
    let around = |wall: usize| pores.mesh.cells_around(Vertex::Wall(wall)).iter();
    for (wall, _) in sides.iter().enumerate().filter(|(_, s)| s.presses()) {
        around(wall).for_each(|c| owners[*c as usize] = wall);
    }
    let through = |(wall, side): (usize, &WallBoundary)| match side.condition {
        FlowCondition::Inflow(v) => around(wall)
            .map(|c| v * pores.area_on_wall(*c as usize, wall))
            .sum(),
        _ => (owners.iter().zip(influx))
            .filter(|(o, _)| **o == wall)
            .map(|(_, q)| q)
            .sum(),
    };
    sides.iter().enumerate().map(through).collect()
}

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

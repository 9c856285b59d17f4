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

    fn problem(&self) -> Option<&'static str> {
        let lengths = [self.half_length, self.period.unwrap_or(1.0)];
        match () {
            () if !finite(&[self.crest, self.amplitude, self.ramp]) || !finite(&lengths) => {
                Some("has numbers that are not finite")
            }
            () if lengths.iter().any(|l| *l <= 0.0) => {
                Some("has a length or a period that is not positive")
            }
            () => None,
        }
    }
}

fn finite(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}

impl From<FlowCondition> for WallBoundary {
    /// Without grip.
    fn from(condition: FlowCondition) -> Self {
        Self {
            condition,
            sticks: false,
        }
    }
}

impl WallBoundary {
    /// No flow, and no grip.
    pub fn closed() -> Self {
        FlowCondition::Closed.into()
    }

    /// A given pressure (Pa) without grip.
    pub fn drained(pressure: f64) -> Self {
        FlowCondition::Pressure(pressure).into()
    }

    pub(crate) fn check(&self, wall: usize) -> Result<(), CoupledError> {
        let bad = |problem| Err(CoupledError::BadCondition(wall, problem));
        match &self.condition {
            FlowCondition::Pressure(p) if !p.is_finite() => bad("is a pressure that is not finite"),
            FlowCondition::Inflow(v) if !v.is_finite() => bad("is an inflow that is not finite"),
            FlowCondition::Recorded(recorded) => recorded.problem().map_or(Ok(()), bad),
            FlowCondition::Wave(wave) => wave.problem().map_or(Ok(()), bad),
            _ => Ok(()),
        }
    }

    /// True if it gives a pressure: a change to another one that does, or does not as well, needs no new matrix.
    pub(crate) fn presses(&self) -> bool {
        use FlowCondition::{Closed, Inflow};
        !matches!(self.condition, Closed | Inflow(_))
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
        FlowCondition::Inflow(v) => {
            let rate = |c: &u32| v * pores.area_on_wall(*c as usize, wall);
            around(wall).map(rate).sum()
        }
        _ => {
            let own = owners.iter().zip(influx).filter(|(o, _)| **o == wall);
            own.map(|(_, q)| q).sum()
        }
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
        let (left, right, part) = bracket(&self.places, place);
        let at = |row: usize| {
            let row = &self.pressures[row * width..][..width];
            row[left] + part * (row[right] - row[left])
        };
        at(row) + share * (at(next) - at(row))
    }

    /// The fault of the record, if there is one.
    pub fn problem(&self) -> Option<&'static str> {
        let all = [&self.places, &self.times, &self.pressures];
        let whole = self.places.len() * self.times.len();
        match () {
            () if whole == 0 || self.pressures.len() != whole => {
                Some("needs one pressure for each place and time, and one at least")
            }
            () if !all.iter().all(|n| finite(n)) => Some("has numbers that are not finite"),
            () if !self.places.is_sorted() => Some("has places that do not ascend"),
            () if !self.times.is_sorted() => Some("has times that do not ascend"),
            () => None,
        }
    }
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

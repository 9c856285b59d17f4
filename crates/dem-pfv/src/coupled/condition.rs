//! Conditions of the fluid at the walls.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};
use sph_core::parameters;

use crate::Axis;
use crate::coupled::{CoupledError, Recorded, Vector};
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

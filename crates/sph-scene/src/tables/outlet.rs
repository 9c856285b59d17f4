//! The tables `[outlet.NAME]`, where particles leave the flow, and `[zone.NAME]`, where it is computed with finer ones.

use sph_core::{Axis, parameters};

use crate::Heading;
use crate::tables::body::BodyShape;

/// A place where particles leave the flow: a box, or all that is beyond a plane across an axis.
///
/// A particle that is there at the end of a step is taken out, and its mass counted. Nothing is
/// there at the start. Neither the outlet nor fluid beyond it holds the flow back: what is upstream
/// has a free surface there, which suits falls and flows faster than their waves.
#[parameters]
pub struct Outlet {
    /// Lower and upper corner of a box, m.
    #[serde(rename = "box")]
    #[parameter(unit: "m")]
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Place of a plane along `axis`, m: particles beyond it leave.
    #[parameter(unit: "m")]
    pub beyond: Option<f64>,
    /// Axis across which the plane stands; x if left out.
    pub axis: Option<Axis>,
    /// Side of the plane that is beyond it, `forward` or `backward`; larger coordinates if left out.
    pub direction: Option<Heading>,
}

impl Outlet {
    /// True if a place is in the outlet.
    pub fn contains<const D: usize>(&self, x: &[f64; D]) -> bool {
        if let Some([lo, hi]) = &self.bounds {
            let within = |k: usize| lo.get(k) <= Some(&x[k]) && Some(&x[k]) <= hi.get(k);
            return (0..D).all(within);
        }
        let at = x[self.axis.map_or(0, |axis| axis as usize).min(D - 1)];
        let direction = self.direction.unwrap_or_default();
        self.beyond.is_some_and(|plane| match direction {
            Heading::Forward => at > plane,
            Heading::Backward => at < plane,
        })
    }
}

/// All places within a distance of a wall.
#[parameters]
pub struct NearWall {
    /// Name of the wall.
    pub wall: String,
    /// Distance from it.
    #[parameter(unit: "m", above: 0.0)]
    pub distance: f64,
}

/// A place in which the flow is computed with finer particles, too.
///
/// The scene's own particles stay everywhere; within the shape they follow the finer ones, and finer ones in a band around
/// it follow the scene's.
#[parameters]
pub struct Zone {
    /// Its shape, which may reach beyond walls; a box may span a whole period.
    #[serde(flatten)]
    pub shape: BodyShape,
    /// All that is near a wall, in place of a shape.
    pub near: Option<NearWall>,
    /// Name of a wall that carries the shape with its centre; if left out, the wall of `near`, or none.
    pub follows: Option<String>,
    /// Spacing in the zone over that of the scene: 1/2, or 1/4 and 1/8 within a zone of twice that.
    #[parameter(default: 0.5, above: 0, below: 1)]
    pub ratio: f64,
    /// Probes and gauges that are measured with the particles of the zone.
    #[parameter(default)]
    pub probes: Vec<String>,
}

//! Transforms of a geometry: scaled, turned, shifted.

use scene_text::surface::{cross, dot};

use crate::Wall;
use crate::geometry::solid::clean;
use crate::geometry::vector::{array, unit_axis};

/// x → turn·(factor·x − centre) + centre + shift.
pub(crate) struct Placing {
    factor: f64,
    turn: Option<RotationAxis>,
    shift: [f64; 3],
}

struct RotationAxis {
    centre: [f64; 3],
    axis: [f64; 3],
    cos: f64,
    sin: f64,
}

impl Placing {
    pub fn new(wall: &Wall, factor: f64) -> Self {
        let turn = wall.rotate.as_ref().map(|rotate| RotationAxis {
            centre: array(rotate.centre.as_deref().unwrap_or(&[])),
            axis: unit_axis(&rotate.axis),
            cos: clean(rotate.angle.cos()),
            sin: clean(rotate.angle.sin()),
        });
        Placing {
            factor,
            turn,
            shift: array(wall.translate.as_deref().unwrap_or(&[])),
        }
    }

    pub fn apply(&self, x: &[f64; 3]) -> [f64; 3] {
        let mut x = x.map(|c| self.factor * c);
        if let Some(turn) = &self.turn {
            let arm: [f64; 3] = std::array::from_fn(|k| x[k] - turn.centre[k]);
            let across = cross(&turn.axis, &arm);
            let along = dot(&turn.axis, &arm) * (1.0 - turn.cos);
            x = std::array::from_fn(|k| {
                let turned = turn.cos * arm[k] + turn.sin * across[k] + along * turn.axis[k];
                turn.centre[k] + turned
            });
        }
        std::array::from_fn(|k| x[k] + self.shift[k])
    }

    pub fn flat(&self, x: &[f64; 2]) -> [f64; 2] {
        let [x, y, _] = self.apply(&[x[0], x[1], 0.0]);
        [x, y]
    }
}

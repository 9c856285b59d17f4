//! Conditions of fluids at walls, as scenes name them.

use crate::parameters;

/// Condition of the fluid at a wall.
#[parameters]
#[derive(Copy, PartialEq)]
pub struct WallCondition {
    /// Condition of the fluid at the wall: it sticks or slips.
    #[serde(rename = "condition")]
    #[parameter(default)]
    pub slip: SlipCondition,
    /// Slip length, m, for `condition = "partial-slip"`: how deep in the wall the fluid's velocity, continued straight, is the wall's.
    #[parameter(unit: "m", above: 0.0)]
    pub slip_length: Option<f64>,
    /// Coefficient of friction μ, for `condition = "coulomb"`: soils that slide are pulled with μ times their load on
    /// the wall.
    #[parameter(unit: "1", min: 0.0)]
    pub friction_coefficient: Option<f64>,
    /// Distribution of that friction, for `condition = "coulomb"`.
    pub friction_form: Option<FrictionForm>,
}

/// Condition of a wall for the velocity along it.
#[parameters]
pub enum SlipCondition {
    /// The fluid moves with the wall.
    #[default]
    NoSlip,
    /// The fluid slides along the wall without friction.
    FreeSlip,
    /// The fluid slides with friction: its velocity relative to the wall is the slip length times its gradient.
    PartialSlip,
    /// Soils slide with Coulomb's friction, other fluids without any.
    Coulomb,
}

/// Distribution of Coulomb's friction at a wall among the particles.
#[parameters]
pub enum FrictionForm {
    /// All of it: the coefficient times the force on the wall.
    #[default]
    Normalised,
    /// As printed (Ghaïtanellis 2017, Eq. 4.118): a quarter to a third of it arrives.
    Literal,
}

impl WallCondition {
    /// 1 where the wall rubs, 0 where it slips freely.
    #[must_use]
    pub fn friction_factor(&self) -> f64 {
        match self.slip {
            SlipCondition::NoSlip | SlipCondition::PartialSlip => 1.0,
            SlipCondition::FreeSlip | SlipCondition::Coulomb => 0.0,
        }
    }

    /// Slip length, m; 0 if the fluid sticks.
    #[must_use]
    pub fn slip_length(&self) -> f64 {
        self.slip_length.unwrap_or(0.0)
    }
}

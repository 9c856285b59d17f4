//! Conditions and grains of walls, as scenes name them.

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

/// Grains that a wall is made of, so far as it faces upwards: a law of [bed load](https://docs.rs/sph-soil) raises and lowers it.
///
/// A bed that is a part of its wall ends where grains come and go, as many as the flow carries there; a whole wall keeps its
/// grains.
#[parameters]
#[derive(PartialEq)]
pub struct Erodible {
    /// Distance of the places at which the level is known, m; the spacing if left out.
    #[parameter(unit: "m", above: 0.0)]
    pub cell: Option<f64>,
    /// Start of the bed along x, in three dimensions along x and y, m; `-inf` or left out for as far as the wall goes.
    #[parameter(unit: "m", min_items: 1)]
    pub from: Option<Vec<f64>>,
    /// End of the bed, m; `inf` or left out for as far as the wall goes.
    #[parameter(unit: "m", min_items: 1)]
    pub to: Option<Vec<f64>>,
    /// Level under which there are no grains, m; grains without end if left out.
    #[parameter(unit: "m")]
    pub rock: Option<f64>,
    /// Height over the bed within which walls that stand in it stretch, m; ten spacings if left out.
    #[parameter(unit: "m", above: 0.0)]
    pub stretch: Option<f64>,
}

impl Erodible {
    /// Start and end of the bed along an axis, m; infinite for as far as the wall goes.
    #[must_use]
    pub fn extent(&self, axis: usize) -> [f64; 2] {
        let at = |end: &Option<Vec<f64>>| end.as_ref()?.get(axis).copied();
        [
            at(&self.from).unwrap_or(f64::NEG_INFINITY),
            at(&self.to).unwrap_or(f64::INFINITY),
        ]
    }

    /// True if all its numbers are possible, with a cell and a height given.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let positive = |x: Option<f64>| x.is_some_and(|x| x > 0.0 && x.is_finite());
        let ordered = (0..2).map(|k| self.extent(k)).all(|[from, to]| from < to);
        positive(self.cell) && positive(self.stretch) && ordered && self.rock < Some(f64::INFINITY)
    }
}

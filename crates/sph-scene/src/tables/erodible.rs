//! The table `[wall.NAME.erodible]`: a wall that grains make.

use sph_core::parameters;

/// Grains that a wall is made of, so far as it faces upwards: a law of [bed load](https://docs.rs/sph-soil) raises and lowers it.
///
/// A bed that is a part of its wall ends where grains come and go, as many as the flow carries there; a whole wall keeps its
/// grains.
#[parameters]
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

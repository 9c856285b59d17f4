//! The tables `[grains]` and `[start]`: which grains, and where they come from.

use sph_core::parameters;

use super::{AnyPlugins, Grown, Plugins};

/// The grains and the law of their contacts.
#[parameters]
pub struct Grains {
    /// Number of grains; not with a file, a lattice or a filled box.
    #[parameter(min: 1, max: 10_000_000)]
    pub count: Option<usize>,
    /// Smallest and largest radius, m; drawn evenly from between them. Not with a file.
    #[schemars(inner(range(min = 0.0)))]
    #[parameter(unit: "m", quantity: "spacing")]
    pub radius: Option<[f64; 2]>,
    /// Density ρ_s, kg/m³.
    #[parameter(unit: "kg/m³", above: 0.0)]
    pub density: f64,
    /// Another number draws other grains.
    #[parameter(default: 1)]
    pub seed: u64,
    /// Gravity, m/s²; none if left out.
    #[parameter(unit: "m/s²")]
    pub gravity: Option<[f64; 3]>,
    /// The law of contacts, `[grains.contact.LAW]`.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
    /// Skin of the lists of neighbours, m; a fifth of the mean radius if left out.
    #[parameter(unit: "m", above: 0.0)]
    pub skin: Option<f64>,
}

/// Positions of the grains at the start, and their preparation: exactly one of `cloud`, `grown`, `rained`, `lattice`
/// and `file`. The clock of the run starts when they are ready.
#[parameters]
pub struct Start {
    /// At random without touching.
    pub cloud: Option<Cloud>,
    /// A cloud in the box whose radii grow until a stress or a porosity is reached.
    pub grown: Option<Grown>,
    /// A cloud above the floor of the box that falls and comes to rest.
    pub rained: Option<Rained>,
    /// Rows and layers.
    pub lattice: Option<Lattice>,
    /// A text file with x, y, z and r in each line; lines with # are comments.
    pub file: Option<String>,
    /// Unit of the numbers in the `file`, such as "mm"; metres if left out.
    pub unit: Option<String>,
    /// The law of contacts between grains during the preparation, `[start.contact.LAW]`; that of the run if left out. Less
    /// friction makes a denser packing.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
    /// The law of contacts with walls and surfaces during the preparation, `[start.wall_contact.LAW]`; those of the run if
    /// left out.
    #[parameter(default)]
    #[schemars(with = "AnyPlugins")]
    pub wall_contact: Plugins,
    /// Coefficient of non-viscous damping during the preparation.
    #[parameter(default: 0.2, unit: "1", min: 0.0, below: 1.0)]
    pub damping: f64,
    /// Share of the largest stable step during the preparation.
    #[parameter(default: 0.6, unit: "1", above: 0.0, max: 1.0, quantity: "safety factor")]
    pub safety: f64,
    /// Tolerance to which the grains come to rest, drained, before the run starts: under gravity, in a fluid under their
    /// buoyant weight, and the `prepared` stress of pistons. At rest are grains whose mean resultant force is below this
    /// share of the mean contact force F, which contacts carry one by one, and whose mean |v| + R|ω| is below this share of
    /// √(F R/m). They are left as they are if this is left out, or is 1 (free fall) or more.
    #[parameter(unit: "1", above: 0.0)]
    pub settle: Option<f64>,
    /// Weight of the grains while they come to rest in a fluid.
    #[parameter(default)]
    pub weight: Weight,
    /// Most steps of a preparation.
    #[parameter(default: 2_000_000, min: 1)]
    pub most_steps: u64,
    /// Distance of the top of the box above the highest grain once they have settled, m; the top stays where `box` has it
    /// if this is left out.
    #[parameter(unit: "m", min: 0.0)]
    pub headroom: Option<f64>,
}

/// Weight of grains that come to rest before the run.
#[parameters]
#[derive(Copy, PartialEq)]
#[serde(rename_all = "lowercase")]
pub enum Weight {
    /// Less buoyancy, as if they were laid down slowly in the fluid.
    #[default]
    Buoyant,
    /// First the whole weight, then less buoyancy: a dry bed that is flooded, its pores filled at hydrostatic pressure.
    Dry,
}

/// At random without touching, in the box or in a part of it.
#[parameters]
pub struct Cloud {
    /// Lower corner, m; that of the box if left out.
    #[parameter(unit: "m")]
    pub low: Option<[f64; 3]>,
    /// Upper corner, m.
    #[parameter(unit: "m")]
    pub high: Option<[f64; 3]>,
}

/// Dry pluviation.
#[parameters]
pub struct Rained {
    /// Porosity of the cloud before it falls.
    #[parameter(default: 0.68, unit: "1", above: 0.0, below: 1.0)]
    pub porosity: f64,
    /// Height that the bed shall have once it lies, m, instead of a `count`: taken with a porosity of 0.4.
    #[parameter(unit: "m", above: 0.0)]
    pub height: Option<f64>,
}

/// Rows and layers that fill the box, each grain a little off its place.
#[parameters]
pub struct Lattice {
    /// Grains along x, y and z.
    #[schemars(inner(range(min = 1, max = 1000)))]
    pub count: [u32; 3],
    /// Largest displacement along an axis, in terms of the distance of rows.
    #[parameter(default, unit: "1", min: 0.0, below: 0.5)]
    pub jitter: f64,
}

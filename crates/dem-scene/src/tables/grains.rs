//! The tables `[grains]` and `[start]`: which grains, and where they come from.

use schemars::JsonSchema;
use serde::Deserialize;

use super::{AnyPlugins, Plugins, Triple};

/// The grains and the law of their contacts.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    /// How many; not with a file, a lattice or a filled box.
    #[schemars(range(min = 1, max = 10_000_000))]
    pub count: Option<usize>,
    /// Smallest and largest radius, m; drawn evenly from between them. Not with a file.
    #[schemars(inner(range(min = 0.0)), extend("unit" = "m", "quantity" = "spacing"))]
    pub radius: Option<[f64; 2]>,
    /// Density ρ_s, kg/m³.
    #[schemars(extend("unit" = "kg/m³", "exclusiveMinimum" = 0.0))]
    pub density: f64,
    /// Another number draws other grains.
    #[serde(default = "one")]
    pub seed: u64,
    /// Gravity, m/s²; none if left out.
    #[schemars(extend("unit" = "m/s²"))]
    pub gravity: Option<Triple>,
    /// The law of contacts, `[grains.contact.LAW]`.
    #[serde(default)]
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
    /// Skin of the lists of neighbours, m; a fifth of the mean radius if left out.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub skin: Option<f64>,
}

/// Where the grains are at the start, and how they were prepared: exactly one of `cloud`, `grown`, `rained`, `lattice`
/// and `file`. The clock of the run starts when they are ready.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
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
    #[serde(default)]
    #[schemars(with = "AnyPlugins")]
    pub contact: Plugins,
    /// Coefficient of non-viscous damping during the preparation.
    #[serde(default = "fifth")]
    #[schemars(extend("unit" = "1", "minimum" = 0.0, "exclusiveMaximum" = 1.0))]
    pub damping: f64,
    /// Share of the largest stable step during the preparation.
    #[serde(default = "share")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0, "maximum" = 1.0, "quantity" = "safety factor"))]
    pub safety: f64,
    /// Tolerance to which the grains come to rest, drained, before the run starts: under gravity, in a fluid under their
    /// buoyant weight, and the `prepared` stress of pistons. At rest are grains whose mean resultant force is below this
    /// share of the mean contact force F, which contacts carry one by one, and whose mean |v| + R|ω| is below this share of
    /// √(F R/m). They are left as they are if this is left out, or is 1 (free fall) or more.
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0))]
    pub settle: Option<f64>,
    /// Most steps of a preparation.
    #[serde(default = "most_steps")]
    #[schemars(range(min = 1))]
    pub most_steps: u64,
    /// Distance of the top of the box above the highest grain once they have settled, m; the top stays where `box` has it
    /// if this is left out.
    #[schemars(extend("unit" = "m", "minimum" = 0.0))]
    pub headroom: Option<f64>,
}

/// At random without touching, in the box or in a part of it.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cloud {
    /// Lower corner, m; that of the box if left out.
    #[schemars(extend("unit" = "m"))]
    pub low: Option<Triple>,
    /// Upper corner, m.
    #[schemars(extend("unit" = "m"))]
    pub high: Option<Triple>,
}

/// Growth to a stress or to a porosity, without gravity. `radius` gives the proportions; at the start they fill a quarter
/// of the box.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grown {
    /// Mean stress of the walls, Pa.
    #[schemars(extend("unit" = "Pa", "exclusiveMinimum" = 0.0))]
    pub stress: Option<f64>,
    /// Porosity.
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0, "exclusiveMaximum" = 1.0))]
    pub porosity: Option<f64>,
    /// Largest factor of the radii in ten steps before the stress was first reached.
    #[serde(default = "fast")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 1.0))]
    pub fast: f64,
    /// The same afterwards.
    #[serde(default = "slow")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 1.0))]
    pub slow: f64,
    /// Unbalanced force ratio and relative distance from the stress at which it ends.
    #[serde(default = "thousandth")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0))]
    pub tolerance: f64,
}

/// Dry pluviation.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rained {
    /// Porosity of the cloud before it falls.
    #[serde(default = "loose")]
    #[schemars(extend("unit" = "1", "exclusiveMinimum" = 0.0, "exclusiveMaximum" = 1.0))]
    pub porosity: f64,
    /// Height that the bed shall have once it lies, m, instead of a `count`: taken with a porosity of 0.4.
    #[schemars(extend("unit" = "m", "exclusiveMinimum" = 0.0))]
    pub height: Option<f64>,
}

/// Rows and layers that fill the box, each grain a little off its place.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lattice {
    /// Grains along x, y and z.
    #[schemars(inner(range(min = 1, max = 1000)))]
    pub count: [u32; 3],
    /// Largest displacement along an axis, in terms of the distance of rows.
    #[serde(default)]
    #[schemars(extend("unit" = "1", "minimum" = 0.0, "exclusiveMaximum" = 0.5))]
    pub jitter: f64,
}

fn one() -> u64 {
    1
}

fn share() -> f64 {
    0.6
}

fn fifth() -> f64 {
    0.2
}

fn most_steps() -> u64 {
    2_000_000
}

fn fast() -> f64 {
    1.0 + 2e4 / 15e6
}

fn slow() -> f64 {
    1.0 + 2e3 / 15e6
}

fn thousandth() -> f64 {
    1e-3
}

fn loose() -> f64 {
    0.68
}

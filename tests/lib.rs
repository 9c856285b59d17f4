//! What the whole-system tests share: a folder of their own, scenes, and the real binary.

mod bench;
mod disk;
mod pages;
mod process;
#[cfg(doctest)]
mod readmes;
mod results;
mod scenes;
mod series;
mod state;
mod texts;

pub use bench::{Bench, CHECK_AND_RUN, Outcome};
pub use disk::Disk;
pub use pages::list_items;
pub use process::{Going, get, wait_until};
pub use results::Results;
pub use scenes::{
    Ran, assembled, changes, evaluated, finished, momentum, move_as, ran, refusal, run_into,
    same_bits, scene, shipped, shipped_file, spin, step,
};
pub use series::Series;
pub use state::{FinalState, files_with_extension};
pub use texts::{
    Refusal, Says, assembly_refuses, below, binary_stl, close, exchanged, line_of, near, one_line,
    refusals, within,
};

/// A dam break in a box: 180 particles, some hundred steps, a fraction of a second.
pub const DAM_BREAK: &str = include_str!("scenes/dam-break.toml");
/// The same with a paddle that moves into the fluid.
pub const PADDLE: &str = include_str!("scenes/paddle.toml");
/// A soil that remembers displacements and blends forces.
pub const SOIL: &str = include_str!("scenes/soil.toml");
/// Stresses of the end of the step, for [`soil_with`].
pub const END_OF_THE_STEP: &str =
    "[elastic-force.divergence]\nimplicit = true\n[implicit-viscosity.backward-euler]";
/// Elastic forces in steps of their own, for [`soil_with`].
pub const SUB_STEPS: &str = "[elastic-force.divergence]\nsub_steps = true";
/// [`SOIL`] with another elastic force, a hundred times as stiff.
pub fn soil_with(elastic_force: &str) -> String {
    let force = "[elastic-force.displacement]\nblend = \"forces\"";
    let remembered = ", \"elastic_displacement\", \"stress_rotation\"";
    assert!(SOIL.contains(force) && SOIL.contains(remembered));
    let soft = SOIL.replace(force, elastic_force).replace(remembered, "");
    let stiff = soft.replace("0.8 MPa", "80 MPa");
    // Its first moments are all that is run: a solve bears much of the weight there.
    let allowed = stiff.replace("[numerics]\n", "[numerics]\ndelayed_yield = true\n");
    assert_ne!(allowed, stiff);
    allowed
}
/// Sand and water behind a gate, a sluice that swings and an outlet; every kind of output.
pub const SOAK: &str = include_str!("scenes/soak.toml");
/// A tank in three dimensions with a block that slides and a blade that turns.
pub const STIRRER: &str = include_str!("scenes/stirrer-3d.toml");
/// A fluid without walls, periodic in both directions.
pub const PERIODIC: &str = include_str!("scenes/periodic.toml");

//! What the whole-system tests share: a folder of their own, scenes, and the real binary.

mod bench;
mod disk;
#[cfg(doctest)]
mod readmes;
mod results;
mod state;

pub use bench::{Bench, Outcome};
pub use disk::Disk;
pub use results::Results;
pub use state::{FinalState, files_with_extension};

/// A dam break in a box: 180 particles, some hundred steps, a fraction of a second.
pub const DAM_BREAK: &str = include_str!("scenes/dam-break.toml");
/// The same with a paddle that moves into the fluid.
pub const PADDLE: &str = include_str!("scenes/paddle.toml");
/// A soil that remembers displacements and blends forces.
pub const SOIL: &str = include_str!("scenes/soil.toml");
/// [`SOIL`] with stresses of the end of the step.
pub fn soil_of_the_end_of_the_step() -> String {
    let force = "[elastic-force.displacement]\nblend = \"forces\"";
    let ahead = "[elastic-force.divergence]\nimplicit = true\n[implicit-viscosity.backward-euler]";
    let remembered = ", \"elastic_displacement\", \"elastic_turn\"";
    assert!(SOIL.contains(force) && SOIL.contains(remembered));
    SOIL.replace(force, ahead).replace(remembered, "")
}
/// Sand and water behind a gate, a sluice that swings and an outlet; every kind of output.
pub const SOAK: &str = include_str!("scenes/soak.toml");
/// A tank in three dimensions with a block that slides and a blade that turns.
pub const STIRRER: &str = include_str!("scenes/stirrer-3d.toml");
/// A fluid without walls, periodic in both directions.
pub const PERIODIC: &str = include_str!("scenes/periodic.toml");

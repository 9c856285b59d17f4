//! What people have in their hands: stepping by hand, comparison of runs, fields on request, animations, pages, and the
//! commands around them.

mod animation;
mod colours;
mod commands;
mod compare;
mod derived;
mod draw;
mod kinematic;
mod measure;
mod mistakes;
mod ranks;
mod stepper;
mod view;

use sph_tests::Bench;

/// An empty folder for the program.
fn bench() -> Bench {
    Bench::new(env!("CARGO_BIN_EXE_sph-under-test"))
}

/// A folder with a scene for the program.
fn with(scene: &str) -> Bench {
    Bench::with(env!("CARGO_BIN_EXE_sph-under-test"), scene)
}

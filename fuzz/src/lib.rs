//! What the targets share: a scene is checked as `sph check` does it, if it is small.

use sph_scene::{Loaded, Override};

/// Most particles and wall points of a scene that is assembled.
const MOST: f64 = 2_000.0;

/// Most steps of its relaxation: they are all alike, and in space they take long.
const RELAXED: u32 = 3;

/// A file beside the shipped scenes, so that the data that these name are found.
pub const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/fuzzed.toml");

/// Reads a scene and, if it is small, assembles it.
///
/// # Panics
/// If a refusal points nowhere; whatever else panics is what is looked for.
pub fn check(text: &str, overrides: &[Override]) {
    match sph_scene::parse(text, FILE, overrides) {
        Ok(loaded) => assemble(&loaded),
        Err(refused) => {
            assert!(!refused.diagnostics.is_empty(), "refused without a word");
            for d in &refused.diagnostics {
                let shown = refused.source.text_of(d);
                assert!(shown.get(d.span.clone()).is_some(), "no place: {d}");
            }
        }
    }
}

/// Assembles a scene unless it is large.
pub fn assemble(loaded: &Loaded) {
    let mut scene = loaded.scene.clone();
    if let Some(relax) = &mut scene.numerics.relax {
        relax.steps = relax.steps.min(RELAXED);
    }
    // A particle in space has five times the neighbours of one in the plane.
    let most = MOST / if scene.dimension == 3 { 2.0 } else { 1.0 };
    match sph_particles::setup::size(&scene) {
        Ok(size) if size.particles + size.wall_points <= most => {
            let _ = sph_particles::setup::examine(&scene);
        }
        _ => {}
    }
}

//! Scenes with files beside them.

use std::path::Path;

use sph_core::SceneProblem;
use sph_scene::{Facets, Line, Scene, load};
use tempfile::{TempDir, tempdir};

/// Spacing of these scenes, m.
pub const SPACING: f64 = 0.1;

/// A scene of one wall, `wall.w`, read from a folder.
pub fn scene(folder: &Path, dimension: usize, wall: &str) -> Scene {
    let corner = &"1, 1, 1"[..3 * dimension - 2];
    let text = format!(
        "title = \"t\"\ndimension = {dimension}\nrun.end = 1\nnumerics.spacing = {SPACING}\n\
         phase.water = {{ density = 1, rheology.newtonian = {{}} }}\n\
         body.b = {{ phase = \"water\", box = [[{}], [{corner}]] }}\n[wall.w]\n{wall}\n",
        corner.replace('1', "0")
    );
    let file = folder.join("scene.toml");
    std::fs::write(&file, text).unwrap();
    load(&file, &[]).unwrap_or_else(|e| panic!("{e}")).scene
}

/// All these words, which ` | ` separates, stand in a text: those after `^` at its beginning.
#[track_caller]
pub fn says(text: &str, words: &str) {
    let holds = |word: &str| match word.strip_prefix('^') {
        Some(start) => text.starts_with(start),
        None => text.contains(word),
    };
    let lacks = words.split(" | ").find(|w| !holds(w));
    assert!(lacks.is_none(), "`{}` is not in: {text}", lacks.unwrap());
}

/// A number to a distance.
#[track_caller]
pub fn close(found: f64, expected: f64, distance: f64) {
    assert!((found - expected).abs() < distance, "{found} {expected}");
}

/// A folder with one file.
pub fn with(name: &str, content: impl AsRef<[u8]>) -> TempDir {
    let folder = tempdir().unwrap();
    std::fs::write(folder.path().join(name), content).unwrap();
    folder
}

/// The lines of that wall.
pub fn lines(folder: &Path, wall: &str) -> Result<Vec<Line>, SceneProblem> {
    scene(folder, 2, wall).wall["w"].lines("wall.w", SPACING)
}

/// The facets of that wall.
pub fn facets(folder: &Path, wall: &str) -> Result<Facets, SceneProblem> {
    scene(folder, 3, wall).wall["w"].facets("wall.w", SPACING)
}

//! Waves that bodies carry at the start.

use scene_text::Problems;

use crate::geometry::periodic_place::ROUNDING;
use crate::{Body, Pressure, Region, Scene, Wave};

/// Highest solitary wave there is, over the depth (Longuet-Higgins & Fenton 1974).
const HIGHEST: f64 = 0.83;

/// The other keys of the body fit its wave.
pub(crate) fn keys(scene: &Scene, body: &Body, path: &str, found: &mut Problems) {
    let Some(wave) = &body.wave else { return };
    let path = format!("{path}.wave");
    let gravity = scene.numerics.gravity.as_deref().unwrap_or(&[]);
    let down = gravity
        .split_last()
        .is_some_and(|(down, level)| *down < 0.0 && level.iter().all(|g| *g == 0.0));
    if !down {
        let message = "a wave needs a `numerics.gravity` down along the last axis";
        found.add(&path, message);
    }
    let (depth, height, most) = (wave.depth, wave.height, HIGHEST * wave.depth);
    if height > most {
        let message = format!(
            "a solitary wave on water {depth} m deep is at most {most} m high, found {height} m"
        );
        found.add(format!("{path}.height"), message);
    }
    if body.pressure == Pressure::Zero && down {
        found.add(&path, "a wave needs `pressure = \"hydrostatic\"`");
    }
    let others = [
        ("velocity", body.velocity.is_some(), "velocity"),
        ("initial", !body.initial.is_empty(), "velocity"),
        ("below", body.below.is_some(), "surface"),
        ("surface", body.surface.is_some(), "surface"),
    ];
    for (key, _, what) in others.iter().filter(|(_, given, _)| *given) {
        let message =
            format!("the {what} at the start is given by `{key}` and by a wave: choose one");
        found.add(&path, message);
    }
}

/// The wave is within the shape of its body.
pub(crate) fn place<const D: usize>(
    wave: &Wave,
    region: &Region<D>,
    spacing: f64,
    path: &str,
    found: &mut Problems,
) {
    let near = ROUNDING * spacing;
    let (lo, hi) = region.base.bounds();
    let (from, to, crest) = (lo[0], hi[0], wave.crest);
    let path = format!("{path}.wave");
    if crest < from || crest > to {
        let message = format!("the crest is at {crest} m, out of the body from {from} m to {to} m");
        found.add(format!("{path}.crest"), message);
    }
    let (low, high) = (lo[D - 1], hi[D - 1]);
    let (bed, still, top) = (wave.bottom, wave.still(), wave.still() + wave.height);
    if top > high + near {
        let message = format!(
            "the crest is {top} m high, and the body ends at {high} m: it would be cut off"
        );
        found.add(&path, message);
    }
    // Waves are drawn half a spacing up where rows stand at whole spacings.
    if low < bed - spacing {
        let message =
            format!("the body reaches down to {low} m, below the bed of the wave at {bed} m");
        found.add(&path, message);
    }
    if low >= still {
        let message = format!("the body starts at {low} m, above the still water at {still} m");
        found.add(&path, message);
    }
}

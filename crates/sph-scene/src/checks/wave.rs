//! Waves that bodies carry at the start.

use crate::checks::table_check::TableCheck;
use crate::geometry::periodic_place::ROUNDING;
use crate::{Body, Pressure, Region, Scene, Wave};

/// Highest solitary wave there is, over the depth (Longuet-Higgins & Fenton 1974).
const HIGHEST: f64 = 0.83;

/// The other keys of the body fit its wave.
pub(crate) fn keys(scene: &Scene, body: &Body, mut check: TableCheck<'_>) {
    let Some(wave) = &body.wave else { return };
    let gravity = scene.numerics.gravity.as_deref().unwrap_or(&[]);
    let down = gravity
        .split_last()
        .is_some_and(|(down, level)| *down < 0.0 && level.iter().all(|g| *g == 0.0));
    let message = "a wave needs a `numerics.gravity` down along the last axis";
    check.refuse(!down, "", message);
    let (depth, height, most) = (wave.depth, wave.height, HIGHEST * wave.depth);
    let message = format!(
        "a solitary wave on water {depth} m deep is at most {most} m high, found {height} m"
    );
    check.refuse(height > most, "height", message);
    let weightless = body.pressure == Pressure::Zero && down;
    check.refuse(weightless, "", "a wave needs `pressure = \"hydrostatic\"`");
    for (key, given, what) in [
        ("velocity", body.velocity.is_some(), "velocity"),
        ("initial", !body.initial.is_empty(), "velocity"),
        ("below", body.below.is_some(), "surface"),
        ("surface", body.surface.is_some(), "surface"),
    ] {
        let message =
            format!("the {what} at the start is given by `{key}` and by a wave: choose one");
        check.refuse(given, "", message);
    }
}

/// The wave is within the shape of its body.
pub(crate) fn place<const D: usize>(
    wave: &Wave,
    region: &Region<D>,
    spacing: f64,
    mut check: TableCheck<'_>,
) {
    let (lo, hi) = region.base.bounds();
    let (from, to, crest) = (lo[0], hi[0], wave.crest);
    let message = format!("the crest is at {crest} m, out of the body from {from} m to {to} m");
    check.refuse(crest < from || crest > to, "crest", message);
    let (low, high) = (lo[D - 1], hi[D - 1]);
    let (bed, still, top) = (wave.bottom, wave.still(), wave.still() + wave.height);
    let message =
        format!("the crest is {top} m high, and the body ends at {high} m: it would be cut off");
    check.refuse(top > high + ROUNDING * spacing, "", message);
    // Waves are drawn half a spacing up where rows stand at whole spacings.
    let message = format!("the body reaches down to {low} m, below the bed of the wave at {bed} m");
    check.refuse(low < bed - spacing, "", message);
    let message = format!("the body starts at {low} m, above the still water at {still} m");
    check.refuse(low >= still, "", message);
}

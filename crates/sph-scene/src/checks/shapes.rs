//! Bodies: their shapes, and how they are filled.

use scene_text::Problems;

use crate::checks::dimension::{Dimension, polygon};
use crate::checks::wave;
use crate::tables::body::BodyShape;
use crate::{Body, Pressure, Scene};

/// Checks the keys of a body in space.
pub(crate) fn body_geometry(
    scene: &Scene,
    body: &Body,
    of: Dimension,
    path: &str,
    found: &mut Problems,
) {
    match body.fill {
        Some(_) => filling(body, of, path, found),
        None => {
            shape(&body.shape, of, path, found);
            if body.seed.is_some() {
                let message = "a seed belongs to `fill = \"walls\"`";
                found.add(format!("{path}.seed"), message);
            }
        }
    }
    let key = if body.fill.is_some() { "fill" } else { "clip" };
    if body.needs_walls() && scene.wall.is_empty() {
        let message = "the scene has no walls: a wall is a table [wall.NAME]";
        found.add(format!("{path}.{key}"), message);
    }
    for (key, surface) in [("above", &body.above), ("below", &body.below)] {
        if surface.is_some_and(|s| s.wavelength.is_none() && s.amplitude != 0.0) {
            let message = "the key `wavelength` is missing: a wave has a length";
            found.add(format!("{path}.{key}"), message);
        }
    }
    for (k, cut) in body.subtract.iter().enumerate() {
        shape(cut, of, &format!("{path}.subtract[{k}]"), found);
    }
    of.optional(&body.velocity, &format!("{path}.velocity"), found);
    if body.velocity.is_some() && !body.initial.is_empty() {
        let message =
            "the velocity at the start is given here and by an `initial` plugin: choose one";
        found.add(format!("{path}.velocity"), message);
    }
    wave::keys(scene, body, path, found);
    let weightless = scene.numerics.gravity.iter().flatten().all(|g| *g == 0.0);
    if body.pressure == Pressure::Hydrostatic && weightless {
        let message = "a hydrostatic pressure needs `numerics.gravity`";
        found.add(format!("{path}.pressure"), message);
    } else if body.pressure == Pressure::Zero && body.surface.is_some() {
        let message = "the level of the surface is used for `pressure = \"hydrostatic\"` only";
        found.add(format!("{path}.surface"), message);
    }
}

/// A body that fills the walls has no shape but a box that bounds it.
fn filling(body: &Body, of: Dimension, path: &str, found: &mut Problems) {
    for key in body.shape.given().into_iter().filter(|key| *key != "box") {
        let message = "what `fill = \"walls\"` fills can be bounded by a `box` only";
        found.add(format!("{path}.{key}"), message);
    }
    if let Some(corners) = &body.shape.bounds {
        of.corners(corners, &format!("{path}.box"), found);
    }
    let Some(seed) = &body.seed else { return };
    let place = format!("{path}.seed");
    let within = |[lo, hi]: &[Vec<f64>; 2], k: usize| {
        let ends = lo.get(k).zip(hi.get(k));
        ends.is_some_and(|(l, h)| (l..=h).contains(&&seed[k]))
    };
    if of.vector(seed, &place, found)
        && let Some(bounds) = &body.shape.bounds
        && (0..of.0).any(|k| !within(bounds, k))
    {
        found.add(place, "the seed lies outside the `box`");
    }
}

/// Checks that one shape is given, and its keys.
pub(crate) fn shape(keys: &BodyShape, of: Dimension, path: &str, found: &mut Problems) {
    let all = match of.0 {
        2 => "`box`, `polygon`, `disc` or `ellipse`",
        _ => "`box`, `sphere`, `cylinder`, `cone` or `extrusion`",
    };
    if found.one_of(&keys.given(), path, "shape", [all, ""]) {
        keys_of_shape(keys, of, path, found);
    }
}

/// Checks the keys of a shape.
pub(crate) fn keys_of_shape(keys: &BodyShape, of: Dimension, path: &str, found: &mut Problems) {
    let at = |key: &str| format!("{path}.{key}");
    if let Some(corners) = &keys.bounds {
        of.corners(corners, &at("box"), found);
    }
    for (round, key, what, dimension) in [
        (&keys.disc, "disc", "a disc", 2),
        (&keys.sphere, "sphere", "a sphere", 3),
    ] {
        let Some(round) = round else { continue };
        if of.is(dimension, what, &at(key), found) {
            of.vector(&round.centre, &at(&format!("{key}.centre")), found);
        }
    }
    if let Some(ellipse) = &keys.ellipse
        && of.is(2, "an ellipse", &at("ellipse"), found)
    {
        of.vector(&ellipse.centre, &at("ellipse.centre"), found);
        if ellipse.semi_axes.contains(&0.0) {
            let message = "the semi-axes must be more than 0 m";
            found.add(at("ellipse.semi_axes"), message);
        }
    }
    if let Some(points) = &keys.polygon
        && of.is(2, "a polygon", &at("polygon"), found)
    {
        polygon(points, &at("polygon"), found);
    }
    if let Some(c) = &keys.cylinder
        && of.is(3, "a cylinder", &at("cylinder"), found)
    {
        of.apart(("from", &c.from), ("to", &c.to), &at("cylinder"), found);
    }
    if let Some(c) = &keys.cone
        && of.is(3, "a cone", &at("cone"), found)
    {
        of.apart(("base", &c.base), ("apex", &c.apex), &at("cone"), found);
    }
    if let Some(e) = &keys.extrusion
        && of.is(3, "an extrusion", &at("extrusion"), found)
    {
        polygon(&e.polygon, &at("extrusion.polygon"), found);
        if e.from == e.to {
            let message = format!("`from` and `to` must differ, found {} twice", e.from);
            found.add(at("extrusion.to"), message);
        }
    }
}

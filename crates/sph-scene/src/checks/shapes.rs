//! Bodies: their shapes, and how they are filled.

use crate::checks::bodies::keys_of_wave;
use crate::checks::table_check::TableCheck;
use crate::tables::body::BodyShape;
use crate::{Body, Pressure, Scene};

pub(crate) fn body_geometry(scene: &Scene, body: &Body, mut check: TableCheck<'_>) {
    let filling = body.fill.is_some();
    if filling {
        check_filling(body, &mut check);
    } else {
        shape(&body.shape, &mut check);
        let message = "a seed belongs to `fill = \"walls\"`";
        check.refuse(body.seed.is_some(), "seed", message);
    }
    let key = if filling { "fill" } else { "clip" };
    let unbounded = body.needs_walls() && scene.wall.is_empty();
    let message = "the scene has no walls: a wall is a table [wall.NAME]";
    check.refuse(unbounded, key, message);
    for (key, surface) in [("above", &body.above), ("below", &body.below)] {
        let endless = surface.is_some_and(|s| s.wavelength.is_none() && s.amplitude != 0.0);
        let message = "the key `wavelength` is missing: a wave has a length";
        check.refuse(endless, key, message);
    }
    for (k, cut) in body.subtract.iter().enumerate() {
        shape(cut, &mut check.below(&format!("subtract[{k}]")));
    }
    check.vector("velocity", &body.velocity);
    let twice = body.velocity.is_some() && !body.initial.is_empty();
    let message = "the velocity at the start is given here and by an `initial` plugin: choose one";
    check.refuse(twice, "velocity", message);
    keys_of_wave(scene, body, check.below("wave"));
    let weightless = scene.numerics.gravity.iter().flatten().all(|g| *g == 0.0);
    let hydrostatic = body.pressure == Pressure::Hydrostatic;
    let message = "a hydrostatic pressure needs `numerics.gravity`";
    check.refuse(hydrostatic && weightless, "pressure", message);
    let message = "the level of the surface is used for `pressure = \"hydrostatic\"` only";
    check.refuse(!hydrostatic && body.surface.is_some(), "surface", message);
}

/// A body that fills the walls has no shape but a box that bounds it.
fn check_filling(body: &Body, check: &mut TableCheck<'_>) {
    for key in body.shape.given().into_iter().filter(|key| *key != "box") {
        let message = "what `fill = \"walls\"` fills can be bounded by a `box` only";
        check.add(key, message);
    }
    if let Some(corners) = &body.shape.bounds {
        check.corners("box", corners);
    }
    if check.vector("seed", &body.seed)
        && let (Some(seed), Some([lo, hi])) = (&body.seed, &body.shape.bounds)
    {
        let mut ends = lo.iter().zip(hi).zip(seed);
        let outside = lo.len().min(hi.len()) < seed.len()
            || ends.any(|((lo, hi), x)| !(lo..=hi).contains(&x));
        check.refuse(outside, "seed", "the seed lies outside the `box`");
    }
}

/// Checks that one shape is given, and its keys.
pub(crate) fn shape(keys: &BodyShape, check: &mut TableCheck<'_>) {
    let all = match check.dimension {
        2 => "`box`, `polygon`, `disc` or `ellipse`",
        _ => "`box`, `sphere`, `cylinder`, `cone` or `extrusion`",
    };
    if (check.found).one_of(&keys.given(), &check.path, "shape", [all, ""]) {
        keys_of_shape(keys, check);
    }
}

pub(crate) fn keys_of_shape(keys: &BodyShape, check: &mut TableCheck<'_>) {
    if let Some(corners) = &keys.bounds {
        check.corners("box", corners);
    }
    for (round, key, what, dimension) in [
        (&keys.disc, "disc", "a disc", 2),
        (&keys.sphere, "sphere", "a sphere", 3),
    ] {
        if let Some(round) = round
            && let Some(mut check) = check.shape(key, what, dimension)
        {
            check.vector("centre", &round.centre);
        }
    }
    if let Some(ellipse) = &keys.ellipse
        && let Some(mut check) = check.shape("ellipse", "an ellipse", 2)
    {
        check.vector("centre", &ellipse.centre);
        let flat = ellipse.semi_axes.contains(&0.0);
        check.refuse(flat, "semi_axes", "the semi-axes must be more than 0 m");
    }
    if let Some(points) = &keys.polygon
        && let Some(mut check) = check.shape("polygon", "a polygon", 2)
    {
        check.polygon("", points);
    }
    if let Some(c) = &keys.cylinder
        && let Some(mut check) = check.shape("cylinder", "a cylinder", 3)
    {
        check.apart(("from", &c.from), ("to", &c.to));
    }
    if let Some(c) = &keys.cone
        && let Some(mut check) = check.shape("cone", "a cone", 3)
    {
        check.apart(("base", &c.base), ("apex", &c.apex));
    }
    if let Some(e) = &keys.extrusion
        && let Some(mut check) = check.shape("extrusion", "an extrusion", 3)
    {
        check.polygon("polygon", &e.polygon);
        let message = format!("`from` and `to` must differ, found {} twice", e.from);
        check.refuse(e.from == e.to, "to", message);
    }
}

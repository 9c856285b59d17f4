//! Checks of outlets, and of zones: their shapes, ratios, and how they are nested.

use crate::checks::shapes::shape;
use crate::checks::table_check::TableCheck;
use crate::{Outlet, Scene, Shape, Zone};

/// Finest ratio of a zone.
const FINEST: f64 = 0.125;

pub(crate) fn check_zones(scene: &Scene, mut check: TableCheck<'_>) {
    let before = check.found.0.len();
    for (name, zone) in &scene.zone {
        let mut check = check.below(name);
        if zone.near.is_none() {
            shape(&zone.shape, &mut check);
        }
        let both = zone.near.is_some() && !zone.shape.given().is_empty();
        let message = "a zone is `near` a wall or has a shape of its own, not both";
        check.refuse(both, "near", message);
        let ratio = zone.ratio;
        let message = format!(
            "the ratio is 0.5, 0.25 or 0.125, found {ratio}: each zone halves the spacing around it"
        );
        let power = ratio >= FINEST && (1.0 / ratio).log2().fract() == 0.0;
        check.refuse(!power, "ratio", message);
    }
    if check.found.0.len() > before {
        return;
    }
    for (name, zone) in &scene.zone {
        match scene.dimension {
            2 => nested::<2>(scene, name, zone, &mut check),
            _ => nested::<3>(scene, name, zone, &mut check),
        }
    }
}

/// A zone that is finer than a half lies in one of twice its spacing, and moves with it.
fn nested<const D: usize>(scene: &Scene, name: &str, zone: &Zone, check: &mut TableCheck<'_>) {
    let (ratio, wanted) = (zone.ratio, 2.0 * zone.ratio);
    let around = scene.around_zone(zone);
    let message = format!(
        "a ratio of {ratio} lies in a zone with the ratio {wanted}, whose shape encloses this one: add such a zone"
    );
    let alone = ratio < 0.5 && around.is_none();
    check.refuse(alone, &format!("{name}.ratio"), message);
    if let Some(around) =
        around.filter(|around| scene.zone[*around].carrier(scene) != zone.carrier(scene))
    {
        let message = format!(
            "the zone `{around}` around it does not move alike: give both the same `follows`"
        );
        check.add(&format!("{name}.follows"), message);
    }
    let own = zone.shape_in::<D>(scene);
    for (other, second) in &scene.zone {
        let meets = |(a, b): (&Shape<D>, Shape<D>)| a.is_near(&b, 0.0);
        let both = own.as_ref().zip(second.shape_in(scene)).is_some_and(meets);
        let alike = name < other.as_str() && second.ratio == ratio;
        let message = format!("it overlaps the zone `{name}` of the same ratio: make them one");
        check.refuse(alike && both, other, message);
    }
}

pub(crate) fn outlet(outlet: &Outlet, mut check: TableCheck<'_>) {
    let one = [outlet.bounds.is_some(), outlet.beyond.is_some()];
    let neither = "the key `box` or `beyond` is missing: where particles leave";
    let both = "an outlet is a box or what is beyond a plane, not both";
    (check.found).either(one, &check.path, neither, ("beyond", both));
    if let (Some(corners), None) = (&outlet.bounds, outlet.beyond) {
        check.corners("box", corners);
    }
    let (axis, direction) = (outlet.axis.is_some(), outlet.direction.is_some());
    for (key, given) in [("axis", axis), ("direction", direction)] {
        let misplaced = given && outlet.bounds.is_some();
        check.refuse(misplaced, key, "it belongs to `beyond`");
    }
    let dimension = check.dimension;
    let beyond = outlet.axis.is_some_and(|axis| axis as usize >= dimension);
    let message = format!("there is no such axis in {dimension}D");
    check.refuse(beyond, "axis", message);
}

//! Checks of outlets, and of zones: their shapes, ratios, and how they are nested.

use scene_text::{Problems, given};

use crate::checks::dimension::Dimension;
use crate::checks::shapes::shape;
use crate::{Scene, Zone};

/// Finest ratio of a zone.
const FINEST: f64 = 0.125;

/// Checks every zone, and any two.
pub(crate) fn check_zones(scene: &Scene, of: Dimension, found: &mut Problems) {
    let before = found.0.len();
    for (name, zone) in &scene.zone {
        let path = format!("zone.{name}");
        shape(&zone.shape, of, &path, found);
        let ratio = zone.ratio;
        if !is_power(ratio) {
            let message = format!(
                "the ratio is 0.5, 0.25 or 0.125, found {ratio}: each zone halves the spacing around it"
            );
            found.add(format!("{path}.ratio"), message);
        }
    }
    if found.0.len() > before {
        return;
    }
    for (name, zone) in &scene.zone {
        match of.0 {
            2 => nested::<2>(scene, name, zone, found),
            _ => nested::<3>(scene, name, zone, found),
        }
    }
}

fn is_power(ratio: f64) -> bool {
    ratio >= FINEST && (1.0 / ratio).log2().fract() == 0.0
}

/// A zone that is finer than a half lies in one of twice its spacing, and moves with it.
fn nested<const D: usize>(scene: &Scene, name: &str, zone: &Zone, found: &mut Problems) {
    let path = format!("zone.{name}");
    let around = scene.around_zone(zone);
    if zone.ratio < 0.5 && around.is_none() {
        let wanted = 2.0 * zone.ratio;
        let message = format!(
            "a ratio of {} lies in a zone with the ratio {wanted}, whose shape encloses this one: add such a zone",
            zone.ratio
        );
        found.add(format!("{path}.ratio"), message);
    }
    if let Some(around) = around.filter(|around| scene.zone[*around].follows != zone.follows) {
        let message = format!("it follows the same wall as the zone `{around}` around it");
        found.add(format!("{path}.follows"), message);
    }
    let own = zone.shape.shape::<D>();
    let overlaps = |second: &Zone| {
        let other = second.shape.shape::<D>();
        own.as_ref()
            .zip(other.as_ref())
            .is_some_and(|(a, b)| a.is_near(b, 0.0))
    };
    for (other, second) in &scene.zone {
        if name < other.as_str() && second.ratio == zone.ratio && overlaps(second) {
            let message = format!("it overlaps the zone `{name}` of the same ratio: make them one");
            found.add(format!("zone.{other}"), message);
        }
    }
}

/// Checks the geometry of all outlets.
pub(crate) fn outlets(scene: &Scene, of: Dimension, found: &mut Problems) {
    for (name, outlet) in &scene.outlet {
        let path = format!("outlet.{name}");
        let one = [outlet.bounds.is_some(), outlet.beyond.is_some()];
        let neither = "the key `box` or `beyond` is missing: where particles leave";
        let both = "an outlet is a box or what is beyond a plane, not both";
        found.either(one, &path, neither, ("beyond", both));
        if let (Some(corners), None) = (&outlet.bounds, outlet.beyond) {
            of.corners(corners, &format!("{path}.box"), found);
        }
        if outlet.bounds.is_some() {
            for key in given([
                ("axis", outlet.axis.is_some()),
                ("direction", outlet.direction.is_some()),
            ]) {
                found.add(format!("{path}.{key}"), "it belongs to `beyond`");
            }
        }
        if outlet.axis.is_some_and(|axis| axis as usize >= of.0) {
            let message = format!("there is no such axis in {}D", of.0);
            found.add(format!("{path}.axis"), message);
        }
    }
}

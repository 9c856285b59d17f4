//! Checks of zones: their boxes, ratios, and how they are nested.

use scene_text::Problems;

use crate::checks::dimension::Dimension;
use crate::{Scene, Zone};

/// Finest ratio of a zone.
const FINEST: f64 = 0.125;

/// Checks every zone, and any two.
pub(crate) fn check(scene: &Scene, of: Dimension, found: &mut Problems) {
    let before = found.0.len();
    for (name, zone) in &scene.zone {
        let path = format!("zone.{name}");
        of.corners(&zone.bounds, &format!("{path}.box"), found);
        if !is_power(zone.ratio) {
            let message = format!(
                "the ratio is 0.5, 0.25 or 0.125, found {}: each zone halves the spacing around it",
                zone.ratio
            );
            found.add(format!("{path}.ratio"), message);
        }
    }
    if found.0.len() > before {
        return;
    }
    for (name, zone) in &scene.zone {
        nested(scene, name, zone, found);
    }
}

fn is_power(ratio: f64) -> bool {
    ratio >= FINEST && (1.0 / ratio).log2().fract() == 0.0
}

/// A zone that is finer than a half lies in one of twice its spacing.
fn nested(scene: &Scene, name: &str, zone: &Zone, found: &mut Problems) {
    let path = format!("zone.{name}");
    if zone.ratio < 0.5 && scene.around_zone(zone).is_none() {
        let wanted = 2.0 * zone.ratio;
        let message = format!(
            "a ratio of {} lies in a zone with the ratio {wanted}, whose box encloses this one: add such a zone",
            zone.ratio
        );
        found.add(format!("{path}.ratio"), message);
    }
    for (other, second) in &scene.zone {
        if name < other.as_str() && second.ratio == zone.ratio && overlap(zone, second) {
            let message = format!("it overlaps the zone `{name}` of the same ratio: make them one");
            found.add(format!("zone.{other}.box"), message);
        }
    }
}

fn overlap(a: &Zone, b: &Zone) -> bool {
    let [a, b] = [&a.bounds, &b.bounds];
    (0..a[0].len()).all(|k| a[0][k] < b[1][k] && b[0][k] < a[1][k])
}

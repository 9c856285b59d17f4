//! Checks of outlets.

use scene_text::{Problems, given};

use crate::Scene;
use crate::checks::dimension::Dimension;

/// Checks the geometry of all outlets.
pub(crate) fn outlets(scene: &Scene, of: Dimension, found: &mut Problems) {
    for (name, outlet) in &scene.outlet {
        let path = format!("outlet.{name}");
        match (&outlet.bounds, outlet.beyond) {
            (None, None) => found.add(
                &path,
                "the key `box` or `beyond` is missing: where particles leave",
            ),
            (Some(_), Some(_)) => found.add(
                format!("{path}.beyond"),
                "an outlet is a box or what is beyond a plane, not both",
            ),
            (Some(corners), None) => of.corners(corners, &format!("{path}.box"), found),
            (None, Some(_)) => {}
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
            found.add(
                format!("{path}.axis"),
                format!("there is no such axis in {}D", of.0),
            );
        }
    }
}

//! Walls that grains make, and those that stand in them.

use std::collections::BTreeMap;

use scene_text::Problems;
use sph_core::suggestion;

use crate::Wall;
use crate::checks::dimension::Dimension;

/// Checks the beds among the walls of a scene.
pub(crate) fn check(walls: &BTreeMap<String, Wall>, of: Dimension, found: &mut Problems) {
    for (name, wall) in walls {
        let path = format!("wall.{name}");
        if wall.erodible.is_some() || wall.stands_in.is_some() {
            let key = match wall.erodible {
                Some(_) => "erodible",
                None => "stands_in",
            };
            let stays = wall.motion.is_none()
                && wall.mover.is_empty()
                && wall.velocity.is_none()
                && wall.open_boundary.is_empty()
                && wall.thickness.is_none();
            if !stays {
                let message = "a bed of grains, and walls that stand in it, have no `motion`, `mover`, `velocity`, \
                               `open-boundary` or `thickness`";
                found.add(format!("{path}.{key}"), message);
            }
        }
        if let Some(erodible) = &wall.erodible {
            for (key, list) in [("from", &erodible.from), ("to", &erodible.to)] {
                if let Some(list) = list.as_ref().filter(|list| list.len() != of.0 - 1) {
                    let (wanted, given) = (of.0 - 1, list.len());
                    let message =
                        format!("expected {wanted} number(s) in {}D, found {given}", of.0);
                    found.add(format!("{path}.erodible.{key}"), message);
                }
            }
            if let (Some(from), Some(to)) = (&erodible.from, &erodible.to)
                && from.iter().zip(to).any(|(a, b)| a >= b)
            {
                let message = "the bed must end behind its beginning `from`";
                found.add(format!("{path}.erodible.to"), message);
            }
        }
        if let Some(bed) = &wall.stands_in {
            let path = format!("{path}.stands_in");
            let beds = || walls.iter().filter(|(_, w)| w.erodible.is_some());
            if wall.erodible.is_some() {
                found.add(path, "a wall that is a bed itself stands in no other one");
            } else if !beds().any(|(name, _)| name == bed) {
                let near = suggestion(bed, beds().map(|(name, _)| name.as_str()));
                found.add(path, format!("no wall `{bed}` is `erodible`{near}"));
            }
        }
    }
}

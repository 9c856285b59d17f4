//! Vectors, shapes, walls and periodic boxes.

use scene_text::Problems;

use crate::Scene;
use crate::checks::beds;
use crate::checks::bounds::within_bounds;
use crate::checks::dimension::Dimension;
use crate::checks::gravity;
use crate::checks::outlets::outlets;
use crate::checks::shapes::body_geometry;
use crate::checks::walls::wall_geometry;
use crate::checks::zones;

/// Checks everything that has a place in space.
pub(crate) fn check(scene: &Scene, found: &mut Problems) {
    let before = found.0.len();
    let of = Dimension(scene.dimension);
    space(scene, of, found);
    for (name, wall) in &scene.wall {
        wall_geometry(wall, of, &format!("wall.{name}"), found);
    }
    for (name, body) in &scene.body {
        body_geometry(scene, body, of, &format!("body.{name}"), found);
    }
    beds::check(&scene.wall, of, found);
    outlets(scene, of, found);
    zones::check(scene, of, found);
    if found.0.len() == before {
        match scene.dimension {
            2 => within_bounds::<2>(scene, found),
            _ => within_bounds::<3>(scene, found),
        }
    }
}

fn space(scene: &Scene, of: Dimension, found: &mut Problems) {
    let numerics = &scene.numerics;
    of.optional(&numerics.gravity, "numerics.gravity", found);
    if let Some(course) = &numerics.gravity_over_time {
        gravity::over_time(course, of, found);
    }
    if let Some(motion) = &numerics.frame {
        gravity::frame(motion, of, found);
    }
    of.optional(&numerics.driving, "numerics.driving", found);
    if let Some(domain) = &numerics.domain {
        of.corners(domain, "numerics.domain", found);
    }
    for (k, (axis, bounds)) in numerics.periodic.axes().into_iter().enumerate() {
        let Some([lo, hi]) = bounds else { continue };
        let path = format!("numerics.periodic.{axis}");
        if k >= of.0 {
            found.add(path, format!("there is no {axis} in {}D", of.0));
        } else if lo >= hi {
            found.add(
                path,
                format!("the lower bound must be below the upper, found {lo} and {hi}"),
            );
        } else if numerics
            .gravity
            .as_ref()
            .and_then(|g| g.get(k))
            .is_some_and(|g| *g != 0.0)
        {
            let message = format!(
                "gravity along the periodic direction {axis} has no hydrostatic balance: use `driving`"
            );
            found.add("numerics.gravity", message);
        }
    }
}

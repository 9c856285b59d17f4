//! Vectors, shapes, walls and periodic boxes.

use crate::body::ShapeKeys;
use crate::check::Problems;
use crate::check_bounds::within_bounds;
use crate::polygon::crossing;
use crate::vector::{array, point};
use crate::{Body, Pressure, Scene, Shape, Wall};

/// Chains longer than this are not searched for crossings.
const SEARCHED: usize = 20_000;

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
    if found.0.len() == before {
        match scene.dimension {
            2 => within_bounds::<2>(scene, found),
            _ => within_bounds::<3>(scene, found),
        }
    }
}

#[derive(Clone, Copy)]
struct Dimension(usize);

impl Dimension {
    /// Whether a vector has one entry per dimension; if not, that is a problem.
    fn vector(self, list: &[f64], path: &str, found: &mut Problems) -> bool {
        let right = list.len() == self.0;
        if !right {
            let message = format!(
                "expected {} numbers in {}D, found {}",
                self.0,
                self.0,
                list.len()
            );
            found.add(path, message);
        }
        right
    }

    fn optional(self, list: &Option<Vec<f64>>, path: &str, found: &mut Problems) {
        if let Some(list) = list {
            self.vector(list, path, found);
        }
    }

    fn corners(self, corners: &[Vec<f64>; 2], path: &str, found: &mut Problems) {
        let right = [0, 1].map(|k| self.vector(&corners[k], &format!("{path}[{k}]"), found));
        if right != [true; 2] {
            return;
        }
        for (k, axis) in ["x", "y", "z"].iter().enumerate().take(self.0) {
            let (lo, hi) = (corners[0][k], corners[1][k]);
            if lo >= hi {
                let message = format!(
                    "the lower corner must be below the upper along {axis}, found {lo} and {hi}"
                );
                found.add(path, message);
            }
        }
    }
}

fn space(scene: &Scene, of: Dimension, found: &mut Problems) {
    let numerics = &scene.numerics;
    of.optional(&numerics.gravity, "numerics.gravity", found);
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

fn wall_geometry(wall: &Wall, of: Dimension, path: &str, found: &mut Problems) {
    if of.0 != 2 {
        found.add(
            path,
            "a polyline is a wall of two dimensions, and this scene has three",
        );
        return;
    }
    of.optional(&wall.velocity, &format!("{path}.velocity"), found);
    if let Some(motion) = &wall.motion {
        of.optional(&motion.velocity, &format!("{path}.motion.velocity"), found);
        of.optional(&motion.centre, &format!("{path}.motion.centre"), found);
    }
    if wall.closed && wall.thickness.is_some() {
        found.add(
            format!("{path}.thickness"),
            "a closed wall has one face and no thickness",
        );
    }
    let line = format!("{path}.polyline");
    if wall.closed && wall.polyline.len() < 3 {
        found.add(&line, "a closed wall needs at least 3 corners");
        return;
    }
    if let Some(points) = chain(&wall.polyline, wall.closed, of, &line, found) {
        let count = if wall.closed {
            points.len()
        } else {
            points.len() - 1
        };
        let edges: Vec<_> = (0..count)
            .map(|k| (points[k], points[(k + 1) % points.len()]))
            .collect();
        crossed(&edges, wall.closed, &line, found);
    }
}

/// The corners, if each has two coordinates and differs from the one before.
fn chain(
    points: &[Vec<f64>],
    closed: bool,
    of: Dimension,
    path: &str,
    found: &mut Problems,
) -> Option<Vec<[f64; 2]>> {
    let before = found.0.len();
    for (k, p) in points.iter().enumerate() {
        let place = format!("{path}[{k}]");
        if !of.vector(p, &place, found) {
            break;
        }
        let previous = match k {
            0 if closed => points.last(),
            0 => None,
            k => points.get(k - 1),
        };
        if previous == Some(p) {
            let message = format!("the corner {} stands there twice in a row", point(p));
            found.add(place, message);
            break;
        }
    }
    (found.0.len() == before).then(|| points.iter().map(|p| array(p)).collect())
}

fn crossed(edges: &[([f64; 2], [f64; 2])], closed: bool, path: &str, found: &mut Problems) {
    if edges.len() > SEARCHED {
        return;
    }
    if let Some((first, second, place)) = crossing(edges, closed) {
        let message = format!(
            "the edges from corners {first} and {second}, counted from 0, meet at {}",
            point(&place)
        );
        found.add(path, message);
    }
}

fn body_geometry(scene: &Scene, body: &Body, of: Dimension, path: &str, found: &mut Problems) {
    shape(body.keys(), of, path, found);
    for (k, cut) in body.subtract.iter().enumerate() {
        shape(cut.keys(), of, &format!("{path}.subtract[{k}]"), found);
    }
    of.optional(&body.velocity, &format!("{path}.velocity"), found);
    if body.velocity.is_some() && !body.initial.is_empty() {
        found.add(
            format!("{path}.velocity"),
            "the velocity at the start is given here and by an `initial` plugin: choose one",
        );
    }
    let weightless = scene.numerics.gravity.iter().flatten().all(|g| *g == 0.0);
    match body.pressure {
        Pressure::Hydrostatic if weightless => {
            found.add(
                format!("{path}.pressure"),
                "a hydrostatic pressure needs `numerics.gravity`",
            );
        }
        Pressure::Zero if body.surface.is_some() => found.add(
            format!("{path}.surface"),
            "the level of the surface is used for `pressure = \"hydrostatic\"` only",
        ),
        _ => {}
    }
}

fn shape(keys: ShapeKeys<'_>, of: Dimension, path: &str, found: &mut Problems) {
    let given = keys.given();
    match given.as_slice() {
        [] => {
            let all = if of.0 == 2 {
                "`box`, `polygon` or `disc`"
            } else {
                "`box` or `sphere`"
            };
            return found.add(path, format!("a shape is missing: {all}"));
        }
        [_] => {}
        [_, .., last] => {
            let message = format!("only one shape can stand here, found {}", given.join(", "));
            return found.add(format!("{path}.{last}"), message);
        }
    }
    let at = |key: &str| format!("{path}.{key}");
    if let Some(corners) = keys.bounds {
        of.corners(corners, &at("box"), found);
    }
    for (round, key, dimension) in [(keys.disc, "disc", 2), (keys.sphere, "sphere", 3)] {
        let Some(round) = round else { continue };
        if dimension != of.0 {
            found.add(
                at(key),
                format!(
                    "a {key} is a shape of {dimension}D, and this scene is {}D",
                    of.0
                ),
            );
        } else {
            of.vector(&round.centre, &format!("{path}.{key}.centre"), found);
        }
    }
    if let Some(points) = keys.polygon {
        polygon(points, of, &at("polygon"), found);
    }
}

fn polygon(points: &[Vec<f64>], of: Dimension, path: &str, found: &mut Problems) {
    if of.0 != 2 {
        return found.add(path, "a polygon is a shape of 2D, and this scene is 3D");
    }
    let Some(corners) = chain(points, true, of, path, found) else {
        return;
    };
    let polygon = crate::Polygon::new(corners);
    let (lo, hi) = Shape::<2>::Polygon(polygon.clone()).bounds();
    let size = (hi[0] - lo[0]).max(hi[1] - lo[1]);
    let flat = (hi[0] - lo[0]).min(hi[1] - lo[1]) <= 1e-12 * size;
    let edges: Vec<_> = polygon.edges().collect();
    if flat {
        found.add(path, "the polygon has no area");
    } else if crossing(&edges, true).is_some() {
        crossed(&edges, true, path, found);
    } else if polygon.area().abs() <= 1e-12 * size * size {
        found.add(path, "the polygon has no area");
    }
}

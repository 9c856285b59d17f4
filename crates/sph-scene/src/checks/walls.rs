//! Walls: one geometry each, of the scene's dimension, and keys that go with it.

use scene_text::{Problems, given};
use sph_core::unit_factor;

use crate::checks::corners::{chain, crossed};
use crate::checks::dimension::Dimension;
use crate::checks::motion::{self, TABLES};
use crate::checks::shapes::keys_of_shape;
use crate::geometry::wall_geometry::has_ending;
use crate::tables::wall_shapes::{Face, Wedge};
use crate::{FluidSide, SlipCondition, Wall};

/// Checks everything of a wall that has a place in space.
pub(crate) fn wall_geometry(wall: &Wall, of: Dimension, path: &str, found: &mut Problems) {
    let all = match of.0 {
        2 => "`polyline`, `polygon`, `disc`, `box`, `wedge` or `file`",
        _ => "`box`, `sphere`, `cylinder`, `cone`, `wedge`, `extrusion` or `file`",
    };
    let advice = "; a wall of several parts is several walls";
    if found.one_of(&wall.geometries(), path, "geometry", [all, advice]) {
        keys_of_shape(&wall.shape(), of, path, found);
        drawn(wall, of, path, found);
        companions(wall, path, found);
    }
    of.optional(&wall.translate, &format!("{path}.translate"), found);
    if let Some(rotate) = &wall.rotate {
        let path = format!("{path}.rotate");
        of.axis(&rotate.axis, true, &path, found);
        of.optional(&rotate.centre, &format!("{path}.centre"), found);
    }
    of.optional(&wall.velocity, &format!("{path}.velocity"), found);
    if let Some(motion) = &wall.motion {
        motion::check(motion, of, &format!("{path}.motion"), found);
        if let Some(name) = wall.mover.keys().next() {
            let path = format!("{path}.mover.{name}");
            found.add(
                path,
                "the wall has a prescribed `motion`, too: take one of the two out",
            );
        }
    }
    if let Some(name) = wall.open_boundary.keys().next() {
        let stays = wall.motion.is_none() && wall.mover.is_empty() && wall.velocity.is_none();
        if !stays {
            found.add(
                format!("{path}.open-boundary.{name}"),
                "an open face does not move: take its `motion`, `mover` or `velocity` out",
            );
        }
    }
    match (wall.condition, wall.slip_length) {
        (SlipCondition::PartialSlip, None) => found.add(
            format!("{path}.condition"),
            "`partial-slip` needs the key `slip_length`",
        ),
        (SlipCondition::NoSlip | SlipCondition::FreeSlip | SlipCondition::Coulomb, Some(_)) => {
            found.add(
                format!("{path}.slip_length"),
                "a slip length belongs to `condition = \"partial-slip\"`",
            )
        }
        _ => {}
    }
    let of_friction = given([
        ("friction_coefficient", wall.friction_coefficient.is_some()),
        ("friction_form", wall.friction_form.is_some()),
    ]);
    match wall.condition {
        SlipCondition::Coulomb if wall.friction_coefficient.is_none() => found.add(
            format!("{path}.condition"),
            "`coulomb` needs the key `friction_coefficient`",
        ),
        SlipCondition::Coulomb => {}
        _ => {
            for key in of_friction {
                let message = format!("`{key}` belongs to `condition = \"coulomb\"`");
                found.add(format!("{path}.{key}"), message);
            }
        }
    }
}

/// Geometries that only walls have.
fn drawn(wall: &Wall, of: Dimension, path: &str, found: &mut Problems) {
    let at = |key: &str| format!("{path}.{key}");
    if let Some(points) = &wall.polyline {
        match of.0 {
            2 => polyline(wall, points, path, found),
            _ => found.add(
                at("polyline"),
                "a polyline is a wall of two dimensions, and this scene has three",
            ),
        }
    }
    if wall.bounds.is_some() {
        open_faces(&wall.open, of, &at("open"), found);
    }
    if let Some(wedge) = &wall.wedge {
        ramp(wedge, of, &at("wedge"), found);
    }
    if let Some(file) = &wall.file {
        geometry_file(file, of, &at("file"), found);
    }
}

/// Keys that go with some geometries only.
fn companions(wall: &Wall, path: &str, found: &mut Problems) {
    let mut misplaced = |key: &str, message: &str| found.add(format!("{path}.{key}"), message);
    if wall.polyline.is_none() {
        if wall.closed {
            misplaced("closed", "only a `polyline` is closed by this key");
        }
        if wall.thickness.is_some() {
            misplaced("thickness", "only a `polyline` has a thickness");
        }
    }
    if wall.bounds.is_none() && !wall.open.is_empty() {
        misplaced("open", "only a `box` has faces to leave out");
    }
    if wall.file.is_none() && wall.unit.is_some() {
        misplaced(
            "unit",
            "the unit of coordinates belongs to a `file`; numbers of a scene carry their own: \"5 mm\"",
        );
    }
    if wall.flip && wall.polyline.is_none() && wall.file.is_none() {
        misplaced(
            "flip",
            "only a `polyline` or a `file` is turned round; choose `fluid`",
        );
    }
    if wall.flip && wall.fluid.is_some_and(|side| side != FluidSide::AsDrawn) {
        misplaced(
            "flip",
            "`fluid` says which way the file faces: leave one of the two out",
        );
    }
    let table = wall
        .file
        .as_ref()
        .is_some_and(|file| TABLES.iter().any(|e| has_ending(file, e)));
    if wall.columns.is_some() && !table {
        misplaced("columns", "only a `file` that is a table has columns");
    }
    let stl = wall
        .file
        .as_ref()
        .is_some_and(|file| has_ending(file, "stl"));
    if wall.align && !stl {
        misplaced(
            "align",
            "only facets of an STL file are turned to face one way",
        );
    }
    match (wall.fluid, &wall.polyline, &wall.file) {
        (Some(_), Some(_), _) => misplaced(
            "fluid",
            "the fluid is on the left of travel along a `polyline`; turn the corners round, or give a `polygon`",
        ),
        (Some(FluidSide::AsDrawn), None, None) => misplaced(
            "fluid",
            "only a `file` is drawn one way: choose `inside` or `outside`",
        ),
        _ => {}
    }
    if let Some(unit) = &wall.unit {
        if wall.scale.is_some() {
            misplaced(
                "unit",
                "the coordinates have a `unit` or a `scale`, not both",
            );
        }
        if let Err(why) = unit_factor(unit, "m") {
            misplaced("unit", &why);
        }
    }
}

fn polyline(wall: &Wall, points: &[Vec<f64>], path: &str, found: &mut Problems) {
    if wall.closed && wall.thickness.is_some() {
        found.add(
            format!("{path}.thickness"),
            "a closed wall has one face and no thickness",
        );
    }
    let line = format!("{path}.polyline");
    if wall.closed && points.len() < 3 {
        found.add(&line, "a closed wall needs at least 3 corners");
        return;
    }
    if let Some(points) = chain(points, wall.closed, &line, found) {
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

fn open_faces(open: &[Face], of: Dimension, path: &str, found: &mut Problems) {
    for (k, face) in open.iter().enumerate() {
        let place = format!("{path}[{k}]");
        if face.axis() >= of.0 {
            let message = format!("there is no face `{}` in {}D", face.name(), of.0);
            found.add(place, message);
        } else if open[..k].contains(face) {
            found.add(
                place,
                format!("the face `{}` stands there twice", face.name()),
            );
        }
    }
    let left = (0..of.0).flat_map(|axis| [false, true].map(|upper| (axis, upper)));
    let kept =
        |(axis, upper): (usize, bool)| !open.iter().any(|f| (f.axis(), f.upper()) == (axis, upper));
    if !left.into_iter().any(kept) {
        found.add(path, "all faces of the box are left out: there is no wall");
    }
}

fn ramp(wedge: &Wedge, of: Dimension, path: &str, found: &mut Problems) {
    let corners = [wedge.lo.clone(), wedge.hi.clone()];
    let right = [("lo", &wedge.lo), ("hi", &wedge.hi)]
        .map(|(key, corner)| of.vector(corner, &format!("{path}.{key}"), found));
    if right == [true; 2] {
        of.corners(&corners, path, found);
    }
    let upright = if of.0 == 2 { Face::YPlus } else { Face::ZPlus };
    let up = wedge.up.unwrap_or(upright);
    for (key, face) in [("rise", wedge.rise), ("up", up)] {
        if face.axis() >= of.0 {
            let message = format!("there is no direction `{}` in {}D", face.name(), of.0);
            found.add(format!("{path}.{key}"), message);
        }
    }
    if wedge.rise.axis() == up.axis() {
        let message = format!(
            "the ramp rises towards `{}`, which is along `up`, `{}`: choose a direction across it",
            wedge.rise.name(),
            up.name()
        );
        found.add(format!("{path}.rise"), message);
    }
}

/// The name of a file gives its kind.
fn geometry_file(file: &str, of: Dimension, path: &str, found: &mut Problems) {
    let is = |endings: &[&str]| endings.iter().any(|e| has_ending(file, e));
    let wanted = match of.0 {
        2 => is(&["svg"]) || is(&TABLES),
        _ => is(&["stl"]),
    };
    if wanted {
        return;
    }
    let message = match of.0 {
        2 if is(&["stl"]) => {
            "an STL file is a wall of three dimensions, and this scene has two: give a .svg or .csv file".to_string()
        }
        3 if is(&["svg"]) || is(&TABLES) => {
            "a drawing is a wall of two dimensions, and this scene has three: give a .stl file".to_string()
        }
        2 => format!("expected a file that ends in .svg or .csv, found `{file}`"),
        _ => format!("expected a file that ends in .stl, found `{file}`"),
    };
    found.add(path, message);
}

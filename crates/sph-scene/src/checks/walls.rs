//! Walls: one geometry each, of the scene's dimension, and keys that go with it; walls that grains make.

use std::collections::BTreeMap;

use scene_text::{Problems, given};
use sph_core::{suggestion, unit_factor};

use crate::checks::dimension::{Dimension, chain, crossed};
use crate::checks::motion;
use crate::checks::shapes::keys_of_shape;
use crate::drawings::format::Format;
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
            let message = "the wall has a prescribed `motion`, too: take one of the two out";
            found.add(format!("{path}.mover.{name}"), message);
        }
    }
    if let Some(name) = wall.open_boundary.keys().next() {
        let stays = wall.motion.is_none() && wall.mover.is_empty() && wall.velocity.is_none();
        if !stays {
            let message =
                "an open face does not move: take its `motion`, `mover` or `velocity` out";
            found.add(format!("{path}.open-boundary.{name}"), message);
        }
    }
    condition(wall, path, found);
}

/// The keys of a wall's condition.
fn condition(wall: &Wall, path: &str, found: &mut Problems) {
    let at_condition = format!("{path}.condition");
    match (wall.condition, wall.slip_length) {
        (SlipCondition::PartialSlip, None) => {
            found.add(&at_condition, "`partial-slip` needs the key `slip_length`");
        }
        (SlipCondition::PartialSlip, Some(_)) | (_, None) => {}
        _ => {
            let message = "a slip length belongs to `condition = \"partial-slip\"`";
            found.add(format!("{path}.slip_length"), message);
        }
    }
    if wall.condition == SlipCondition::Coulomb {
        if wall.friction_coefficient.is_none() {
            let message = "`coulomb` needs the key `friction_coefficient`";
            found.add(&at_condition, message);
        }
        return;
    }
    for key in given([
        ("friction_coefficient", wall.friction_coefficient.is_some()),
        ("friction_form", wall.friction_form.is_some()),
    ]) {
        let message = format!("`{key}` belongs to `condition = \"coulomb\"`");
        found.add(format!("{path}.{key}"), message);
    }
}

/// Geometries that only walls have.
fn drawn(wall: &Wall, of: Dimension, path: &str, found: &mut Problems) {
    let at = |key: &str| format!("{path}.{key}");
    if let Some(points) = &wall.polyline {
        let message = "a polyline is a wall of two dimensions, and this scene has three";
        match of.0 {
            2 => polyline(wall, points, path, found),
            _ => found.add(at("polyline"), message),
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
        let message = "the unit of coordinates belongs to a `file`; numbers of a scene carry their own: \"5 mm\"";
        misplaced("unit", message);
    }
    if wall.flip && wall.polyline.is_none() && wall.file.is_none() {
        let message = "only a `polyline` or a `file` is turned round; choose `fluid`";
        misplaced("flip", message);
    }
    if wall.flip && wall.fluid.is_some_and(|side| side != FluidSide::AsDrawn) {
        let message = "`fluid` says which way the file faces: leave one of the two out";
        misplaced("flip", message);
    }
    let format = wall.file.as_deref().and_then(Format::from_name);
    if wall.columns.is_some() && format != Some(Format::Table) {
        misplaced("columns", "only a `file` that is a table has columns");
    }
    if wall.align && format != Some(Format::Stl) {
        let message = "only facets of an STL file are turned to face one way";
        misplaced("align", message);
    }
    if wall.fluid.is_some() && wall.polyline.is_some() {
        let message = "the fluid is on the left of travel along a `polyline`; turn the corners round, or give a `polygon`";
        misplaced("fluid", message);
    } else if wall.fluid == Some(FluidSide::AsDrawn) && wall.file.is_none() {
        let message = "only a `file` is drawn one way: choose `inside` or `outside`";
        misplaced("fluid", message);
    }
    if let Some(unit) = &wall.unit {
        if wall.scale.is_some() {
            let message = "the coordinates have a `unit` or a `scale`, not both";
            misplaced("unit", message);
        }
        if let Err(why) = unit_factor(unit, "m") {
            misplaced("unit", &why);
        }
    }
}

fn polyline(wall: &Wall, points: &[Vec<f64>], path: &str, found: &mut Problems) {
    if wall.closed && wall.thickness.is_some() {
        let path = format!("{path}.thickness");
        found.add(path, "a closed wall has one face and no thickness");
    }
    let line = format!("{path}.polyline");
    if wall.closed && points.len() < 3 {
        found.add(&line, "a closed wall needs at least 3 corners");
        return;
    }
    if let Some(points) = chain(points, wall.closed, &line, found) {
        let count = points.len() - usize::from(!wall.closed);
        let edge = |k: usize| (points[k], points[(k + 1) % points.len()]);
        let edges: Vec<_> = (0..count).map(edge).collect();
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
            let message = format!("the face `{}` stands there twice", face.name());
            found.add(place, message);
        }
    }
    let mut all = (0..of.0).flat_map(|axis| [false, true].map(|upper| (axis, upper)));
    let left_out = |face| open.iter().any(|f| (f.axis(), f.upper()) == face);
    if all.all(left_out) {
        found.add(path, "all faces of the box are left out: there is no wall");
    }
}

fn ramp(wedge: &Wedge, of: Dimension, path: &str, found: &mut Problems) {
    let right = [("lo", &wedge.lo), ("hi", &wedge.hi)]
        .map(|(key, corner)| of.vector(corner, &format!("{path}.{key}"), found));
    if right == [true; 2] {
        of.corners(&[wedge.lo.clone(), wedge.hi.clone()], path, found);
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
    let holds = Format::from_name(file).map(Format::dimension);
    let message = match (of.0, holds) {
        (2, Some(2)) | (3, Some(3)) => return,
        (2, Some(_)) => {
            "an STL file is a wall of three dimensions, and this scene has two: give a .svg or .csv file".to_string()
        }
        (3, Some(_)) => {
            "a drawing is a wall of two dimensions, and this scene has three: give a .stl file".to_string()
        }
        (2, None) => format!("expected a file that ends in .svg or .csv, found `{file}`"),
        _ => format!("expected a file that ends in .stl, found `{file}`"),
    };
    found.add(path, message);
}

/// Checks the beds among the walls of a scene.
pub(crate) fn check_beds(walls: &BTreeMap<String, Wall>, of: Dimension, found: &mut Problems) {
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

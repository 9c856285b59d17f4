//! Walls: one geometry each, of the scene's dimension, and keys that go with it; walls that grains make.

use std::collections::BTreeMap;

use sph_core::{SlipCondition, suggestion, unit_factor};

use crate::checks::motion;
use crate::checks::shapes::keys_of_shape;
use crate::checks::table_check::TableCheck;
use crate::drawings::format::Format;
use crate::tables::wall::{Face, Wedge};
use crate::{FluidSide, Wall};

pub(crate) fn wall_geometry(wall: &Wall, mut check: TableCheck<'_>) {
    let all = match check.dimension {
        2 => "`polyline`, `polygon`, `disc`, `box`, `wedge` or `file`",
        _ => "`box`, `sphere`, `cylinder`, `cone`, `wedge`, `extrusion` or `file`",
    };
    let advice = "; a wall of several parts is several walls";
    let given = wall.geometries();
    if (check.found).one_of(&given, &check.path, "geometry", [all, advice]) {
        keys_of_shape(&wall.shape(), &mut check);
        drawn(wall, &mut check);
        companions(wall, &mut check);
    }
    check.vector("translate", &wall.translate);
    if let Some(rotate) = &wall.rotate {
        let mut check = check.below("rotate");
        check.axis(&rotate.axis, true);
        check.vector("centre", &rotate.centre);
    }
    check.vector("velocity", &wall.velocity);
    if let Some(motion) = &wall.motion {
        motion::check(motion, check.below("motion"));
        if let Some(name) = wall.mover.keys().next() {
            let message = "the wall has a prescribed `motion`, too: take one of the two out";
            check.add(&format!("mover.{name}"), message);
        }
    }
    if let Some(name) = wall.open_boundary.keys().next() {
        let key = format!("open-boundary.{name}");
        let message = "an open face does not move: take its `motion`, `mover` or `velocity` out";
        check.refuse(moves(wall), &key, message);
    }
    condition(wall, &mut check);
}

fn moves(wall: &Wall) -> bool {
    wall.motion.is_some() || !wall.mover.is_empty() || wall.velocity.is_some()
}

fn condition(wall: &Wall, check: &mut TableCheck<'_>) {
    let given = &wall.condition;
    let partial = given.slip == SlipCondition::PartialSlip;
    let message = "`partial-slip` needs the key `slip_length`";
    check.refuse(partial && given.slip_length.is_none(), "condition", message);
    let misplaced = given.slip_length.is_some() && !partial;
    let message = "a slip length belongs to `condition = \"partial-slip\"`";
    check.refuse(misplaced, "slip_length", message);
    let coulomb = given.slip == SlipCondition::Coulomb;
    let coefficient = given.friction_coefficient.is_some();
    let message = "`coulomb` needs the key `friction_coefficient`";
    check.refuse(coulomb && !coefficient, "condition", message);
    let form = given.friction_form.is_some();
    for (key, given) in [
        ("friction_coefficient", coefficient),
        ("friction_form", form),
    ] {
        let message = format!("`{key}` belongs to `condition = \"coulomb\"`");
        check.refuse(given && !coulomb, key, message);
    }
}

/// Geometries that only walls have.
fn drawn(wall: &Wall, check: &mut TableCheck<'_>) {
    if let Some(points) = &wall.polyline {
        let message = "a polyline is a wall of two dimensions, and this scene has three";
        if !check.refuse(check.dimension != 2, "polyline", message) {
            polyline(wall, points, check);
        }
    }
    if wall.bounds.is_some() {
        open_faces(&wall.open, check.below("open"));
    }
    if let Some(wedge) = &wall.wedge {
        ramp(wedge, check.below("wedge"));
    }
    if let Some(file) = &wall.file {
        geometry_file(file, check);
    }
}

/// Keys that go with some geometries only.
fn companions(wall: &Wall, check: &mut TableCheck<'_>) {
    let (line, file) = (wall.polyline.is_some(), wall.file.is_some());
    let message = "only a `polyline` is closed by this key";
    check.refuse(wall.closed && !line, "closed", message);
    let message = "only a `polyline` has a thickness";
    check.refuse(wall.thickness.is_some() && !line, "thickness", message);
    let whole = wall.bounds.is_some() || wall.open.is_empty();
    check.refuse(!whole, "open", "only a `box` has faces to leave out");
    let message =
        "the unit of coordinates belongs to a `file`; numbers of a scene carry their own: \"5 mm\"";
    check.refuse(wall.unit.is_some() && !file, "unit", message);
    let message = "only a `polyline` or a `file` is turned round; choose `fluid`";
    check.refuse(wall.flip && !line && !file, "flip", message);
    let sided = wall.fluid.is_some_and(|side| side != FluidSide::AsDrawn);
    let message = "`fluid` says which way the file faces: leave one of the two out";
    check.refuse(wall.flip && sided, "flip", message);
    let format = wall.file.as_deref().and_then(Format::from_name);
    let table = format == Some(Format::Table);
    let message = "only a `file` that is a table has columns";
    check.refuse(wall.columns.is_some() && !table, "columns", message);
    let message = "only facets of an STL file are turned to face one way";
    check.refuse(wall.align && format != Some(Format::Stl), "align", message);
    let message = "the fluid is on the left of travel along a `polyline`; turn the corners round, or give a `polygon`";
    if !check.refuse(wall.fluid.is_some() && line, "fluid", message) {
        let message = "only a `file` is drawn one way: choose `inside` or `outside`";
        let drawn = wall.fluid == Some(FluidSide::AsDrawn);
        check.refuse(drawn && !file, "fluid", message);
    }
    if let Some(unit) = &wall.unit {
        let message = "the coordinates have a `unit` or a `scale`, not both";
        check.refuse(wall.scale.is_some(), "unit", message);
        if let Err(why) = unit_factor(unit, "m") {
            check.add("unit", why);
        }
    }
}

fn polyline(wall: &Wall, points: &[Vec<f64>], check: &mut TableCheck<'_>) {
    let plate = wall.closed && wall.thickness.is_some();
    let message = "a closed wall has one face and no thickness";
    check.refuse(plate, "thickness", message);
    let few = wall.closed && points.len() < 3;
    if check.refuse(few, "polyline", "a closed wall needs at least 3 corners") {
        return;
    }
    if let Some(points) = check.chain("polyline", points, wall.closed) {
        let count = points.len() - usize::from(!wall.closed);
        let edge = |k: usize| (points[k], points[(k + 1) % points.len()]);
        let edges: Vec<_> = (0..count).map(edge).collect();
        check.crossed("polyline", &edges, wall.closed);
    }
}

fn open_faces(open: &[Face], mut check: TableCheck<'_>) {
    let dimension = check.dimension;
    for (k, face) in open.iter().enumerate() {
        let (index, name) = (format!("[{k}]"), face.name());
        let none = format!("there is no face `{name}` in {dimension}D");
        if !check.refuse(face.axis() >= dimension, &index, none) {
            let message = format!("the face `{name}` stands there twice");
            check.refuse(open[..k].contains(face), &index, message);
        }
    }
    let mut all = (0..dimension).flat_map(|axis| [false, true].map(|upper| (axis, upper)));
    let left_out = |face| open.iter().any(|f| (f.axis(), f.upper()) == face);
    let message = "all faces of the box are left out: there is no wall";
    check.refuse(all.all(left_out), "", message);
}

fn ramp(wedge: &Wedge, mut check: TableCheck<'_>) {
    let dimension = check.dimension;
    if check.vector("lo", &wedge.lo) & check.vector("hi", &wedge.hi) {
        check.corners("", &[wedge.lo.clone(), wedge.hi.clone()]);
    }
    let upright = match dimension {
        2 => Face::YPlus,
        _ => Face::ZPlus,
    };
    let up = wedge.up.unwrap_or(upright);
    for (key, face) in [("rise", wedge.rise), ("up", up)] {
        let message = format!("there is no direction `{}` in {dimension}D", face.name());
        check.refuse(face.axis() >= dimension, key, message);
    }
    let message = format!(
        "the ramp rises towards `{}`, which is along `up`, `{}`: choose a direction across it",
        wedge.rise.name(),
        up.name()
    );
    check.refuse(wedge.rise.axis() == up.axis(), "rise", message);
}

/// The name of a file gives its kind.
fn geometry_file(file: &str, check: &mut TableCheck<'_>) {
    let message = match (check.dimension, Format::from_name(file)) {
        (2, Some(Format::Svg | Format::Table)) | (3, Some(Format::Stl)) => return,
        (2, Some(_)) => {
            "an STL file is a wall of three dimensions, and this scene has two: give a .svg or .csv file".to_string()
        }
        (3, Some(_)) => {
            "a drawing is a wall of two dimensions, and this scene has three: give a .stl file".to_string()
        }
        (2, None) => format!("expected a file that ends in .svg or .csv, found `{file}`"),
        _ => format!("expected a file that ends in .stl, found `{file}`"),
    };
    check.add("file", message);
}

/// Checks a wall that is a bed of grains or stands in one of the walls.
pub(crate) fn bed(wall: &Wall, walls: &BTreeMap<String, Wall>, mut check: TableCheck<'_>) {
    let erodible = wall.erodible.is_some();
    if erodible || wall.stands_in.is_some() {
        let key = if erodible { "erodible" } else { "stands_in" };
        let plate = !wall.open_boundary.is_empty() || wall.thickness.is_some();
        let message = "a bed of grains, and walls that stand in it, have no `motion`, `mover`, `velocity`, \
                       `open-boundary` or `thickness`";
        check.refuse(moves(wall) || plate, key, message);
    }
    if let Some(erodible) = &wall.erodible {
        let mut check = check.below("erodible");
        let (dimension, wanted) = (check.dimension, check.dimension - 1);
        for (key, list) in [("from", &erodible.from), ("to", &erodible.to)] {
            let given = list.as_ref().map_or(wanted, Vec::len);
            let message = format!("expected {wanted} number(s) in {dimension}D, found {given}");
            check.refuse(given != wanted, key, message);
        }
        let [from, to] = [&erodible.from, &erodible.to].map(|end| end.iter().flatten());
        let message = "the bed must end behind its beginning `from`";
        check.refuse(from.zip(to).any(|(a, b)| a >= b), "to", message);
    }
    if let Some(bed) = &wall.stands_in {
        let beds = walls.iter().filter(|(_, wall)| wall.erodible.is_some());
        let beds: Vec<&str> = beds.map(|(name, _)| name.as_str()).collect();
        let message = "a wall that is a bed itself stands in no other one";
        if !check.refuse(erodible, "stands_in", message) {
            let near = suggestion(bed, beds.iter().copied());
            let message = format!("no wall `{bed}` is `erodible`{near}");
            check.refuse(!beds.contains(&bed.as_str()), "stands_in", message);
        }
    }
}

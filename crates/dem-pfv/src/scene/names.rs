//! Names of walls.

use crate::scene::{Axis, Scene, tables};

/// The walls of a box, in the order of `dem_pfv::grains::Wall::cuboid`.
pub const BOX: [&str; 6] = ["left", "right", "front", "back", "bottom", "top"];

/// True if the box repeats itself along an axis.
pub fn periodic(scene: &Scene, axis: usize) -> bool {
    let given = scene.r#box.iter().flat_map(|b| &b.periodic);
    given.map(|a: &Axis| a.number()).any(|a| a == axis)
}

/// Names of the planes in the order in which the system has them: those of the box, then further ones.
pub fn planes(scene: &Scene) -> Vec<String> {
    let stands = |(k, name): (usize, &&str)| {
        let given = scene.r#box.as_ref()?;
        let open = periodic(scene, k / 2) || given.open.iter().any(|open| open == *name);
        (!open).then(|| (*name).to_string())
    };
    let boxed = BOX.iter().enumerate().filter_map(stands);
    let further = |(name, wall): &(&String, &tables::Wall)| {
        !BOX.contains(&name.as_str()) && wall.file.is_none()
    };
    let more = scene.wall.iter().filter(further);
    boxed.chain(more.map(|(name, _)| name.clone())).collect()
}

/// Numbers, and tables in the scene, of the planes that have one.
pub fn planes_with_tables(scene: &Scene) -> impl Iterator<Item = (usize, &tables::Wall)> {
    let all = planes(scene).into_iter().enumerate();
    all.filter_map(|(number, name)| Some((number, scene.wall.get(&name)?)))
}

/// Names of the surfaces of triangles.
pub fn surfaces(scene: &Scene) -> Vec<String> {
    let surfaces = scene.wall.iter().filter(|(_, wall)| wall.file.is_some());
    surfaces.map(|(name, _)| name.clone()).collect()
}

/// Walls beyond this place are not there any more, m.
pub const FAR_ENOUGH: f64 = 5e3;

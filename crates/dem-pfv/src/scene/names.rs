//! Names of walls.

use crate::scene::tables::{Axis, Scene};

/// The walls of a box, in the order of `dem_pfv::grains::Wall::cuboid`.
pub const BOX: [&str; 6] = ["left", "right", "front", "back", "bottom", "top"];

/// True if the box repeats itself along an axis.
pub fn periodic(scene: &Scene, axis: usize) -> bool {
    let given = scene.r#box.iter().flat_map(|b| &b.periodic);
    given.map(|a: &Axis| a.number()).any(|a| a == axis)
}

/// Names of the planes in the order in which the system has them: those of the box, then further ones.
pub fn planes(scene: &Scene) -> Vec<String> {
    let boxed = BOX.iter().enumerate().filter(|(k, name)| {
        scene
            .r#box
            .as_ref()
            .is_some_and(|b| !periodic(scene, *k / 2) && !b.open.iter().any(|open| open == *name))
    });
    let boxed = boxed.map(|(_, name)| (*name).to_string());
    let more = scene
        .wall
        .iter()
        .filter(|(name, wall)| !BOX.contains(&name.as_str()) && wall.file.is_none());
    boxed.chain(more.map(|(name, _)| name.clone())).collect()
}

/// Names of the surfaces of triangles.
pub fn surfaces(scene: &Scene) -> Vec<String> {
    let surfaces = scene.wall.iter().filter(|(_, wall)| wall.file.is_some());
    surfaces.map(|(name, _)| name.clone()).collect()
}

/// Walls beyond this place are not there any more, m.
pub const FAR_ENOUGH: f64 = 5e3;

//! The walls of a scene: their names, their places at rest, and their motion.

use scene_text::unit_factor;

use crate::grains::{Control, Mesh, Setup, Wall};
use crate::scene::{Axis, DemError, Laws, Loaded, Scene, tables};

/// Distance of a wall that is not there, m.
pub(crate) const FAR: f64 = 1e4;

/// The planes and surfaces of a scene, at rest; a top that comes down later is out of the way.
pub(crate) fn setup(
    loaded: &Loaded,
    grains: Vec<crate::grains::Grain>,
    laws: Laws,
) -> Result<Setup, DemError> {
    let scene = &loaded.scene;
    let law_of = |name: &str, otherwise| *laws.of_walls.get(name).unwrap_or(&otherwise);
    let mut setup = Setup {
        grains,
        laws: laws.all,
        gravity: scene.grains.gravity.unwrap_or_default().into(),
        damping: scene.start.damping,
        skin: scene.grains.skin,
        ..Setup::default()
    };
    let cuboid = scene.r#box.as_ref().map(|b| Wall::cuboid(b.low, b.high));
    for name in planes(scene) {
        let boxed = BOX.iter().position(|b| *b == name).zip(cuboid);
        let wall = match (boxed, scene.wall.get(&name)) {
            (Some((number, cuboid)), _) => cuboid[number].with_law(law_of(&name, laws.of_box)),
            (None, Some(table)) => {
                let [point, normal] = [table.point, table.normal].map(Option::unwrap_or_default);
                Wall::new(point, normal).with_law(law_of(&name, laws.of_others))
            }
            (None, None) => continue,
        };
        setup.walls.push(wall);
    }
    if let Some(given) = &scene.r#box {
        for axis in given.periodic.iter().map(|a| a.number()) {
            setup = setup.periodic(axis, given.low[axis], given.high[axis]);
        }
    }
    for (name, table) in &scene.wall {
        if let Some(file) = &table.file {
            let mut mesh = surface(loaded, name, file, table)?;
            mesh.centre = table.point.unwrap_or_default().into();
            mesh.law = law_of(name, laws.of_others);
            setup = setup.mesh(mesh);
        }
    }
    Ok(setup)
}

/// The triangles of a file, scaled and shifted.
fn surface(
    loaded: &Loaded,
    name: &str,
    file: &str,
    table: &tables::Wall,
) -> Result<Mesh, DemError> {
    let key = format!("wall.{name}.file");
    let read = scene_text::surface::read(&loaded.resolve(&key, file)?);
    let corners = read.map_err(|e| DemError::at(&key, e))?.triangles;
    let unit = table.unit.as_deref().and_then(|u| unit_factor(u, "m").ok());
    let factor = table.scale.or(unit).unwrap_or(1.0);
    let shift = table.translate.unwrap_or_default();
    let placed = |x: &[f64; 3]| std::array::from_fn(|k| factor * x[k] + shift[k]);
    let vertices: Vec<[f64; 3]> = corners.iter().flatten().map(placed).collect();
    let triangles = (0..corners.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]);
    Ok(Mesh::new(vertices, triangles.collect()))
}

/// Control of a wall; pistons under their stress, with their share of the grains' mass (kg).
pub(crate) fn control(
    table: &tables::Wall,
    mass: f64,
    stress: impl Fn(&tables::Piston) -> f64,
) -> Control {
    if let Some(piston) = &table.piston {
        return Control::Piston {
            stress: stress(piston),
            mass: piston.mass_share * mass,
        };
    }
    if let Some(servo) = &table.servo {
        return Control::Stress {
            stress: servo.stress,
            largest_speed: servo.speed,
        };
    }
    if table.keeps_volume {
        return Control::Volume;
    }
    match table.strain_rate {
        Some(rate) => Control::StrainRate { rate },
        None => Control::Velocity,
    }
}

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

//! The walls of a scene: their places at rest, and their motion.

use scene_text::unit_factor;

use crate::grains::{Control, Mesh, Setup, Wall};
use crate::scene::{BOX, DemError, Laws, Loaded, tables};

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
    for name in scene.planes() {
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
            setup.period[axis] = Some([given.low[axis], given.high[axis]]);
        }
    }
    for (name, table) in scene.surfaces() {
        let mut mesh = surface(loaded, name, table)?;
        mesh.centre = table.point.unwrap_or_default().into();
        mesh.law = law_of(name, laws.of_others);
        setup.meshes.push(mesh);
    }
    Ok(setup)
}

/// The triangles of a file, scaled and shifted.
fn surface(loaded: &Loaded, name: &str, table: &tables::Wall) -> Result<Mesh, DemError> {
    let key = format!("wall.{name}.file");
    let file = loaded.resolve(&key, table.file.as_deref().unwrap_or_default())?;
    let read = scene_text::surface::read(&file);
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

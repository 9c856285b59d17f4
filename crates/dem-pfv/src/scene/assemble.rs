//! From a scene to the system at the start of its preparation, and from there to the start of the run.

use crate::coupled::{
    CoupledError, CoupledSystem, FlowCondition, FlowSetup, Remeshing, WallBoundary,
};
use crate::grains::{GrainError, GrainSystem};
use crate::scene::{
    BOX, DemError, FAR, Fluid, Laws, Loaded, Model, Origin, Piston, Scene, Wall, control, prepare,
    throats,
};

/// A scene ready to run.
pub struct Assembled {
    /// The system.
    pub model: Model,
    /// Reference values of measurements.
    pub origin: Origin,
}

/// Puts a scene together and prepares its grains; reports its steps.
///
/// # Errors
/// Impossible values of the scene, by their keys.
pub fn assemble(loaded: &Loaded, tell: &mut dyn FnMut(&str)) -> Result<Assembled, DemError> {
    let scene = &loaded.scene;
    let laws = Laws::from_scene(scene)?;
    let mut grains = prepare::grains(loaded, laws, tell)?;
    let mut origin = Origin::new(scene, &grains);
    if let Some(test) = &scene.oedometer {
        tell("loading the dry packing slowly");
        origin.dry_strain = Some(prepare::dry_strain(scene, test, &grains)?);
    }
    run_controls(scene, &mut grains);
    let damping = grains.set_damping(scene.run.damping);
    damping.map_err(|e| DemError::at("run.damping", e))?;
    grains.restart_clock();
    let model = match &scene.fluid {
        None => Model::Dry(Box::new(grains)),
        Some(fluid) => {
            let setup = flow(loaded, fluid)?;
            let system = CoupledSystem::with_law(grains, setup, throats(scene)?);
            let system = system.map_err(|e| DemError::at(key_of(&e), e))?;
            if scene.oedometer.is_some() {
                let mobility = system.mobility(2).map_err(|e| DemError::at("fluid", e))?;
                origin.mobility = Some(mobility);
            }
            Model::Wet(Box::new(system))
        }
    };
    Ok(Assembled { model, origin })
}

/// The key that is most likely at fault.
fn key_of(error: &CoupledError) -> &'static str {
    match error {
        CoupledError::Grains(GrainError::NoGrains) => "grains",
        CoupledError::Grains(_) | CoupledError::Mesh(_) => "start",
        _ => "fluid",
    }
}

/// Loads that change with time.
pub fn loads(scene: &Scene) -> impl Iterator<Item = (usize, &Piston)> {
    scene.planes_with_tables().filter_map(|(wall, table)| {
        let piston = table.piston.as_ref()?;
        (piston.ramp != 0.0 || piston.amplitude != 0.0).then_some((wall, piston))
    })
}

/// Controls of the walls in the run.
fn run_controls(scene: &Scene, grains: &mut GrainSystem) {
    let mass: f64 = grains.grains.mass.iter().sum();
    for (number, table) in scene.planes_with_tables() {
        let wall = &mut grains.walls[number];
        if table.removed {
            // Out of reach: the system keeps its walls.
            let away = wall.normal * FAR;
            wall.point -= away;
        }
        wall.velocity = table.velocity.unwrap_or_default().into();
        wall.control = control(table, mass, |p| p.stress);
    }
    for (mesh, (_, table)) in grains.meshes.iter_mut().zip(scene.surfaces()) {
        mesh.velocity = table.velocity.unwrap_or_default().into();
        mesh.spin = table.spin.unwrap_or_default().into();
    }
}

/// The fluid and its conditions.
fn flow(loaded: &Loaded, fluid: &Fluid) -> Result<FlowSetup, DemError> {
    let mut setup = FlowSetup::new(fluid.given);
    setup.remeshing = Remeshing {
        strain: Some(fluid.remesh_strain),
        most_steps: fluid.remesh_steps,
    };
    for (number, name) in BOX.iter().enumerate() {
        if let Some(table) = loaded.scene.wall.get(*name) {
            setup = setup.side(number, side(loaded, name, table)?);
        }
    }
    Ok(setup)
}

fn side(loaded: &Loaded, name: &str, table: &Wall) -> Result<WallBoundary, DemError> {
    let condition = match (table.pressure, table.inflow, &table.wave) {
        (Some(pressure), ..) => FlowCondition::Pressure(pressure),
        (_, Some(speed), _) => FlowCondition::Inflow(speed),
        (.., Some(load)) => FlowCondition::Wave(*load),
        _ => match &table.recorded {
            Some(load) => FlowCondition::Recorded(loaded.recorded(name, load)?),
            None => FlowCondition::Closed,
        },
    };
    Ok(WallBoundary {
        condition,
        sticks: table.sticks,
    })
}

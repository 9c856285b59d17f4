//! Time per coupled step of a packing under a load that came suddenly, and of what is done once per mesh.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release -p dem-coupled --example cost <file of spheres in a unit box, x y z r>`

mod common;

use std::time::Instant;

use dem_coupled::{CoupledSystem, FlowSetup, Fluid, Remeshing, Side};
use dem_grains::Control;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args()
        .nth(1)
        .ok_or("name a file of spheres, x y z r")?;
    let mut grains = common::boxed(common::spheres(&file)?, 0.0)?;
    let (count, porosity) = (grains.grains().len(), grains.porosity().unwrap_or_default());
    let mass = 0.1 * grains.grains().masses().iter().sum::<f64>();
    grains.walls_mut()[5].control = Control::Piston {
        stress: 1.5e4,
        mass,
    };
    let setup = FlowSetup::new(Fluid::new(250.0, 0.0));
    let setup = setup
        .side(4, Side::drained(0.0))
        .side(5, Side::drained(0.0));
    let start = Instant::now();
    let mut system = CoupledSystem::new(grains, setup.clone())?;
    let made = start.elapsed();
    let limit = system.step_limit()?;
    let cells = system.pores().volumes().len();
    println!("# {count} grains, {cells} cells, porosity {porosity:.4}");
    println!(
        "mesh, throats, factorisation  {:8.2} ms",
        1e3 * made.as_secs_f64()
    );
    println!(
        "strongest drag                {:8.2} ms",
        1e3 * (start.elapsed() - made).as_secs_f64()
    );
    let mut dry = common::boxed(common::spheres(&file)?, 0.0)?;
    let (steps, step) = (300, 0.8 * limit.step);
    let start = Instant::now();
    for _ in 0..steps {
        dry.step(step)?;
    }
    let each = |start: Instant| 1e3 * start.elapsed().as_secs_f64() / f64::from(steps);
    println!("dry step                      {:8.2} ms", each(start));
    let start = Instant::now();
    for _ in 0..steps {
        system.step(step)?;
    }
    println!(
        "coupled step, 1 % of strain   {:8.2} ms, {} meshes in {steps} steps",
        each(start),
        system.meshes() - 1
    );
    let mut system = CoupledSystem::new(system.into_grains(), setup.remeshing(Remeshing::never()))?;
    let start = Instant::now();
    for _ in 0..steps {
        system.step_unchecked(step)?;
    }
    println!("coupled step, no new mesh     {:8.2} ms", each(start));
    Ok(())
}

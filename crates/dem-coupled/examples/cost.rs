//! Time per coupled step of a packing under load, on as many threads as RAYON_NUM_THREADS says.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release -p dem-coupled --example cost [grains]`

use std::time::Instant;

use dem_coupled::{CoupledError, CoupledSystem, FlowSetup, Fluid, Remeshing, Side};
use dem_grains::{
    Cloud, Control, Grain, GrainSystem, Growth, LinearElastic, Setup, Target, Wall, uniform_radii,
};

/// Grown to 50 kPa with E = 15 MPa in a unit box, d_max / d_min = 1.22.
fn sample(count: usize) -> Result<GrainSystem, CoupledError> {
    let radius = (0.25 * 0.75 / std::f64::consts::PI / count as f64).cbrt();
    let radii = uniform_radii(count, 0.9 * radius, 1.1 * radius, 1);
    let places = Cloud::new([0.0; 3], [1.0; 3]).place(&radii, 1)?;
    let grains = places.iter().zip(&radii);
    let grains = grains
        .map(|(at, &r)| Grain::new((*at).into(), r, 2600.0))
        .collect();
    let law = |ratio, friction| LinearElastic::new(15e6, ratio, friction);
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    let setup = Setup::new(grains, law(0.5, 0.0175))
        .law(law(0.0, 0.0))
        .walls(walls);
    let mut system = GrainSystem::new(setup.damping(0.2))?;
    let growth = Growth {
        tolerance: 0.02,
        ..Growth::new(Target::Stress(5e4), 15e6)
    };
    growth.run(&mut system)?;
    system.set_damping(0.0)?;
    Ok(system)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(5000), |a| a.parse())?;
    let mut grains = sample(count)?;
    let mass = 0.1 * grains.grains().masses().iter().sum::<f64>();
    grains.walls_mut()[5].control = Control::Piston {
        stress: 5.5e4,
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
    println!(
        "# {count} grains, {} cells, porosity {:.4}",
        system.pores().volumes().len(),
        system.grains().porosity().unwrap_or_default()
    );
    println!(
        "mesh, throats, factorisation  {:8.2} ms",
        1e3 * made.as_secs_f64()
    );
    println!(
        "strongest drag                {:8.2} ms",
        1e3 * (start.elapsed() - made).as_secs_f64()
    );
    let mut dry = GrainSystem::resume(
        system.grains().save(),
        vec![
            Box::new(LinearElastic::new(15e6, 0.5, 0.0175)),
            Box::new(LinearElastic::new(15e6, 0.0, 0.0)),
        ],
    )?;
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

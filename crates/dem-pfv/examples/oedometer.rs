//! Consolidation of a packing between two drained walls: p in the middle and U beside Terzaghi.
//!
//! Catalano 2012, §4.4.1: 5000 grains, 5 kPa, E = 15 MPa, a = 0.5; the packing comes from the example `pack`.
//! `cargo run --release -p dem-pfv --example oedometer <file> [confining Pa] [load Pa] [viscosity Pa s]`

mod common;

use dem_pfv::coupled::{CoupledSystem, FlowSetup, Fluid, Terzaghi, WallBoundary};
use dem_pfv::grains::{Control, GrainError, GrainSystem, step_to_rest};

type Failure = Box<dyn std::error::Error>;

/// Loads the top, a piston of a twentieth of the grains' mass.
fn press(grains: &mut GrainSystem, stress: f64) {
    let mass = 0.05 * grains.grains.mass.iter().sum::<f64>();
    grains.walls[5].control = Control::Piston { stress, mass };
}

fn sample(file: &str, stress: f64) -> Result<GrainSystem, Failure> {
    let mut grains = common::boxed(common::spheres(file)?, 0.4)?;
    press(&mut grains, stress);
    step_to_rest(&mut grains, 0.8, 1e-5, 100_000)?;
    Ok(grains)
}

fn height(grains: &GrainSystem) -> f64 {
    grains.box_lengths().map_or(f64::NAN, |l| l[2])
}

/// Strain under the load when it comes so slowly that nothing swings.
fn dry_strain(grains: GrainSystem, confining: f64, load: f64) -> Result<f64, GrainError> {
    let start = height(&grains);
    let mut grains = grains;
    for part in 1..=40 {
        press(&mut grains, confining + load * f64::from(part) / 40.0);
        step_to_rest(&mut grains, 0.8, 1e-4, 100_000)?;
    }
    step_to_rest(&mut grains, 0.8, 1e-6, 100_000)?;
    Ok((start - height(&grains)) / start)
}

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("name a file of spheres, x y z r")?;
    let mut next = |or: f64| arguments.next().map_or(Ok(or), |a| a.parse());
    let (confining, load, viscosity) = (next(1e4)?, next(5e3)?, next(125.0)?);
    let strain = dry_strain(sample(&file, confining)?, confining, load)?;
    let mut grains = sample(&file, confining)?;
    grains.set_damping(0.0)?;
    press(&mut grains, confining + load);
    let (high, start) = (height(&grains), grains.time);
    let drained = || WallBoundary::drained(0.0);
    let setup = FlowSetup::new(Fluid::new(viscosity, 0.0))
        .side(4, drained())
        .side(5, drained());
    let mut system = CoupledSystem::new(grains, setup)?;
    let mobility = system.mobility(2)?;
    let coefficient = mobility * load / strain;
    let count = system.grains().grains.len();
    let diameter = 2.0 * system.grains().grains.radius.iter().sum::<f64>() / count as f64;
    let plain = Terzaghi {
        coefficient,
        drainage: 0.5 * high,
    };
    let short = Terzaghi {
        drainage: 0.5 * high - 1.2 * diameter,
        ..plain
    };
    println!(
        "# {count} grains, dry strain {strain:.3e}, E_oed {:.3e} Pa, C_v {coefficient:.4} m2/s",
        load / strain
    );
    println!(
        "# T_v, p/load in the middle, U, Terzaghi p, U, with L - 1.2 d_50 p, U, steps, meshes"
    );
    let mut settled = Vec::new();
    for factor in [
        0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.5, 2.0,
    ] {
        let time = plain.time(factor);
        system.run_to(start + time, 0.8)?;
        let middle = 0.5 * high;
        let p = system
            .layer_pressure(2, middle - 0.5 * diameter, middle + 0.5 * diameter)
            .unwrap_or(f64::NAN);
        let u = (high - height(system.grains())) / high / strain;
        settled.push((time, u));
        print!("{factor:.2} {:.4} {u:.4}", p / load);
        for theory in [plain, short] {
            print!(
                "  {:.4} {:.4}",
                theory.pressure(theory.drainage, time),
                theory.consolidation(time)
            );
        }
        println!("  {} {}", system.grains().steps, system.meshes);
    }
    at_last(&mut system, [mobility, load, strain, high], short, &settled)
}

/// What large strains leave (Catalano 2012, §4.4.2): permeability, modulus, and which C_v tells U better from T_v = 0.1 to 1.
fn at_last(
    system: &mut CoupledSystem,
    [mobility, load, strain, high]: [f64; 4],
    first: Terzaghi,
    settled: &[(f64, f64)],
) -> Result<(), Failure> {
    let now = height(system.grains());
    let (wet, after) = ((high - now) / high, system.mobility(2)?);
    let last = Terzaghi {
        coefficient: after * load / wet,
        drainage: first.drainage - 0.5 * (high - now),
    };
    let error = |theory: &Terzaghi| {
        let range = first.time(0.1) * 0.999..first.time(1.0) * 1.001;
        let inside = settled.iter().filter(|(t, _)| range.contains(t));
        let squares: Vec<f64> = inside
            .map(|(t, u)| (u - theory.consolidation(*t)).powi(2))
            .collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    println!(
        "# at last: strain {wet:.3e} (dry {strain:.3e}), K {mobility:.3e} to {after:.3e} m2/(Pa s), {:+.1} %, C_v {:.4} to {:.4}",
        1e2 * (after / mobility - 1.0),
        first.coefficient,
        last.coefficient
    );
    println!(
        "# RMS of U, T_v = 0.1 to 1: {:.4} with the first C_v, {:.4} with the last",
        error(&first),
        error(&last)
    );
    Ok(())
}

//! Seepage under a cosine load, Catalano 2012, §6.2, Eqs. (6.20) to (6.26): RMS and mean error of the inner cells.
//!
//! `cargo run --release -p dem-pfv --example darcy <file of spheres in a unit box, x y z r>`

mod common;

use std::f64::consts::PI;

use dem_pfv::Axis;
use dem_pfv::coupled::{CoupledSystem, FlowCondition, FlowSetup, Fluid, WallBoundary, Wave};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args()
        .nth(1)
        .ok_or("name a file of spheres, x y z r")?;
    let mut grains = common::spheres(&file)?;
    grains.iter_mut().for_each(|g| g.held = true);
    for up in [1, 2] {
        let condition = FlowCondition::Wave(Wave {
            axis: Axis::X,
            crest: 0.0,
            half_length: 1.0,
            amplitude: 0.5,
            ramp: 0.0,
            period: None,
        });
        let grains = common::boxed(grains.clone(), 0.0)?;
        let top = WallBoundary {
            condition,
            sticks: false,
        };
        let mut system = CoupledSystem::new(
            grains,
            FlowSetup::new(Fluid::new(1.0, 0.0)).side(2 * up + 1, top),
        )?;
        system.step(1e-6)?;
        let cells = system
            .pores()
            .mesh
            .cells
            .iter()
            .zip(&system.pores().centres);
        let (mut square, mut sum, mut count) = (0.0, 0.0, 0.0);
        for ((cell, at), p) in cells.zip(&system.pressures) {
            if cell.walls() == 0 {
                let error = p - 0.5 * (PI * at.x).cos() * (PI * at[up]).cosh() / PI.cosh();
                (square, sum, count) = (square + error * error, sum + error, count + 1.0);
            }
        }
        println!(
            "axis {up} up: RMS {:.4}, mean {:+.4} of the crest's pressure, {count} cells",
            f64::sqrt(square / count),
            sum / count
        );
    }
    Ok(())
}

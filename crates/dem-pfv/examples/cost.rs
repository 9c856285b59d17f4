//! Time per coupled step of a packing under a load that came suddenly, and of what is done once per mesh.
//!
//! `RAYON_NUM_THREADS=1 cargo run --release -p dem-pfv --example cost <file of spheres in a unit box, x y z r>`

mod common;

use std::time::Instant;

use dem_pfv::coupled::{CoupledSystem, FlowSetup, Fluid, WallBoundary};
use dem_pfv::grains::{Control, GrainSystem};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let file = std::env::args()
        .nth(1)
        .ok_or("name a file of spheres, x y z r")?;
    let mut dry = common::boxed(common::spheres(&file)?, 0.0)?;
    let (count, porosity) = (dry.grains.len(), dry.porosity().unwrap_or_default());
    let loaded = || -> Result<GrainSystem, Box<dyn std::error::Error>> {
        let mut grains = common::boxed(common::spheres(&file)?, 0.0)?;
        let mass = 0.1 * grains.grains.mass.iter().sum::<f64>();
        grains.walls[5].control = Control::Piston {
            stress: 1.5e4,
            mass,
        };
        Ok(grains)
    };
    let setup = FlowSetup::new(Fluid::new(250.0, 0.0));
    let mut setup = setup
        .side(4, WallBoundary::drained(0.0))
        .side(5, WallBoundary::drained(0.0));
    let grains = loaded()?;
    let start = Instant::now();
    let mut system = CoupledSystem::new(grains, setup.clone())?;
    let made = start.elapsed();
    let limit = system.step_limit()?;
    let cells = system.pores().volumes.len();
    println!("# {count} grains, {cells} cells, porosity {porosity:.4}");
    println!(
        "mesh, throats, factorisation  {:8.2} ms",
        1e3 * made.as_secs_f64()
    );
    println!(
        "strongest drag                {:8.2} ms",
        1e3 * (start.elapsed() - made).as_secs_f64()
    );
    let (steps, step) = (300, 0.8 * limit.step);
    let start = Clock::now();
    for _ in 0..steps {
        dry.step(step)?;
    }
    let each = |start: Clock| start.each(steps);
    println!("dry step                      {}", each(start));
    let start = Clock::now();
    for _ in 0..steps {
        system.step(step)?;
    }
    println!(
        "coupled step, 1 % of strain   {}, {} meshes in {steps} steps",
        each(start),
        system.meshes - 1
    );
    setup.remeshing.strain = None;
    let mut system = CoupledSystem::new(loaded()?, setup)?;
    let start = Clock::now();
    for _ in 0..steps {
        system.step_unchecked(step)?;
    }
    println!("coupled step, no new mesh     {}", each(start));
    Ok(())
}

/// The time on the wall and that of the processors, which a busy machine stretches less.
struct Clock {
    start: Instant,
    busy: Option<f64>,
}

impl Clock {
    fn now() -> Self {
        Self {
            start: Instant::now(),
            busy: busy(),
        }
    }

    fn each(&self, steps: u32) -> String {
        let mean = |seconds: f64| 1e3 * seconds / f64::from(steps);
        let wall = format!("{:8.2} ms", mean(self.start.elapsed().as_secs_f64()));
        match (self.busy, busy()) {
            (Some(from), Some(to)) => format!("{wall} ({:.2} ms of processors)", mean(to - from)),
            _ => wall,
        }
    }
}

/// Seconds that all threads have computed, where the system tells (Linux: hundredths).
fn busy() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields = text.rsplit(')').next()?.split_whitespace();
    let ticks: Vec<f64> = fields
        .skip(11)
        .take(1)
        .filter_map(|t| t.parse().ok())
        .collect();
    Some(ticks.first()? / 100.0)
}

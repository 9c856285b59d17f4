//! Triaxial compression of a dense and a loose sample, as a table of strain, deviator and volumetric strain.
//!
//! Catalano 2012, §6.3.1, Table 6.1: 5000 grains, 50 kPa, E = 15 MPa, a = 0.5, φ = 30° in the test.
//! `cargo run --release -p dem-pfv --example triaxial [grains] [rate 1/s]`

use dem_pfv::grains::{
    Cloud, Control, Grain, GrainError, GrainSystem, Grown, LinearElastic, Setup, Wall,
    uniform_radii,
};

const MODULUS: f64 = 15e6;
const STRESS: f64 = 5e4;

fn law(degrees: f64) -> LinearElastic {
    LinearElastic::new(MODULUS, 0.5, degrees.to_radians().tan())
}

/// Grown at the friction of the preparation, then given that of the test.
fn sample(grains: usize, degrees: f64) -> Result<GrainSystem, GrainError> {
    // A cloud of porosity 0.75 in a unit cube; d_max / d_min = 1.22.
    let radius = (0.25 * 0.75 / std::f64::consts::PI / grains as f64).cbrt();
    let radii = uniform_radii(grains, 0.9 * radius, 1.1 * radius, 1);
    let places = Cloud::new([0.0; 3], [1.0; 3]).place(&radii, 1)?;
    let grains = places.iter().zip(&radii);
    let grains = grains.map(|(at, &r)| Grain::new((*at).into(), r, 2600.0));
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    let setup = Setup::new(grains.collect(), law(degrees));
    let setup = setup
        .law(LinearElastic::new(MODULUS, 0.0, 0.0))
        .walls(walls);
    let mut system = GrainSystem::new(setup.damping(0.2))?;
    let growth = Grown {
        stress: Some(STRESS),
        ..Grown::default()
    };
    let steps = growth.run(&mut system, 0.5, 1_000_000)?;
    let porosity = system.porosity().unwrap_or_default();
    println!("# prepared at {degrees} degrees in {steps} steps: porosity {porosity:.4}");
    system.set_law(0, Box::new(law(30.0)))?;
    Ok(system)
}

fn compress(system: &mut GrainSystem, rate: f64) -> Result<(), GrainError> {
    for (number, wall) in system.walls.iter_mut().enumerate() {
        wall.control = if number < 4 {
            Control::Stress {
                stress: STRESS,
                largest_speed: 0.5,
            }
        } else {
            Control::StrainRate { rate }
        };
    }
    let start = system.box_lengths().unwrap_or([1.0; 3]);
    println!(
        "# axial strain, q (Pa), volumetric strain (dilation positive), porosity, unbalanced force"
    );
    let (mut next, mut sum, mut count) = (0.0, 0.0, 0.0);
    while next <= 0.25 {
        let step = 0.6 * system.current_limit();
        system.step(step)?;
        let mut stress = [0.0; 6];
        for (number, stress) in stress.iter_mut().enumerate() {
            *stress = system.wall_stress(number)?;
        }
        let lateral = stress[..4].iter().sum::<f64>() / 4.0;
        sum += 0.5 * (stress[4] + stress[5]) - lateral;
        count += 1.0;
        let lengths = system.box_lengths().unwrap_or([1.0; 3]);
        let strain: [f64; 3] = std::array::from_fn(|k| (lengths[k] / start[k]).ln());
        if -strain[2] >= next {
            println!(
                "{:.4} {:.0} {:+.5} {:.4} {:.1e}",
                -strain[2],
                sum / count,
                strain.iter().sum::<f64>(),
                system.porosity().unwrap_or_default(),
                system.unbalanced_force()
            );
            (sum, count) = (0.0, 0.0);
            next += 0.005;
        }
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let grains = arguments.next().map_or(Ok(1000), |a| a.parse())?;
    let rate = arguments.next().map_or(Ok(0.05), |a| a.parse())?;
    for degrees in [1.0, 30.0] {
        compress(&mut sample(grains, degrees)?, rate)?;
    }
    Ok(())
}

//! Grows a packing in the unit box and prints its spheres, x y z r in m.
//!
//! `cargo run --release -p dem-pfv --example pack [grains] [stress Pa] [friction degrees] [d_max/d_min] [seed]`

use dem_pfv::grains::{
    Cloud, GrainError, GrainSystem, Grown, LinearElastic, Setup, Wall, uniform_radii,
};

fn main() -> Result<(), GrainError> {
    let mut numbers = std::env::args()
        .skip(1)
        .map(|a| a.parse().unwrap_or(f64::NAN));
    let mut next = |or: f64| numbers.next().unwrap_or(or);
    let (count, stress, degrees, ratio, seed) =
        (next(1000.0), next(1e4), next(1.0), next(1.22), next(1.0));
    let radius = (0.25 * 0.75 / std::f64::consts::PI / count).cbrt();
    let low = 2.0 * radius / (1.0 + ratio);
    let high = 2.0 * radius * ratio / (1.0 + ratio);
    let radii = uniform_radii(count as usize, low, high, seed as u64);
    let grains = Cloud::new([0.0; 3], [1.0; 3]).grains(&radii, 2600.0, seed as u64)?;
    let law = |ratio, friction| LinearElastic::new(15e6, ratio, friction);
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    let setup = Setup::new(grains, law(0.5, degrees.to_radians().tan())).law(law(0.0, 0.0));
    let mut system = GrainSystem::new(setup.walls(walls).damping(0.2))?;
    let growth = Grown {
        stress: Some(stress),
        ..Grown::default()
    };
    let steps = growth.run(&mut system, 0.5, 1_000_000)?;
    let porosity = system.porosity().unwrap_or_default();
    println!(
        "# {count} spheres grown to {stress} Pa with E = 15 MPa, {degrees} degrees, in {steps} steps; n = {porosity:.4}"
    );
    for (x, r) in system.grains.position.iter().zip(&system.grains.radius) {
        println!("{} {} {} {r}", x.x, x.y, x.z);
    }
    Ok(())
}

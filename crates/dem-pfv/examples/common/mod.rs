//! What the examples share.

use dem_pfv::grains::{Grain, GrainSystem, LinearElastic, Setup, Wall};

/// Spheres of a file, one a line: x y z r in m.
pub fn spheres(file: &str) -> Result<Vec<Grain>, Box<dyn std::error::Error>> {
    let mut grains = Vec::new();
    for line in std::fs::read_to_string(file)?
        .lines()
        .filter(|l| !l.starts_with('#'))
    {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        if let [x, y, z, r] = numbers?[..] {
            grains.push(Grain::new([x, y, z], r, 2600.0));
        }
    }
    Ok(grains)
}

/// In a unit box: E = 15 MPa, a = 0.5, friction of 30 degrees, smooth walls.
pub fn boxed(grains: Vec<Grain>, damping: f64) -> Result<GrainSystem, dem_pfv::grains::GrainError> {
    let law = |ratio| LinearElastic::new(15e6, ratio, 30_f64.to_radians().tan());
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| w.with_law(1));
    GrainSystem::new(
        Setup::new(grains, law(0.5))
            .law(law(0.0))
            .walls(walls)
            .damping(damping),
    )
}

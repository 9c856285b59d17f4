//! Collapse of a dry column in a channel: its run-out beside the law of experiments.
//!
//! Glass beads of 2 mm between a plane of symmetry, where a wall is pulled away, and a floor; periodic across.
//! (L_f − L_0)/L_0 = 1.2 a below a = H_0/L_0 = 2.3, 1.9 a^(2/3) above (Lajeunesse et al. 2005, Lube et al. 2005,
//! as quoted by Kumar 2015, whose own discrete elements in the plane ran 1.67 a and 2.7 a^(2/3)).
//! `cargo run --release -p dem-pfv --example column [a] [grains along L_0]`

use dem_pfv::grains::{
    Grain, GrainSystem, LinearElastic, RollingResistance, Setup, Vector, Wall, rain, step_to_rest,
    uniform_radii,
};

const DIAMETER: f64 = 2e-3;
/// Across the channel, in diameters.
const WIDTH: f64 = 5.0;
const MODULUS: f64 = 2e6;

/// Glass: friction 0.5, restitution 0.5, and a little resistance to rolling.
fn glass() -> LinearElastic {
    LinearElastic {
        damping: 0.22,
        rolling: Some(RollingResistance {
            coefficient: 0.1,
            stiffness: 1.0,
        }),
        ..LinearElastic::new(MODULUS, 0.5, 0.5)
    }
}

fn smooth() -> LinearElastic {
    LinearElastic {
        damping: 0.22,
        ..LinearElastic::new(MODULUS, 0.0, 0.0)
    }
}

/// The length within which this share of the grains lies, m.
fn reach(system: &GrainSystem, share: f64) -> f64 {
    let mut along: Vec<f64> = system.grains.position.iter().map(|x| x.x).collect();
    along.sort_by(f64::total_cmp);
    let last = ((along.len() as f64 * share) as usize).min(along.len() - 1);
    along[last] + 0.5 * DIAMETER
}

/// How far the deposit goes on without a gap, m: to where it is thinner than a grain. Single grains that roll
/// on ahead of it do not count.
fn deposit(system: &GrainSystem) -> f64 {
    let bin = 2.0 * DIAMETER;
    let mut volumes = vec![0.0; 1000];
    let g = &system.grains;
    for (x, r) in g.position.iter().zip(&g.radius) {
        if let Some(volume) = volumes.get_mut((x.x / bin) as usize) {
            *volume += 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
        }
    }
    let grain = 0.6 * bin * WIDTH * DIAMETER * DIAMETER;
    let thin = volumes.iter().position(|&v| v < grain);
    thin.unwrap_or(volumes.len()) as f64 * bin
}

fn top(system: &GrainSystem, within: f64) -> f64 {
    let near = system.grains.position.iter().filter(|x| x.x < within);
    near.map(|x| x.z + 0.5 * DIAMETER).fold(0.0, f64::max)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let aspect: f64 = arguments.next().map_or(Ok(1.0), |a| a.parse())?;
    let across: f64 = arguments.next().map_or(Ok(25.0), |a| a.parse())?;
    let (length, width) = (across * DIAMETER, WIDTH * DIAMETER);
    // Poured, spheres fill about 0.6 of the column.
    let solid = 0.6 * length * width * aspect * length;
    let count = (solid / (std::f64::consts::PI / 6.0 * DIAMETER.powi(3))) as usize;
    let radii = uniform_radii(count, 0.45 * DIAMETER, 0.55 * DIAMETER, 1);
    let grains: Vec<Grain> = rain([0.0; 3], [length, width], &radii, 2500.0, 0.68, 1)?;
    let walls = [
        Wall::new([0.0; 3], [0.0, 0.0, 1.0]),
        Wall::new([0.0; 3], [1.0, 0.0, 0.0]).with_law(1),
        Wall::new([length, 0.0, 0.0], [-1.0, 0.0, 0.0]).with_law(1),
    ];
    let setup = Setup::new(grains, glass()).law(smooth()).walls(walls);
    let setup = setup.periodic(1, 0.0, width).gravity([0.0, 0.0, -9.81]);
    let mut system = GrainSystem::new(setup.damping(0.2))?;
    step_to_rest(&mut system, 0.6, 1e-2, 2_000_000)?;
    system.set_damping(0.0)?; // friction and dashpots only
    let height = top(&system, length);
    let aspect = height / length;
    println!("# {count} grains, L_0 = {length:.4} m, H_0 = {height:.4} m, a = {aspect:.3}");

    // The gate is gone at once.
    system.walls[2].point = Vector::x() * 1e3;
    let start = system.time;
    let fall = (height / 9.81).sqrt();
    println!(
        "# t / sqrt(H_0/g), front of 99.5 % of the grains (m), height at the wall (m), kinetic energy (J)"
    );
    let mut next = 0.0;
    while system.time < start + 8.0 * fall {
        let step = 0.6 * system.current_limit();
        system.step(step)?;
        if system.time - start >= next * fall {
            let energy = system.kinetic_energy();
            let front = deposit(&system);
            println!(
                "{next:.2} {front:.4} {:.4} {energy:.2e}",
                top(&system, 2.0 * DIAMETER)
            );
            next += 0.5;
        }
    }
    let law = if aspect < 2.3 {
        1.2 * aspect
    } else {
        1.9 * aspect.powf(2.0 / 3.0)
    };
    let run_out = |length_now: f64| (length_now - length) / length;
    println!(
        "# run-out of the deposit: {:.3}; experiments: {law:.3}",
        run_out(deposit(&system))
    );
    for share in [0.9, 0.95, 0.98] {
        println!(
            "# run-out of {share} of the grains: {:.3}",
            run_out(reach(&system, share))
        );
    }
    let rest = top(&system, 2.0 * DIAMETER) / length;
    let law = if aspect < 0.7 { aspect } else { aspect.cbrt() };
    println!("# final height / L_0: {rest:.3}; experiments: {law:.3}");
    Ok(())
}

//! Triaxial compression of a dense and a loose sample. Source: Catalano 2012, §6.3.1, Table 6.1: E = 15 MPa,
//! a = 0.5, ρ_s = 2600 kg/m³, 50 kPa, φ = 30° in the test; here 1000 grains instead of 5000.

use dem_pfv::grains::{Control, GrainSystem, Grown, LinearElastic};

use crate::close;
use crate::grains::{cloud, grown};

const STRESS: f64 = 5e4;

/// Isotropic at 50 kPa, with the friction of the preparation.
fn sample(degrees: f64) -> GrainSystem {
    let friction = |degrees: f64| degrees.to_radians().tan();
    let growth = Grown {
        fast: 1.001,
        slow: 1.0001,
        tolerance: 2e-3,
        stress: Some(STRESS),
        ..Grown::default()
    };
    let grains = cloud(1000, [0.0265, 0.0323], 4);
    let mut system = grown(grains, friction(degrees), growth);
    let law = LinearElastic::new(15e6, 0.5, friction(30.0));
    system.set_law(0, Box::new(law)).expect("friction");
    system
}

/// Rows of axial strain, deviator q = σ_z − σ_x (Pa) and volumetric strain, positive in dilation.
fn compress(system: &mut GrainSystem, until: f64, rate: f64) -> Vec<[f64; 3]> {
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
    let lengths = |s: &GrainSystem| s.box_lengths().expect("closed");
    let start = lengths(system);
    let mut rows = Vec::new();
    loop {
        let step = 0.6 * system.current_limit();
        system.step(step).expect("a step");
        if !system.steps.is_multiple_of(20) {
            continue;
        }
        let stress = |w: usize| system.wall_stress(w).expect("area");
        let lateral = (0..4).map(stress).sum::<f64>() / 4.0;
        let strain: [f64; 3] = std::array::from_fn(|k| (lengths(system)[k] / start[k]).ln());
        let deviator = 0.5 * (stress(4) + stress(5)) - lateral;
        rows.push([-strain[2], deviator, strain.iter().sum()]);
        if -strain[2] > until {
            return rows;
        }
    }
}

/// Mean of a column between two axial strains.
fn mean(rows: &[[f64; 3]], column: usize, from: f64, to: f64) -> f64 {
    let inside = rows.iter().filter(|r| (from..to).contains(&r[0]));
    let (sum, count) = inside.fold((0.0, 0.0), |(s, n), r| (s + r[column], n + 1.0));
    sum / count
}

/// Dense: a peak, contraction and then dilation. Loose: no peak, contraction. The same residual deviator.
#[test]
fn dense_and_loose_samples_meet_at_the_critical_state() {
    let (mut dense, mut loose) = (sample(1.0), sample(30.0));
    let porosity = |s: &GrainSystem| s.porosity().expect("box");
    let (n_dense, n_loose) = (porosity(&dense), porosity(&loose));
    assert!(n_loose > n_dense + 0.03);
    let dense = compress(&mut dense, 0.4, 0.1);
    let loose = compress(&mut loose, 0.4, 0.1);
    let residual = [mean(&dense, 1, 0.3, 0.4), mean(&loose, 1, 0.3, 0.4)];
    let highest = |rows: &[[f64; 3]]| {
        let from = (0..20).map(|i| 0.005 * f64::from(i));
        from.map(|from| mean(rows, 1, from, from + 0.02))
            .fold(0.0, f64::max)
    };
    let (peak, early) = (highest(&dense), highest(&loose));
    let least = dense.iter().map(|r| r[2]).fold(0.0, f64::min);
    let swollen = mean(&dense, 2, 0.3, 0.4);
    assert!(peak > 1.15 * residual[0], "a peak");
    assert!(early < 1.1 * residual[1], "none when loose");
    assert!(least < 0.0 && swollen > 0.0, "{least}, then {swollen}");
    let contracted = mean(&loose, 2, 0.2, 0.25) - mean(&loose, 2, 0.0, 0.01);
    assert!(contracted < 0.0, "{contracted}");
    // 10 % as asked of 5000 grains at 20 %; a thousand fluctuate so much that the mean from 30 to 40 % is taken.
    close(residual[0] / residual[1], 1.0, 0.1);
    // Both flow at the same porosity: what is left of the gap is a quarter at most.
    let end = |n: f64, rows: &[[f64; 3]]| 1.0 - (1.0 - n) / mean(rows, 2, 0.3, 0.4).exp();
    let gap = end(n_loose, &loose) - end(n_dense, &dense);
    assert!(gap.abs() < 0.25 * (n_loose - n_dense), "{gap}");
}

/// Mean stress over that at the start, pressed to a strain of 5 % while the sides keep the volume.
fn undrained(degrees: f64) -> f64 {
    let mut system = sample(degrees);
    for (number, wall) in system.walls.iter_mut().enumerate() {
        wall.control = match number {
            0..4 => Control::Volume,
            _ => Control::StrainRate { rate: 0.1 },
        };
    }
    let volume = system.box_volume().expect("closed");
    let height = |s: &GrainSystem| s.box_lengths().expect("closed")[2];
    let start = height(&system);
    while (start / height(&system)).ln() < 0.05 {
        let step = 0.6 * system.current_limit();
        system.step(step).expect("a step");
    }
    // Steps are a thousandth of a second at most: ¾ ε̇ Δt ε.
    let change = system.box_volume().expect("closed") / volume - 1.0;
    assert!(change.abs() < 0.75 * 0.1 * 1e-3 * 0.05, "{change}");
    system.mean_stress().expect("a box") / STRESS
}

/// The sign says what a packing can do: one that contracts leaves its stress to a fluid, and one that dilates does not.
#[test]
fn at_constant_volume_loose_grains_lose_their_stress_and_dense_ones_gain() {
    let (loose, dense) = (undrained(30.0), undrained(1.0));
    println!("mean stress over that at the start: loose {loose}, dense {dense}");
    assert!(loose < 1.0 && dense > 1.0, "{loose}, {dense}");
}

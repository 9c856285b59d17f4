//! Time of pores and throats, of a system with its first solve, and of a solve with the factor kept, on box1000.

use dem_pfv::flow::{
    Boundary, FlowSystem, HydraulicRadius, PoreGeometry, SlipCondition, SolidAngles, Solver,
};
use dem_pfv::triangulation::{Sphere, Triangulation, Wall};

fn main() {
    divan::main();
}

fn mesh() -> Triangulation {
    let text = include_str!("../tests/packings/box1000_mono.txt");
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    let sphere = |l: &str| {
        let n: Vec<f64> = l
            .split_whitespace()
            .map(|w| w.parse().expect("a number"))
            .collect();
        Sphere::new([n[0], n[1], n[2]], n[3])
    };
    let spheres: Vec<_> = lines.map(sphere).collect();
    Triangulation::within(&spheres, &Wall::cuboid([0.0; 3], [1.0; 3])).expect("cells")
}

fn pores() -> (PoreGeometry, Boundary) {
    let pores =
        PoreGeometry::new(mesh(), &[SlipCondition::NoSlip; 6], SolidAngles::Signed).expect("pores");
    let mut boundary = Boundary::closed(&pores);
    boundary.pressure(&pores, 2, |_| Some(0.0));
    boundary.pressure(&pores, 3, |_| Some(1.0));
    (pores, boundary)
}

fn system(pores: &PoreGeometry, boundary: &Boundary) -> FlowSystem {
    let law = HydraulicRadius::default();
    FlowSystem::new(pores, boundary, &law, 1.0, None, Solver::Direct).expect("a system")
}

#[divan::bench]
fn geometry(bencher: divan::Bencher) {
    let mesh = mesh();
    bencher.bench(|| {
        PoreGeometry::new(
            mesh.clone(),
            &[SlipCondition::NoSlip; 6],
            SolidAngles::Signed,
        )
    });
}

#[divan::bench]
fn assemble_and_factorise(bencher: divan::Bencher) {
    let (pores, boundary) = pores();
    bencher.bench(|| system(&pores, &boundary));
}

#[divan::bench]
fn solve_again(bencher: divan::Bencher) {
    let (pores, boundary) = pores();
    let mut system = system(&pores, &boundary);
    bencher.bench_local(|| system.solve(&boundary, &[]));
}

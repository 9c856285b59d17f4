//! The examples give what they should, and are each a page.

#[allow(dead_code, reason = "its main is for people")]
#[path = "../../../examples/embedding-bare/examples/drucker_prager_path.rs"]
mod drucker_prager_path;
#[allow(dead_code, reason = "its main is for people")]
#[path = "../../../examples/embedding-bare/examples/gamma_of_a_mesh.rs"]
mod gamma_of_a_mesh;
#[allow(dead_code, reason = "its main is for people")]
#[path = "../../../examples/embedding/examples/helmholtz_on_neighbours.rs"]
mod helmholtz_on_neighbours;
#[allow(dead_code, reason = "its main is for people")]
#[path = "../../../examples/embedding-bare/examples/kernel_on_slices.rs"]
mod kernel_on_slices;
#[allow(dead_code, reason = "its main is for people")]
#[path = "../../../examples/embedding/examples/scene_in_memory.rs"]
mod scene_in_memory;

use sph_rheology::Elastic;
use sph_tests::{near, within};

/// Most lines of an example.
const PAGE: usize = 60;

#[test]
fn every_example_is_a_page() {
    let folder = |name| format!("{}/../examples/{name}/examples", env!("CARGO_MANIFEST_DIR"));
    let listed = |name| std::fs::read_dir(folder(name)).expect("a folder");
    let mut count = 0;
    for entry in listed("embedding").chain(listed("embedding-bare")) {
        let path = entry.expect("an entry").path();
        let text = std::fs::read_to_string(&path).expect("a source");
        let lines = text.lines().count();
        assert!(lines <= PAGE, "{}: {lines} lines", path.display());
        count += 1;
    }
    assert_eq!(count, 5);
}

#[test]
fn gamma_is_1_inside_and_halves_with_every_wall() {
    let points = [[0.5; 3], [0.5, 0.5, 0.0], [0.5, 0.0, 0.0], [0.0; 3]];
    let found = gamma_of_a_mesh::gammas(&points).expect("a closed mesh");
    for (gamma, exact) in found.iter().zip([1.0, 0.5, 0.25, 0.125]) {
        assert!((gamma - exact).abs() < 1e-9, "{gamma} {exact}");
    }
}

/// The sum over a lattice misses the integral by the kernel's Fourier transform at the lattice's wave number.
#[test]
fn a_lattice_has_its_density_within_3_per_mille() {
    for name in [
        "wendland-c2",
        "wendland-c4",
        "cubic-spline",
        "quintic-spline",
    ] {
        let density = kernel_on_slices::lattice_density(name, 0.01, 2.0).expect("built in");
        assert!((density / 1000.0 - 1.0).abs() < 3e-3, "{name}: {density}");
    }
    assert!(kernel_on_slices::lattice_density("square", 0.01, 2.0).is_none());
}

#[test]
fn a_soil_is_elastic_then_yields_to_and_fro() {
    let law = drucker_prager_path::pellets();
    let path = drucker_prager_path::cycle(&law, 1000.0, 900);
    let [strain, stress] = path[10];
    near(stress, law.shear_modulus() * strain, 1e-4, "Pa");
    let limit = law.yield_stress(1000.0);
    near(path[299][1], limit, 1e-3, "Pa");
    near(path[899][1], -limit, 1e-3, "Pa");
    // Unloading is elastic again: two yield strains from one limit to the other.
    let [before, after] = [path[299], path[350]];
    let slope = (after[1] - before[1]) / (after[0] - before[0]);
    assert!((slope / law.shear_modulus() - 1.0).abs() < 1e-2, "{slope}");
}

/// With a kernel that widens with the spacing both errors fall with its square.
#[test]
fn helmholtz_is_solved_to_second_order() {
    let [coarse, fine] = [16, 32].map(|n| helmholtz_on_neighbours::error(n).expect("solved"));
    let order = (coarse / fine).log2();
    println!("errors {coarse:.2e} {fine:.2e}, order {order:.2}");
    within(order, 1.8..2.2, "order");
}

#[test]
fn a_drop_falls_as_newton_says() {
    let [height, velocity] = scene_in_memory::fall(0.1).expect("a good scene");
    assert!((velocity + 0.981).abs() < 1e-9, "{velocity} m/s");
    // Symplectic steps are of first order in the place: half a step times the velocity.
    assert!((height + 0.04905).abs() < 2e-4, "{height} m");
}

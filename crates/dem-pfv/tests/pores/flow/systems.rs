//! The linear system: solvers, sources, conditions, rotated rooms.

use dem_pfv::flow::{Boundary, FlowSystem, PoreGeometry, SlipCondition, SolidAngles, Solver};
use dem_pfv::triangulation::{Sphere, Triangulation, Vertex, Wall};
use nalgebra::{Rotation3, Vector3};

use crate::flow::{direct, drop_along_y, hydraulic, most_apart, packed, permeameter};
use crate::{BOX25, BOX200, assert_says, close, spheres};

#[test]
fn conjugate_gradients_find_the_pressures_of_the_factorisation() {
    let geometry = packed(BOX200);
    let boundary = drop_along_y(&geometry);
    let iterate = |limit: usize| Solver::ConjugateGradient {
        tolerance: 1e-13,
        limit,
    };
    let solve = |solver: Solver| {
        let system = FlowSystem::new(&geometry, &boundary, &hydraulic(), 1.0, None, solver);
        system.expect("a system").solve(&boundary, &[])
    };
    let solvers = [Solver::Direct, iterate(5000), Solver::Automatic];
    let [direct, iterated, automatic] = solvers.map(|s| solve(s).expect("pressures"));
    let difference = most_apart(&direct, &iterated);
    println!("largest difference {difference:e} Pa");
    assert!(difference < 1e-9, "{difference:e} Pa");
    assert_eq!(direct, automatic);
    assert_says(
        solve(iterate(3)).expect_err("too few"),
        "after 3 iterations",
    );
}

/// A source at i raises the pressure at j as one at j raises that at i: the matrix is symmetric. What is let in goes
/// out where a pressure is given.
#[test]
fn sources_are_reciprocal_and_conserved() {
    let geometry = packed(BOX25);
    let mut bottom = Boundary::closed(&geometry);
    bottom.pressure(&geometry, 2, |_| Some(0.0));
    let mut system = direct(&geometry, &bottom, None);
    let upper = |c: &usize| geometry.centres[*c].y > 0.5;
    let free: Vec<_> = (0..geometry.volumes.len()).filter(upper).collect();
    let (i, j) = (free[3], free[20]);
    let mut pressure_at = |source: usize, cell: usize| {
        let mut boundary = bottom.clone();
        boundary.source(source, 2.5);
        let pressures = system.solve(&boundary, &[]).expect("pressures");
        close(system.inflow(&geometry, 2, &pressures) / -2.5, 1.0, 1e-12);
        pressures[cell]
    };
    let (a, b) = (pressure_at(i, j), pressure_at(j, i));
    assert!(a > 0.0 && (a / b - 1.0).abs() < 1e-12, "{a} and {b} Pa");
}

/// An even inflow through half of a wall is what comes out on the other side; its area is counted by cells.
#[test]
fn inflow_through_a_part_of_a_wall_comes_out() {
    let geometry = packed(BOX200);
    let mut boundary = Boundary::closed(&geometry);
    boundary.pressure(&geometry, 2, |x| (x.x < 0.5).then_some(3.0));
    let total = boundary.inflow(&geometry, 3, 0.1, |x| x.x > 0.5);
    close(total, 0.05, 0.01);
    let whole = boundary.clone().inflow(&geometry, 3, 0.1, |_| true);
    close(whole, 0.1, 1e-13);
    let mut system = direct(&geometry, &boundary, None);
    let pressures = system.solve(&boundary, &[]).expect("pressures");
    close(system.inflow(&geometry, 2, &pressures) / -total, 1.0, 1e-11);
}

/// A piston that comes in at v presses out v S: shrinking pores are sources, and their pressures rise.
#[test]
fn shrinking_pores_press_fluid_out() {
    let geometry = packed(BOX200);
    let mut boundary = Boundary::closed(&geometry);
    boundary.pressure(&geometry, 2, |_| Some(0.0));
    let step = 1e-3;
    let pressed = Vector3::new(1.0, 1.0 - 1e-3, 1.0);
    let centres = geometry.mesh.spheres.iter();
    let centres: Vec<_> = centres.map(|s| s.centre.component_mul(&pressed)).collect();
    let mut walls = geometry.mesh.walls.to_vec();
    walls[3].offset = -0.999;
    let after = dem_pfv::flow::cell_volumes(&geometry.mesh, &centres, &walls);
    let rates = after.iter().zip(&geometry.volumes);
    let rates: Vec<_> = rates.map(|(b, a)| (b - a) / step).collect();
    let mut system = direct(&geometry, &boundary, None);
    let pressures = system.solve(&boundary, &rates).expect("pressures");
    let on_wall = geometry.mesh.cells_around(Vertex::Wall(2));
    let inner = rates.iter().zip(0..).filter(|(_, c)| !on_wall.contains(c));
    let drained: f64 = inner.map(|(rate, _)| rate).sum();
    close(
        system.inflow(&geometry, 2, &pressures) / drained,
        1.0,
        1e-11,
    );
    close(rates.iter().sum(), -1.0, 1e-10);
    assert!(pressures.iter().all(|p| *p >= 0.0));
}

/// A box that stands on no axis has the permeability of one that does.
#[test]
fn a_turned_box_is_as_permeable() {
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    let turned = spheres(BOX25).into_iter().map(|s| Sphere {
        centre: turn * s.centre,
        ..s
    });
    let turned: Vec<_> = turned.collect();
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| Wall {
        normal: turn * w.normal,
        ..w
    });
    let mesh = Triangulation::within(&turned, &walls).expect("cells");
    let turned = PoreGeometry::new(mesh, &[SlipCondition::NoSlip; 6], SolidAngles::Signed);
    let kappa = |pores: &PoreGeometry| permeameter(pores, &hydraulic()).kappa;
    close(
        kappa(&turned.expect("pores")) / kappa(&packed(BOX25)),
        1.0,
        1e-11,
    );
}

/// Twice the viscosity, half the flux; pressures and forces stay.
#[test]
fn viscosity_scales_fluxes_alone() {
    let geometry = packed(BOX25);
    let boundary = drop_along_y(&geometry);
    let run = |viscosity: f64| {
        let (law, solver) = (hydraulic(), Solver::Direct);
        let system = FlowSystem::new(&geometry, &boundary, &law, viscosity, None, solver);
        let mut system = system.expect("a system");
        let pressures = system.solve(&boundary, &[]).expect("pressures");
        let inflow = system.inflow(&geometry, 3, &pressures);
        (pressures, inflow)
    };
    let ((p, q), (p2, q2)) = (run(1e-3), run(2e-3));
    close(q / q2, 2.0, 1e-12);
    assert!(most_apart(&p, &p2) < 1e-12);
}

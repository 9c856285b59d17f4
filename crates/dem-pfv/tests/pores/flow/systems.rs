//! The linear system: solvers, sources, conditions, rotated rooms.

use dem_pfv::flow::{Boundary, FlowSystem, PoreGeometry, SlipCondition, SolidAngles, Solver};
use dem_pfv::triangulation::{Sphere, Triangulation, Wall};
use nalgebra::{Rotation3, Vector3};

use crate::flow::{BOX25, BOX200, drop_along_y, geometry, hydraulic, permeameter, spheres};

fn system(geometry: &PoreGeometry, boundary: &Boundary, solver: Solver) -> FlowSystem {
    FlowSystem::new(geometry, boundary, &hydraulic(), 1.0, None, solver).expect("a system")
}

#[test]
fn conjugate_gradients_find_the_pressures_of_the_factorisation() {
    let geometry = geometry(&spheres(BOX200), SlipCondition::NoSlip, SolidAngles::Signed);
    let boundary = drop_along_y(&geometry);
    let iterate = Solver::ConjugateGradient {
        tolerance: 1e-13,
        limit: 5000,
    };
    let solve = |s: Solver| {
        system(&geometry, &boundary, s)
            .solve(&boundary, &[])
            .expect("pressures")
    };
    let (direct, iterated, automatic) = (
        solve(Solver::Direct),
        solve(iterate),
        solve(Solver::Automatic),
    );
    let difference = direct
        .iter()
        .zip(&iterated)
        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    println!("largest difference {difference:e} Pa");
    assert!(difference < 1e-9, "largest difference {difference:e} Pa");
    assert_eq!(direct, automatic);
    let few = Solver::ConjugateGradient {
        tolerance: 1e-13,
        limit: 3,
    };
    let error = system(&geometry, &boundary, few)
        .solve(&boundary, &[])
        .expect_err("too few");
    assert!(error.to_string().contains("after 3 iterations"), "{error}");
}

/// A source at i raises the pressure at j as one at j raises that at i: the matrix is symmetric. What is let in goes
/// out where a pressure is given.
#[test]
fn sources_are_reciprocal_and_conserved() {
    let geometry = geometry(&spheres(BOX25), SlipCondition::NoSlip, SolidAngles::Signed);
    let mut bottom = Boundary::closed(&geometry);
    bottom.pressure(&geometry, 2, |_| Some(0.0));
    let mut system = system(&geometry, &bottom, Solver::Direct);
    let free: Vec<_> = (0..geometry.volumes.len())
        .filter(|c| geometry.centres[*c].y > 0.5)
        .collect();
    let (i, j) = (free[3], free[20]);
    let mut pressure_at = |source: usize, cell: usize| {
        let mut boundary = bottom.clone();
        boundary.source(source, 2.5);
        let pressures = system.solve(&boundary, &[]).expect("pressures");
        let out = -system.inflow(&geometry, 2, &pressures);
        assert!((out / 2.5 - 1.0).abs() < 1e-12, "{out} m³/s");
        pressures[cell]
    };
    let (a, b) = (pressure_at(i, j), pressure_at(j, i));
    assert!(a > 0.0 && (a / b - 1.0).abs() < 1e-12, "{a} and {b} Pa");
}

/// An even inflow through half of a wall is what comes out on the other side; its area is counted by cells.
#[test]
fn inflow_through_a_part_of_a_wall_comes_out() {
    let geometry = geometry(&spheres(BOX200), SlipCondition::NoSlip, SolidAngles::Signed);
    let mut boundary = Boundary::closed(&geometry);
    boundary.pressure(&geometry, 2, |x| (x.x < 0.5).then_some(3.0));
    let total = boundary.inflow(&geometry, 3, 0.1, |x| x.x > 0.5);
    assert!(
        (total - 0.05).abs() < 0.01,
        "{total} m³/s of half a wall of 1 m²"
    );
    let whole = boundary.clone().inflow(&geometry, 3, 0.1, |_| true);
    assert!((whole - 0.1).abs() < 1e-13, "{whole} m³/s");
    let mut system = system(&geometry, &boundary, Solver::Direct);
    let pressures = system.solve(&boundary, &[]).expect("pressures");
    let out = -system.inflow(&geometry, 2, &pressures);
    assert!((out / total - 1.0).abs() < 1e-11, "{out} of {total} m³/s");
}

/// A piston that comes in at v presses out v S: shrinking pores are sources, and their pressures rise.
#[test]
fn shrinking_pores_press_fluid_out() {
    let geometry = geometry(&spheres(BOX200), SlipCondition::NoSlip, SolidAngles::Signed);
    let mut boundary = Boundary::closed(&geometry);
    boundary.pressure(&geometry, 2, |_| Some(0.0));
    let step = 1e-3;
    let centres = geometry
        .mesh
        .spheres
        .iter()
        .map(|s| Vector3::new(s.centre.x, s.centre.y * (1.0 - 1e-3), s.centre.z));
    let centres: Vec<_> = centres.collect();
    let mut walls = geometry.mesh.walls.to_vec();
    walls[3].offset = -0.999;
    let after = dem_pfv::flow::cell_volumes(&geometry.mesh, &centres, &walls);
    let rates: Vec<_> = after
        .iter()
        .zip(&geometry.volumes)
        .map(|(b, a)| (b - a) / step)
        .collect();
    let mut system = system(&geometry, &boundary, Solver::Direct);
    let pressures = system.solve(&boundary, &rates).expect("pressures");
    let drained: f64 = rates
        .iter()
        .zip(&boundary_cells(&geometry))
        .filter(|(_, b)| !**b)
        .map(|(r, _)| r)
        .sum();
    let out = -system.inflow(&geometry, 2, &pressures);
    assert!(
        (out / -drained - 1.0).abs() < 1e-11,
        "{out} of {} m³/s",
        -drained
    );
    assert!((rates.iter().sum::<f64>() + 1.0).abs() < 1e-10);
    assert!(pressures.iter().all(|p| *p >= 0.0));
}

fn boundary_cells(geometry: &PoreGeometry) -> Vec<bool> {
    let around = geometry
        .mesh
        .cells_around(dem_pfv::triangulation::Vertex::Wall(2));
    let mut on = vec![false; geometry.volumes.len()];
    around.iter().for_each(|c| on[*c as usize] = true);
    on
}

/// A box that stands on no axis has the permeability of one that does.
#[test]
fn a_turned_box_is_as_permeable() {
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    let spheres = spheres(BOX25);
    let turned: Vec<_> = spheres
        .iter()
        .map(|s| Sphere {
            centre: turn * s.centre,
            radius: s.radius,
        })
        .collect();
    let walls = Wall::cuboid([0.0; 3], [1.0; 3]).map(|w| Wall {
        normal: turn * w.normal,
        offset: w.offset,
    });
    let mesh = Triangulation::within(&turned, &walls).expect("cells");
    let turned =
        PoreGeometry::new(mesh, &[SlipCondition::NoSlip; 6], SolidAngles::Signed).expect("pores");
    let straight = geometry(&spheres, SlipCondition::NoSlip, SolidAngles::Signed);
    let ratio =
        permeameter(&turned, &hydraulic()).kappa / permeameter(&straight, &hydraulic()).kappa;
    assert!((ratio - 1.0).abs() < 1e-11, "{ratio}");
}

/// Twice the viscosity, half the flux; pressures and forces stay.
#[test]
fn viscosity_scales_fluxes_alone() {
    let geometry = geometry(&spheres(BOX25), SlipCondition::NoSlip, SolidAngles::Signed);
    let boundary = drop_along_y(&geometry);
    let run = |viscosity: f64| {
        let mut system = FlowSystem::new(
            &geometry,
            &boundary,
            &hydraulic(),
            viscosity,
            None,
            Solver::Direct,
        )
        .expect("a system");
        let pressures = system.solve(&boundary, &[]).expect("pressures");
        let inflow = system.inflow(&geometry, 3, &pressures);
        (pressures, inflow)
    };
    let ((p, q), (p2, q2)) = (run(1e-3), run(2e-3));
    assert!((q / q2 - 2.0).abs() < 1e-12);
    assert!(p.iter().zip(&p2).all(|(a, b)| (a - b).abs() < 1e-12));
}

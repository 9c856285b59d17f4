//! Mirror images beside walls and under a surface, with many sets of plugins: a tank in turmoil, fifty steps of a fixed Δt.

use sph_core::fields;

use crate::invariants::{States, fly, shipped, states};

/// Each with what it takes the place of in `hydrostatic-tank`.
const PLUGINS: [&str; 8] = [
    "shifting.fickian={}",
    "walls.dummy-particles={} shifting.fickian={}",
    "walls.usaw.vertices=false smoother={} smoother.delta-sph={}",
    "smoother={} smoother.delta-msph={} formulation.krimi={}",
    "smoother={} smoother.rhie-chow={} formulation.grenier={}",
    "formulation.colagrossi-landrini={} viscous-operator.hu-adams={}",
    "viscous-operator.monaghan-gingold={} integrator.verlet={}",
    "viscous-operator.espanol-revenga={} wall.tank.condition=free-slip",
];

/// The state after fifty steps; turned over at x = 1 m before and after if it is to be `mirrored`.
fn flown(plugins: &str, mirrored: bool) -> States {
    let base = "numerics.spacing=0.1 numerics.jitter=0.2 numerics.velocity_noise=0.3";
    let mut parts = shipped("hydrostatic-tank", &[base, plugins]);
    if mirrored {
        let free = &mut parts.flow.world.free;
        for x in free.get_mut(fields::POSITION).unwrap() {
            x[0] = 2.0 - x[0];
        }
        for u in free.get_mut(fields::VELOCITY).unwrap() {
            u[0] = -u[0];
        }
        parts.flow.world.rebuild_lists().unwrap();
    }
    fly(&mut parts, 50, Some(0.001));
    let mut end = states(&parts);
    if mirrored {
        for (x, u) in &mut end {
            (x[0], u[0]) = (2.0 - x[0], -u[0]);
        }
    }
    end
}

#[test]
fn a_tank_in_turmoil_has_the_mirror_image_of_its_mirror_image_with_every_plugin() {
    for plugins in PLUGINS {
        let (plain, image) = (flown(plugins, false), flown(plugins, true));
        assert_eq!(plain.len(), image.len());
        let most = plain.iter().zip(&image);
        let most = most.fold(0.0, |most: f64, (a, b)| most.max((a.1 - b.1).norm()));
        let fastest = plain.iter().map(|(_, u)| u.norm()).fold(0.0, f64::max);
        assert!(fastest > 0.1, "{plugins}: it stands still");
        // Pressures of ρc² times a rounding of 1e-16 over h are 5e-13 m/s² here; γ is good to 4e-14, which is a hundred times
        // that, and fifty steps may double it a few times.
        assert!(most < 1e-10, "{plugins}: {most:e} m/s");
    }
}

//! Outlets, smoothers under other accelerations than gravity, and energy that rises.

use sph_tests::{Says, Series, near};

use crate::Field;

/// Sum of the energies in every row, J.
fn energies(series: &Series) -> Vec<f64> {
    let of = |name: &str| series.column(name);
    let parts = ["kinetic", "potential", "internal"].map(|k| of(&format!("{k}_energy")));
    (0..series.rows())
        .map(|k| parts.iter().map(|p| p[k]).sum())
        .collect()
}

#[test]
fn a_block_falls_through_an_outlet_as_if_nobody_had_left() {
    // The last row falls 0.4 m from 1 m/s; sideways nothing falls, and all go on with 1 m/s.
    let falls = (1.0f64 + 2.0 * 9.81 * 0.4).sqrt();
    let plane = "--set run.end=0.19";
    let as_box = "--set outlet.below={box=[[-0.5,-0.6],[0.5,-0.1]]} --set outlet.more={box=[[-0.5,-0.9],[0.5,-0.7]]}";
    let rates = "--set formulation.colagrossi-landrini={}";
    let along_x = "--set numerics.gravity=[0,0] --set outlet.below={axis=\"x\",beyond=0.04} \
                   --set body.water.velocity=[1,0] --set run.end=0.055";
    for (more, fastest) in [
        (plane, falls),
        (as_box, falls),
        (rates, falls),
        (along_x, 1.0),
    ] {
        let field = Field::new();
        field.ran("outlet-fall", more);
        let (series, summary) = (field.series(), field.summary());
        let most = series.largest("largest_speed");
        assert!(most < 1.005 * fastest, "{more}: {most} m/s");
        let range = &summary["density_range"];
        let [least, largest] = [0, 1].map(|k| range[k].as_f64().expect("a density"));
        assert!(least > 0.99 && largest < 1.01, "{more}: {range}");
        let left = summary["left"]["outlet.below.water"]["particles"].as_u64();
        assert!(left > Some(50), "{more}: {left:?} have left");
    }
}

#[test]
fn a_run_goes_on_when_all_have_left() {
    let field = Field::new();
    assert_eq!(field.run("outlet-fall", "").code, Some(0));
    let summary = field.summary();
    assert_eq!(summary["status"], "done");
    assert_eq!(summary["particles"], 0);
    let left = summary["left"]["outlet.below.water"]["mass"]
        .as_f64()
        .expect("a mass");
    // ρ times 7 by 59 cells of 5 mm.
    assert!((left / 10.325 - 1.0).abs() < 1e-12, "{left} kg/m");
    summary["warnings"].says("all particles have left");
}

/// 900 kg/m³ times 1 m/s² times 0.6 m, to either side.
#[test]
fn a_tank_that_is_accelerated_has_the_whole_pressure_between_its_ends() {
    let coarse = "--set numerics.spacing=0.02";
    let back = "--set wall.tank.motion.translate.along=[-1,0] --set numerics.domain=[[-5.5,-0.3],[1.1,1.0]]";
    let rhie = "--set smoother={} --set smoother.rhie-chow={}";
    for (more, asked) in [("", 540.0), (back, -540.0), (rhie, 540.0)] {
        let field = Field::new();
        let series = field.ran("shake-probe", &format!("{coarse} {more}"));
        let found = series.mean("pl", 2.0) - series.mean("pr", 2.0);
        near(found, asked, 0.02, &format!("{more}, Pa"));
    }
}

/// Over 0.34 m of height there are 3 kPa at rest, and none in the fall.
#[test]
fn a_tank_that_falls_freely_has_no_pressure() {
    let field = Field::new();
    let series = field.ran("fall-tank", "");
    let found = series.mean("bottom", 0.3) - series.mean("top", 0.3);
    let at_rest = 900.0 * 9.81 * 0.34;
    assert!(found.abs() < 0.005 * at_rest, "{found} Pa of {at_rest} Pa");
}

/// ½ρω²r² between the middle and 80 mm, with the ω that the syrup has.
#[test]
fn fluid_in_a_rotating_box_has_the_pressure_of_the_rotation() {
    let field = Field::new();
    let series = field.ran("spun-box", "");
    let side: f64 = ["left", "right", "up"]
        .map(|p| series.mean(p, 0.6))
        .iter()
        .sum();
    let found = side / 3.0 - series.mean("middle", 0.6);
    // Of the square, ρL⁴/6.
    let omega = series.mean("spin", 0.6) / (1000.0 * 0.2f64.powi(4) / 6.0);
    let asked = 0.5 * 1000.0 * (omega * 0.08).powi(2);
    near(found, asked, 0.05, "Pa");
}

#[test]
fn layers_that_change_places_in_a_closed_box_gain_no_energy() {
    let coarse = "--set numerics.spacing=0.02";
    for more in [
        "",
        "--set phase.fresh.density=1050",
        "--set smoother={} --set smoother.brezzi-pitkaranta={}",
    ] {
        let field = Field::new();
        field.ran("lock-exchange", &format!("{coarse} {more}"));
        let (series, summary) = (field.series(), field.summary());
        let all = energies(&series);
        let most = all.iter().fold(all[0], |m, e| m.max(*e));
        assert!(most - all[0] < 1e-3 * all[0], "{more}: {most} J");
        // What moves has come down: 5 % of the weight of half the box over half its height at most.
        let most = series.largest("kinetic_energy");
        let released = 50.0 * 9.81 * 0.12 * 0.05;
        assert!(most < released, "{more}: {most} J of {released} J");
        summary["warnings"].lacks("energy");
    }
}

/// Equal waters without a smoother: sound that walls feed.
#[test]
fn a_closed_box_that_makes_energy_says_so_and_has_no_result() {
    let field = Field::new();
    let none = "--set smoother.rhie-chow.strength=0 --set phase.salt.density=1000 --set numerics.spacing=0.02";
    let failed = field.failed(&format!("run lock-exchange.toml --out r {none}"));
    (failed.out + &failed.err).says("warning: at t = ");
    let summary = field.summary();
    assert_eq!(summary["status"], "failed");
    summary["warnings"].says("without a drive");
    summary["advice"].says("energy-budget");
}

//! Soils whose pores drain, against closed forms.

use crate::shipped::finished;
use sph_tests::near;

/// The fluid that is left out weighs nothing, so that the mass of the run stays.
const LEFT_OUT: &str = "pore-pressure.darcy.fluid_density=0";

#[test]
fn a_loaded_column_consolidates_as_terzaghi_says() {
    let run = finished("terzaghi-column", &[LEFT_OUT]);
    run.error("degree", 0.02, 0.0019);
    run.error("profile", 0.02, 0.0086);
}

/// p_e = −E K (φ − φ_c) γ with E = 40 kPa, K = 4, a packing 0.02 off and a shear of 0.1.
#[test]
fn sealed_soils_pull_and_push_at_their_water() {
    for (porosity, exact) in [(0.40, -320.0), (0.44, 320.0)] {
        let porosity = format!("pore-pressure.darcy.porosity={porosity}");
        let run = finished("undrained-shear", &[&porosity]);
        let found = run.last("excess");
        near(found, exact, 0.03, "Pa, measured 319.7");
    }
}

/// The mean weight of the grains falls along a line to zero at i_c = (1 − n)(s − 1), at 0.97119 s.
#[test]
fn a_bed_floats_at_its_critical_gradient() {
    let run = finished("critical-gradient", &[LEFT_OUT]);
    run.error("weight", 0.01, 0.0049);
    let (time, weight) = (run.column("time"), run.column("grains.mean"));
    let at = |t: f64| time.iter().position(|x| *x >= t).expect("a row");
    let (a, b) = (at(0.2), at(0.8));
    let fall = (weight[a] - weight[b]) / (time[b] - time[a]);
    let floats = time[b] + weight[b] / fall;
    near(floats, 0.97119, 0.01, "s, measured 0.962");
}

/// Ten rows: the fluid bears the weight of loose grains, 1289 Pa in the layer, and dense ones suck at it.
#[test]
fn a_wave_liquefies_a_loose_bed_and_a_dense_one_stands() {
    let share = |changes: &[&str]| {
        let coarse = ["numerics.spacing=0.1", "run.end=4", "reference={}"];
        let run = finished("wave-over-sand", &[&coarse[..], changes].concat());
        run.last("grains") / run.column("grains")[0]
    };
    let loose = share(&[]);
    assert!(loose < 0.05, "{loose} of its weight, 0.029 was measured");
    let dense = share(&["pore-pressure.darcy.porosity=0.40 phase.sand.density=1240"]);
    assert!(dense > 1.0, "{dense} of its weight, 1.5 was measured");
}

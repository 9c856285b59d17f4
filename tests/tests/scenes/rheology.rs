//! Laws with a yield stress, elastic soils and effective pressures.

use crate::shipped::finished;
use sph_particles::Solves;
use sph_tests::{below, close, near, within};

/// Times at which a column crosses zero.
fn crossings(time: &[f64], value: &[f64]) -> Vec<f64> {
    let pairs = time.windows(2).zip(value.windows(2));
    let crossed = pairs.filter(|(_, v)| v[0] * v[1] < 0.0);
    let place = |(t, v): (&[f64], &[f64])| t[0] + v[0] / (v[0] - v[1]) * (t[1] - t[0]);
    crossed.map(place).collect()
}

/// A channel of 48 spacings instead of 97.
const COARSE: [&str; 1] = [
    "numerics.spacing=0.020833333333333332 numerics.periodic.x=[0,0.3333333333333333] \
     wall.bottom.polyline=[[0,-0.5],[0.3333333333333333,-0.5]] \
     wall.top.polyline=[[0.3333333333333333,0.5],[0,0.5]] \
     body.channel.box=[[0,-0.5],[0.3333333333333333,0.5]]",
];

#[test]
fn a_bingham_channel_meets_its_profile_and_with_a_sharp_law_the_ideal_one() {
    let name = "bingham-poiseuille-bn0p1";
    let soft = finished(name, &COARSE);
    // A wall is known to half a spacing, and where a plug ends shear sets in between two rows.
    let half_a_spacing = 0.5 / 48.0;
    soft.error("profile", half_a_spacing, 4.09e-3);
    let sharp = "phase.mud.rheology.bingham.regularisation.papanastasiou.stress_growth=1000";
    let sharp = finished(name, &[&COARSE[..], &[sharp]].concat());
    sharp.error("ideal", half_a_spacing, 4.09e-3);
    let solves = sharp.summary.counted::<Solves>("implicit_viscosity");
    let solves = solves.and_then(|s| s.outer);
    let outer = solves.expect("the viscosity follows the velocity");
    assert_eq!(outer.unconverged, 0, "{outer:?}");
}

/// 6.5 % too weak with 24 spacings across, 3.8 % with the scene's 64.
#[test]
fn the_vortex_of_a_bingham_cavity_has_its_strength() {
    let run = finished("bingham-cavity", &["numerics.spacing=0.041666666666666664"]);
    // The half rows that cling to lid and floor, each twice over: first order.
    run.error("vortex", 2.0 / 24.0, 0.0653);
    let height = run.last("vortex.y");
    // 0.79 by finite differences, to half a spacing.
    close(height, 0.79, 0.5 / 24.0, "height of the vortex, m");
}

/// Steps that a viscosity at rest of 10⁶ times the plastic one would explicitly bound at 1e-8 s.
#[test]
fn a_pile_of_beads_runs_out_and_stops() {
    let run = finished("granular-pile-lajeunesse", &["numerics.spacing=0.003"]);
    let front = run.column("front");
    let run_out = |x: f64| (x - 0.102) / 0.061;
    let last = run_out(run.last("front"));
    within(last, 1.2..=1.8, "heights, measured 1.69");
    let before = run_out(front[front.len() * 4 / 5]);
    assert!(last - before < 0.05, "it went on: {before} to {last}");
    let left = run.last("kinetic_energy") / run.series().largest("kinetic_energy");
    assert!(left < 1e-4, "{left} of the energy, measured 7e-6");
}

/// With `brezzi-pitkaranta`, whose strength is in proportion to the step, it falls from 1.19 to 0.91.
#[test]
fn the_run_out_of_a_pile_does_not_depend_on_the_step() {
    let coarse = ["numerics.spacing=0.004", "run.end=0.24", "reference={}"];
    let front = |courant: &str| {
        let overrides = [&coarse[..], &[courant]].concat();
        let run = finished("granular-pile-lajeunesse", &overrides);
        (run.last("front") - 0.102) / 0.061
    };
    let whole = front("integrator.symplectic-euler.courant=0.4");
    let half = front("integrator.symplectic-euler.courant=0.2");
    let half_a_spacing = 0.5 * 0.004 / 0.061;
    close(whole, half, half_a_spacing, "heights, measured 1.26");
}

/// The jitter of the source, by which its deposit creeps, is damped.
#[test]
fn a_collapsed_column_lies_still_where_the_experiment_does() {
    let run = finished(
        "soil-collapse-bui",
        &["numerics.spacing=0.005", "run.end=0.9"],
    );
    let [surface, failure] = ["surface.rms", "failure.rms"].map(|c| run.last(c));
    // A spacing and the bars of the experiment, 1 and 1.5 mm thick: one at a surface, on either side of a line of failure one of
    // the thick ones.
    let (spacing, thin, thick) = (5e-3, 1e-3, 1.5e-3);
    below(surface, spacing + thin, "m, measured 0.0020");
    below(failure, spacing + 2.0 * thick, "m, measured 0.0072");
    let front = run.column("front");
    let last = front.len() - 1;
    let crept = front[last] - front[last - 10];
    assert!(crept < 1e-3, "{crept} m in 0.1 s, measured 1.4e-6");
    let left = run.last("kinetic_energy") / run.series().largest("kinetic_energy");
    assert!(left < 1e-4, "{left} of the energy, measured 5.8e-5");
}

#[test]
fn a_shear_wave_keeps_its_frequency_within_2_per_cent_and_its_energy() {
    let run = finished("elastic-shear-wave", &[]);
    let (time, crest) = (run.column("time"), run.column("crest.x"));
    let zeros = crossings(&time, &crest);
    let half_periods = (zeros.len() - 1) as f64;
    let period = 2.0 * (zeros[zeros.len() - 1] - zeros[0]) / half_periods;
    // 1.4 % too slow with 40 particles per wavelength: nested differences see sin(kx) smoothed twice, each time by the transform of
    // the kernel, 1 − k²σ²/2 with σ² = (5/18) h² of Wendland C2 and kh = 4π/40. A frequency has one of the two factors.
    let kh = std::f64::consts::TAU * 2.0 / 40.0;
    let seen = 1.0 - kh * kh * (5.0 / 18.0) / 2.0;
    // The next term of the transform, k⁴σ⁴/8, and a thousandth for steps and samples.
    let budget = (kh * kh * (5.0 / 18.0)).powi(2) / 8.0 + 1e-3;
    near(period * seen, 0.1, budget, "s");
    let energy = run.column("energy");
    let largest = |rows: &[f64]| rows.iter().copied().fold(0.0, f64::max);
    let loss = 1.0 - largest(&energy[energy.len() * 4 / 5..]) / energy[0];
    below(loss, 0.01, "energy lost, measured 0.003");
    // Where nothing moves all of it is elastic.
    let elastic = run.column("internal_energy");
    let stored = largest(&elastic) / energy[0];
    close(stored, 1.0, 0.01, "share stored, measured 1.001");
}

#[test]
fn effective_pressure_is_the_buoyant_weight_whatever_the_depth_of_the_water() {
    let deep = "body.water.box=[[0.0,0.1],[0.1,0.5]]";
    let largest = |overrides: &[&str]| {
        let short = [&["run.end=0.02"][..], overrides].concat();
        let run = finished("saturated-bed-at-rest", &short);
        run.last("bottom.max")
    };
    let [shallow, deep] = [largest(&[]), largest(&[deep])];
    // The lowest row lies 0.0975 m below the surface of the bed.
    let weight = 992.0 * 9.81 * 0.0975;
    near(shallow, weight, 0.01, "Pa");
    near(deep, shallow, 1e-3, "Pa under 0.4 m and 0.1 m");
}

#[test]
fn a_bed_at_rest_has_level_lines_and_the_weight_of_the_water_in_its_pores() {
    let run = finished("saturated-bed-at-rest", &["run.end=0.02"]);
    // The surface of the water is known to half a spacing of 5 mm, and a pressure at rest to 1 % (`hydrostatic-tank`).
    run.error("pore", 0.5 * 0.005 / 0.2 + 0.01, 0.0136);
    assert!(run.column("lines.moving").iter().all(|m| *m == 0.0));
    for output in ["0000", "0001"] {
        let name = format!("curves/lines_{output}.csv");
        let table = sph_io::read_table(run.path(&name)).unwrap_or_else(|e| panic!("{e}"));
        // A row for two of 20 columns; a particle on the bound of the period makes another one.
        let rows = table.rows();
        assert!((10..=12).contains(&rows), "{name}: {rows} rows");
        // The rows of usaw stand at whole spacings over the floor, at 5 mm.
        for (curve, exact) in [("surface", 0.2), ("interface", 0.1), ("limit", 0.1)] {
            let heights = table.column(curve).unwrap_or_else(|| panic!("no {curve}"));
            let apart = |most: f64, y: &f64| most.max((y - exact).abs());
            let apart = heights.iter().fold(0.0, apart);
            assert!(apart < 0.003, "{name}: {curve} is {apart} m off {exact} m");
        }
    }
}

#[test]
fn a_slope_stands_below_the_angle_of_its_cone_and_slides_above_it() {
    let coarse = ["numerics.spacing=0.01", "run.end=0.6"];
    let standing = finished("infinite-slope", &coarse);
    let top = standing.column("top.x");
    let speed = top
        .iter()
        .rev()
        .take(10)
        .fold(0.0_f64, |m, u| m.max(u.abs()));
    assert!(speed < 1e-3, "28°: {speed} m/s, measured 1e-4");
    // The sums of the two rows within h of the surface are cut off, of 20: 13 % too fast with 10 rows, 9 % with 20.
    let steep = ["numerics.gravity=[0,-7.515] numerics.driving=[6.306,0] run.end=0.6"];
    let sliding = finished("infinite-slope", &steep);
    let (time, top) = (sliding.column("time"), sliding.column("top.x"));
    let (half, last) = (time.len() / 2, time.len() - 1);
    let acceleration = (top[last] - top[half]) / (time[last] - time[half]);
    near(acceleration, 1.099, 2.0 / 20.0, "40°, m/s²");
}

/// The static bound is 7.85 depths; what is asked is 4.5 to 6.0.
#[test]
fn a_slurry_freezes_within_six_depths_of_its_gate() {
    let run = finished("bingham-dam-break", &["numerics.spacing=0.01"]);
    let (time, bulk) = (run.column("time"), run.column("bulk"));
    let depths = |t: f64| {
        let row = time.iter().position(|s| *s >= t).unwrap_or(time.len() - 1);
        (bulk[row] - 2.0) / 0.1
    };
    let [before, last] = [depths(1.9), depths(2.0)];
    assert!((4.5..6.0).contains(&last), "{last}, 4.63 was measured");
    assert!(last - before < 0.05, "it went on: {before} to {last}");
    let sunk = run.series().change("behind");
    assert!(sunk.abs() < 0.003, "behind it has sunk by {sunk} m");
}

/// A block with μ = 0.3 on the floor; the source's own form is measured beside it.
#[test]
fn a_block_on_a_rough_floor_loses_mu_g_within_3_per_cent() {
    let deceleration = |settings: &[&str]| {
        let coarse = ["numerics.spacing=0.01"];
        let run = finished("coulomb-block", &[&coarse, settings].concat());
        let (time, momentum) = (run.column("time"), run.column("momentum.x"));
        let at = |t: f64| time.iter().position(|s| *s >= t).expect("a row");
        let (first, last) = (at(0.05), at(0.25));
        let lost = (momentum[first] - momentum[last]) / momentum[0];
        lost / (time[last] - time[first]) / (0.3 * 9.81)
    };
    let normalised = deceleration(&[]);
    let off = (normalised - 1.0).abs();
    assert!(off < 0.03, "{normalised} of μg, 1.010 was measured");
    let literal = deceleration(&["wall.floor.friction_form=literal"]);
    // The kernel's share on the other side of a plane is missing from the source's sum, which is not divided by γ.
    within(literal, 0.0..normalised.min(0.5), "μg, measured 0.234");
}

/// Five rows of particles instead of eight.
#[test]
fn a_clamped_plate_swings_without_clumps() {
    let coarse = [
        "run.end=0.5 numerics.spacing=0.004 body.root.box=[[-0.022,-0.012],[0.002,0.012]] \
         body.plate.box=[[0.002,-0.012],[0.202,0.012]]",
    ];
    let run = finished("elastic-beam", &coarse);
    let (time, tip) = (run.column("time"), run.column("tip.y"));
    let zeros = crossings(&time, &tip);
    let frequency = 0.254 / (zeros[2] - zeros[0]);
    // Between a thin plate, which is the stiffest, and one that lacks half a row on either side: a frequency goes with the
    // thickness. 0.926 was measured with the scene's eight rows, 0.96 with ten.
    let rows = 5.0;
    within(frequency, 1.0 - 1.0 / rows..1.0, "measured 0.81");
    let largest = |from: f64, to: f64| {
        let rows = time
            .iter()
            .zip(&tip)
            .filter(|(t, _)| (from..to).contains(*t));
        rows.fold(0.0_f64, |most, (_, y)| most.max(y.abs()))
    };
    let kept = largest(zeros[1], 0.5) / largest(0.0, zeros[0]);
    assert!(kept > 0.97, "{kept} of the amplitude, measured 1.01");
    let densest = run.series().largest("largest_density_ratio");
    assert!(densest < 1.01, "clumps of {densest} times the density");
}

#[test]
fn a_soil_rests_below_its_friction_angle_and_slides_above_it() {
    let resting = finished("resting-slope", &["run.end=1"]);
    let crept = resting.last("surface.x") / 0.01;
    // 3° above its angle it slides ½ 0.593 m/s × 1 s, thirty spacings; a fifth of a per cent of that is rest.
    below(crept, 0.002 * 30.0, "27°: spacings, measured 0.043");
    let steep = ["numerics.gravity=[0,-8.227] numerics.driving=[5.343,0] run.end=1"];
    let sliding = finished("resting-slope", &steep);
    let speed = sliding.last("top.x");
    // Half a row of ten holds to the floor, and is not sheared.
    near(speed, 0.593, 0.5 / 10.0, "33°: m/s, measured 0.565");
}

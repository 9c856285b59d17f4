//! Scenes of grains.

use crate::Field;
use sph_tests::{close, near};

const GRAVITY: f64 = 9.81;

#[test]
fn a_grain_that_is_asked_nothing_of_falls_from_where_it_is() {
    let field = Field::new();
    let series = field.ran("one-grain", "");
    let [time, top, touching] = series.columns(["time", "top", "coordination"]);
    // From 5 cm above the floor; the leap-frog starts with a half step of gravity too much.
    let lands = (2.0 * 0.05 / GRAVITY).sqrt();
    let step = series.largest("dt");
    for (t, top) in time.iter().zip(top).filter(|(t, _)| **t < lands - step) {
        let free = 0.07 - 0.5 * GRAVITY * t * t;
        let off = (top - free).abs();
        assert!(off <= GRAVITY * lands * step, "{top} m for {free} m");
    }
    let first = touching.iter().position(|n| *n > 0.0).expect("a touch");
    // Rows are 1 ms and a step apart, and contacts are those before the last step.
    let late = time[first] - lands;
    let allowed = -step..1e-3 + 3.0 * step;
    assert!(allowed.contains(&late), "it lands {late} s late");
}

#[test]
fn one_grain_settles_to_rest_on_the_floor() {
    let field = Field::new();
    let series = field.ran("one-grain", "--set start.settle=1e-3 --set run.end=0.02");
    // The overlap m g/k, k = E R, is 2 µm; the speed is to be below a thousandth of √(g R).
    let mass = 2600.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-6;
    let most = 0.5 * mass * 1e-6 * GRAVITY * 0.01;
    let [tops, energies] = series.columns(["top", "kinetic_energy"]);
    for (top, energy) in tops.iter().zip(energies) {
        let off = top - 0.02 + mass * GRAVITY / 5e4;
        assert!(off.abs() < 1e-7, "it lies {top} m high");
        assert!(*energy <= 2.0 * most, "{energy} J");
    }
}

#[test]
fn a_cloud_is_settled_when_the_floor_carries_it() {
    let field = Field::new();
    for gravity in ["[0,0,-9.81]", "[0,0,-1.6]"] {
        let series = field.ran("cloud", &format!("--set grains.gravity={gravity}"));
        for (floor, sunk) in series.column("floor").iter().zip(series.column("sunk")) {
            close(*floor, 1.0, 0.01, "share of the weight on the floor");
            // Free fall over the run would be 2 mm, and 0.3 mm on the moon.
            assert!(sunk.abs() < 1e-5, "it sinks by {sunk} m");
        }
    }
}

#[test]
fn a_piston_in_mid_air_comes_down_before_the_start() {
    let field = Field::new();
    let lid = "--set wall.top.piston.stress=1e3 --set wall.top.piston.mass_share=0.1";
    field.ran("cloud", &format!("{lid} --set box.high=[0.1,0.1,0.3]"));
    let lid = field.series().column("lid")[0];
    near(lid, 1e3, 2e-3, "Pa on the grains");
}

/// κ of the prototype with signed solid angles, walls without slip: `noslip_signed` of the stored results.
#[test]
fn the_permeability_is_that_of_the_prototype_and_of_the_flux() {
    let field = Field::new();
    let series = field.ran("yade", "");
    let kappa = 3.4301505172198184e-05;
    let last = series.column("time").len() - 1;
    let at = |name: &str, row: usize| series.column(name)[row];
    near(at("k", 0), kappa, 1e-6, "m2");
    // Darcy: Q = κ A Δp/(µ L). At the first step nothing has moved yet.
    near(at("in", 1) * 10.0, kappa, 1e-6, "m2 by the flux");
    for row in 1..=last {
        let (into, out) = (at("in", row), at("out", row));
        near(-into, out, 1e-9, "m3/s in and out");
    }
}

#[test]
fn a_given_pressure_and_a_given_flux_show_one_permeability() {
    let field = Field::new();
    let small = "--set grains.count=200 --set grains.radius=[0.07,0.095] --set run.max_steps=1 \
                 --set probe.k.kind=permeability --set probe.k.axis=z --set probe.top.kind=flux \
                 --set probe.top.wall=top --set probe.floor.kind=flux --set probe.floor.wall=bottom";
    let layers = "--set probe.low.kind=pressure --set probe.low.axis=z --set probe.low.from=0.2 \
                  --set probe.low.to=0.4 --set probe.high.kind=pressure --set probe.high.axis=z \
                  --set probe.high.from=0.6 --set probe.high.to=0.8 --set output.series_every=1e-9";
    let kappa = ["perm", "perm-flux"].map(|input| {
        let series = field.ran(input, &format!("{small} {layers}"));
        let last = |name: &str| series.last(name);
        // Loose grains rest, too: 1e-4² F R/2 for each of 200, with 10 kPa on grains of 9 cm.
        let energy = series.column("kinetic_energy")[0];
        assert!(energy < 1e-5, "{energy} J at the start");
        let through = [last("top"), last("floor")];
        near(-through[0], through[1], 1e-9, "m3/s in and out");
        let inside = 10.0 * through[0] * 0.4 / (last("high") - last("low"));
        println!(
            "{input}: {through:?} m3/s, {:e} m2, inside {inside:e} m2",
            last("k")
        );
        [inside, last("k"), through[0]]
    });
    let [[pressed, whole, out], [fed, same, into]] = kappa;
    near(into, 1e-3, 1e-9, "m3/s");
    assert_eq!(whole, same);
    // Darcy over the whole height, under 1 Pa.
    near(-out * 10.0, whole, 1e-6, "m3/s");
    near(pressed, fed, 0.02, "m2");
}

/// A bed between smooth walls in a fluid of 1 mPa s.
const FLOODED: &str = "--set fluid.viscosity=1e-3 --set fluid.density=1000 --set wall.top.pressure=0 \
                       --set probe.fluid.kind=carried --set run.end=1e-3 --set output.series_every=1e-4 \
                       --set box.contact.linear-elastic.modulus=1e6 --set box.contact.linear-elastic.stiffness_ratio=0 \
                       --set box.contact.linear-elastic.friction=0";

#[test]
fn a_dry_bed_that_is_flooded_rests_under_its_buoyant_weight() {
    let field = Field::new();
    let start = |weight: &str| {
        let series = field.ran("cloud", &format!("{FLOODED} --set start.weight={weight}"));
        for name in ["floor", "fluid"] {
            let wanted = if name == "floor" { 1.0 } else { 0.0 };
            // Forces of the fluid are those of a step.
            for found in &series.column(name)[1..] {
                assert!((found - wanted).abs() < 0.01, "{weight}: {name} {found}");
            }
        }
        series.column("coordination").to_vec()
    };
    let [dry, buoyant] = ["dry", "buoyant"].map(start);
    assert_ne!(dry, buoyant);
}

#[test]
fn a_dry_weight_needs_a_fluid_gravity_and_rest() {
    let field = Field::new();
    let cases = [
        ("cloud", "", "`[fluid]` is missing"),
        ("perm", "", "`grains.gravity` is missing"),
        (
            "cloud",
            "--set fluid.viscosity=1 --set wall.top.pressure=0 --set start.settle=1",
            "`settle` below 1 is missing",
        ),
    ];
    for (input, more, told) in cases {
        let refused = field
            .check(input, &format!("{more} --set start.weight=dry"))
            .ended(2);
        refused.says(&format!("── start.weight\n | {told}"));
    }
}

/// In a pipe of four grains walls that rub bear a part of the weight (Janssen), and smooth ones do not.
#[test]
fn walls_have_a_law_of_their_own_while_grains_are_prepared() {
    let field = Field::new();
    let floor = |more: &str| {
        let pipe = "--set box.high=[0.04,0.04,0.6] --set run.end=1e-4";
        field.ran("cloud", &format!("{pipe} {more}"));
        field.series().column("floor")[0]
    };
    let rough = floor("");
    assert!(rough < 0.9, "rough walls leave {rough} to the floor");
    let law = "start.wall_contact.linear-elastic";
    let smooth = floor(&format!(
        "--set {law}.modulus=1e6 --set {law}.stiffness_ratio=0 --set {law}.friction=0"
    ));
    close(smooth, 1.0, 0.01, "share that smooth walls leave");
}

#[test]
fn stresses_strains_and_sliding_of_a_squeezed_packing_fit_its_walls() {
    let field = Field::new();
    let series = field.ran("squeezed", "");
    let [
        strain,
        volume,
        mean,
        deviator,
        k0,
        local,
        sliding,
        unbalanced,
    ] = [
        "strain",
        "volume",
        "mean",
        "deviator",
        "k0",
        "local",
        "sliding",
        "unbalanced_force",
    ]
    .map(|name| series.column(name).to_vec());
    let last = strain.len() - 1;
    assert_eq!(local[0], 0.0);
    // The size of a mean strain is at most the mean of the sizes.
    assert!(local[last] > 0.9 * strain[last], "{local:?}");
    let worst = unbalanced.iter().copied().fold(0.0, f64::max);
    for row in 0..=last {
        // ¾ ε̇ Δt ε, of the second order in a step.
        assert!(volume[row].abs() < 1e-6, "volume: {}", volume[row]);
        // σ_x = p − q/3, σ_z = p + 2 q/3 at the walls; they differ by what is out of balance.
        let (p, q) = (mean[row], deviator[row]);
        let walls = (p - q / 3.0) / (p + 2.0 * q / 3.0);
        assert!((k0[row] - walls).abs() < worst, "{} for {walls}", k0[row]);
    }
    assert!(k0[last] < 0.9 && sliding[last] > sliding[0]);
    // Without friction every contact is at its limit, with very much none is.
    for (friction, share) in [(0.0, 1.0), (1e9, 0.0)] {
        let key = "grains.contact.linear-elastic.friction";
        let series = field.ran(
            "squeezed",
            &format!("--set {key}={friction} --set run.end=1e-3"),
        );
        assert!(series.column("sliding").iter().all(|s| *s == share));
    }
}

//! Bodies much lighter than the water.

use sph_tests::{Series, close, near};

use crate::Field;

const G: f64 = 9.81;

/// Acceleration upwards: that of the parabola that fits the way.
fn acceleration(series: &Series) -> f64 {
    let rows = series.column("time").iter().zip(series.column("A.y"));
    let rows: Vec<_> = rows.collect();
    let middle = rows.iter().map(|(t, _)| **t).sum::<f64>() / rows.len() as f64;
    let sum = |power: i32, of_way: bool| -> f64 {
        let part =
            |(t, y): &(&f64, &f64)| (**t - middle).powi(power) * if of_way { **y } else { 1.0 };
        rows.iter().map(part).sum()
    };
    // Cramer's rule for y = a + b t + c t², with Σ t = 0.
    let [n, s2, s3, s4] = [0, 2, 3, 4].map(|k| sum(k, false));
    let [y0, y1, y2] = [0, 1, 2].map(|k| sum(k, true));
    let all = n * (s2 * s4 - s3 * s3) - s2 * s2 * s2;
    2.0 * (n * (s2 * y2 - y1 * s3) - y0 * s2 * s2) / all
}

fn run(input: &str, more: &str) -> Series {
    Field::new().ran(input, more)
}

/// Cylinders of a radius of 4 spacings in the middle of a tank of 8 radii: a = (ρ_w − ρ_b) V g/(ρ_b V + m_a), m_a =
/// 1.108 ρ_w π R² by potential theory in this tank with a free surface (1 without walls). Particles are relaxed: cut
/// from a lattice they swing about the round wall for 0.05 s. Half a spacing is an eighth of R, and the bound a tenth.
#[test]
fn a_light_cylinder_starts_as_its_added_mass_says() {
    for more in [
        "",
        "--set implicit-viscosity.backward-euler={}",
        "--set pressure.implicit={} --set surface.cone-test={}",
    ] {
        for density in [20.0, 200.0] {
            let set = format!("--threads 1 --set wall.a.mover.rigid-body.density={density} {more}");
            let series = run("light-cylinder", &set);
            let exact = (1000.0 - density) * G / (density + 1108.0);
            let found = acceleration(&series);
            near(found, exact, 0.1, &format!("{density} kg/m³ {more}, m/s²"));
        }
    }
}

/// A box 0.4 m wide and 0.3 m high at the surface of a tank 1.6 m wide, 0.02 m deep: it comes to rest ρ_b/ρ_w 0.3 m
/// deep, by half a spacing.
#[test]
fn a_light_box_floats_and_does_not_fly() {
    for density in [20.0, 50.0, 100.0] {
        let set = format!("--threads 1 --set wall.a.mover.rigid-body.density={density}");
        let series = run("light-5", &set);
        let most = series.largest("A.y");
        // It comes out with no more than its net buoyancy gives it, 27 N over 14 mm: 16 mm at 20 kg/m³, and a
        // spacing is not seen.
        assert!(most < 0.0105 + 0.016 + 0.05, "{density} kg/m³: {most} m up");
        let found = series.mean("A.y", 1.0);
        // The level falls by a quarter of what the box comes out.
        let exact = (0.02 - 0.3e-3 * density) * (1.0 - 0.25);
        close(found, exact, 0.025, &format!("{density} kg/m³, m"));
    }
}

/// With implicit pressure 50 kg/m³ left the water with 7 m/s. It rises as with explicit steps, however fast sound is.
#[test]
fn light_boxes_rise_alike_with_implicit_pressure() {
    let end = |more: &str| run("light-box", &format!("--threads 1 {more}")).last("A.y");
    for density in [20.0, 50.0] {
        let body = format!("--set wall.a.mover.rigid-body.density={density}");
        let explicit = end(&body);
        // It moves half of its height, as what is pushed up by its buoyancy does.
        assert!(explicit > 0.15 && explicit < 0.25, "{explicit} m");
        for sound in [30.0, 300.0] {
            let solved = "--set pressure.implicit={} --set surface.cone-test={}";
            let found = end(&format!(
                "{body} {solved} --set phase.w.speed_of_sound={sound}"
            ));
            near(found, explicit, 0.05, &format!("{body} {sound} m/s, m"));
        }
    }
}

#[test]
fn bodies_below_a_fiftieth_of_the_fluid_are_refused_at_their_line() {
    let field = Field::new();
    let refused = field.check("light-5", "").ended(2);
    refused.says("density = 5.0 | a fiftieth");
    field
        .check("light-5", "--set wall.a.mover.rigid-body.density=20")
        .ended(0);
}

/// Syrup of 100 Pa s at a no-slip box of 20 kg/m³: as with explicit friction of a step so short that it is no matter.
#[test]
fn light_boxes_rise_alike_with_implicit_viscosity() {
    let end = |more: &str| {
        let body = "--threads 1 --set wall.a.mover.rigid-body.density=20 --set run.end=0.15";
        let more = format!("{body} --set phase.w.rheology.newtonian.viscosity=100.0 {more}");
        run("light-box", &more).last("A.y")
    };
    let explicit = end("--set run.safety=0.25");
    let implicit = end("--set implicit-viscosity.backward-euler={}");
    let off = implicit / explicit - 1.0;
    assert!(off.abs() < 0.05, "{implicit} and {explicit} m");
}

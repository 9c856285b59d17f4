//! Free surfaces with nothing that takes energy: closed forms.

use sph_tests::{Says, below};
use std::f64::consts::PI;

use crate::shipped::{finished, whole};

/// What is required of the drop at 40 spacings to the radius: its semi-axes to 1 % of their range, and 1 % of its energy.
#[test]
fn a_drop_is_drawn_out_to_the_ellipse_of_monaghan() {
    let run = finished("elliptical-drop", &[]);
    run.error("semi-axis-x", 0.01, 0.0095);
    run.error("semi-axis-y", 0.01, 0.0044);
    let lost = 1.0 - run.last("kinetic_energy") / run.column("kinetic_energy")[0];
    below(lost, 0.01, "energy lost, measured -0.0005");
}

/// The 3 % that are asked of the pressures and of the momentum, ρU²H/2 = 100 N/m, already with ten spacings and a half to the
/// half of the jet; the half belongs to the plane of symmetry.
#[test]
fn a_steady_jet_has_the_pressures_of_its_free_streamlines() {
    let coarse = ["numerics.spacing=0.0095238095 body.jet.box=[[0,0],[0.1,2.0]]"];
    let run = finished("impact-jet-2d", &coarse);
    run.error("force", 0.03, 0.0271);
    run.error("middle", 0.03, 0.0120);
    run.error("quarter", 0.03, 0.0097);
    run.error("half", 0.03, 0.0179);
}

/// A floor takes 48 % of the energy of a patch that lands on it; the bound is the 3 % that are asked of the closed forms.
#[test]
fn a_patch_of_fluid_keeps_what_its_impulse_leaves() {
    whole("patch-of-fluid").error("energy", 0.03, 0.0263);
}

/// Π = ρUW Σ aₙ cos(nπx/W) sinh(nπ(H − y)/W)/cosh(nπH/W), aₙ = ±4/(nπ)², n odd: the impulse of a floor on a patch W wide and H
/// high, 0 on its free sides. It takes ½U ∫Π dx, and leaves the floor u = −∂Π/∂x/ρ.
#[test]
fn the_energy_of_a_patch_is_that_of_its_impulse() {
    let (width, height, spacing) = (0.975, 0.5125, 0.025);
    let (mut impulse, mut slip2) = (0.0, 0.0);
    for n in (1..100_001).step_by(2).map(f64::from) {
        let reach = (n * PI * height / width).tanh();
        impulse += 8.0 / (n * PI).powi(3) * reach * 1000.0 * width * width;
        slip2 += 8.0 / (n * PI).powi(2) * reach * reach * width;
    }
    let left = 500.0 * width * height - 0.5 * impulse;
    let of_particles = left - 500.0 * 0.5 * spacing * slip2;
    let text = include_str!("../../../scenes/patch-of-fluid.toml");
    text.says(&format!("# {left:.2} J | value = {of_particles:.2}"));
}

/// x = (2H/π)(arctan ν + artanh ν), p = ½ρU²(1 − ν²): the references of the scene, and the momentum that the wall takes.
#[test]
fn pressures_of_a_jet_are_those_of_its_free_streamlines() {
    let (thickness, speed2) = (0.2, 1000.0);
    let place = |nu: f64| 2.0 * thickness / PI * (nu.atan() + nu.atanh());
    let at = |x: f64| {
        let (mut low, mut high) = (0.0, 1.0 - 1e-15);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if place(middle) < x {
                low = middle
            } else {
                high = middle
            }
        }
        0.5 * speed2 * (1.0 - low * low)
    };
    let text = include_str!("../../../scenes/impact-jet-2d.toml");
    for (x, name) in [(0.0, "middle"), (0.05, "quarter"), (0.1, "half")] {
        let value = format!(
            "[reference.{name}]\nprobe = \"{name}\"\nvalue = {:.2}",
            at(x)
        );
        let value = value.trim_end_matches(".00");
        assert!(text.contains(value), "{value}");
    }
    // ∫½ρU²(1 − ν²) dx over the half, with dx = (4H/π) dν/(1 − ν⁴): Simpson's rule in ν.
    let steps = 1000;
    let force = |nu: f64| 0.5 * speed2 * 4.0 * thickness / PI / (1.0 + nu * nu);
    let weight = |k: i32| {
        if k == 0 || k == steps {
            1.0
        } else {
            f64::from(2 + 2 * (k % 2))
        }
    };
    let sum: f64 = (0..=steps)
        .map(|k| weight(k) * force(f64::from(k) / f64::from(steps)))
        .sum();
    let half = sum / (3.0 * f64::from(steps));
    assert!((half - 0.5 * speed2 * thickness).abs() < 1e-9, "{half} N/m");
}

/// The reference of `wedge-of-water` over τ = Ut/x: the force is twice ∫p dx over half of the wall, p the tabulated pressure and
/// x = 1/τ with Ut = 1, to what trapezia leave; and the means that the scene names are those of the table.
#[test]
fn the_force_of_a_wedge_of_water_is_that_of_its_pressures() {
    let text = include_str!("../../../scenes/data/wedge_of_water.csv");
    let rows = text
        .lines()
        .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
    let row = |l: &str| {
        l.split(',')
            .map(|x| x.parse().expect("a number"))
            .collect::<Vec<f64>>()
    };
    let rows: Vec<Vec<f64>> = rows.map(row).collect();
    let inmost = rows.last().expect("rows");
    let mut half = inmost[1] / inmost[0];
    let (mut near, mut far) = (0.0, 0.0);
    for pair in rows.windows(2) {
        let (a, b) = (&pair[0], &pair[1]);
        half += 0.5 * (a[1] + b[1]) * (1.0 / a[0] - 1.0 / b[0]);
        let part = 0.5 * (a[1] + b[1]) * (b[0] - a[0]);
        if a[0] >= 0.5 && b[0] <= 1.0 {
            far += 2000.0 * part;
        } else if a[0] >= 1.0 && b[0] <= 2.0 {
            near += 1000.0 * part;
        }
    }
    let force = inmost[3] / inmost[0];
    sph_tests::near(2.0 * half, force, 2e-3, "force on both halves");
    let scene = include_str!("../../../scenes/wedge-of-water.toml");
    for value in [near, far] {
        let line = format!("value = {value:.1}");
        assert!(scene.contains(&line), "{line}");
    }
}

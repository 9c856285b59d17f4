//! Fields that outputs ask for by name, against exact flows.

use sph_tests::{DAM_BREAK, Says, bench, close};

use crate::hands::reals;

/// A function of the plane.
type Plane = fn(f64, f64) -> f64;

/// Vortices in a periodic box, with the fields that are written.
fn vortices(fields: &str) -> String {
    format!(
        "title = \"Decaying vortices\"\ndimension = 2\n[run]\nend = 1e-3\n[numerics]\nspacing = 0.02\n\
         smoothing_ratio = 2.0\nperiodic = {{ x = [0, 1], y = [0, 1] }}\n[phase.water]\ndensity = 1.0\n\
         velocity_scale = 1.0\n[phase.water.rheology.newtonian]\nviscosity = 0.01\n[body.box]\nphase = \"water\"\n\
         box = [[0, 0], [1, 1]]\n[body.box.initial.taylor-green]\nspeed = 1.0\nlength = 1.0\n\
         kinematic_viscosity = 0.01\ndensity = 1.0\n[output]\nevery = 1e-3\nfields = {fields}\n"
    )
}

/// Largest difference to an exact field over its largest value, at the start.
fn error(piece: &sph_io::Piece<'_>, name: &str, exact: impl Fn([f64; 2]) -> f64) -> f64 {
    let values = reals(piece, name);
    let exact: Vec<f64> = piece.points.iter().map(|x| exact([x[0], x[1]])).collect();
    let scale = exact.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    let apart = values.iter().zip(&exact).map(|(v, e)| (v - e).abs());
    apart.fold(0.0, f64::max) / scale
}

/// The gradient of a kernel sum has the kernel's Fourier factor, 1 − |k|²⟨r²⟩/4 with ⟨r²⟩ = 5h²/9 of the Wendland C2
/// kernel. The vortices are waves with |k|² = 2 (2π)²: at h = 0.04 m vorticity and stress are 1.75 % too small, and Q,
/// which is quadratic, 3.5 %. The next term of the series is a hundredth of that.
#[test]
fn vorticity_and_shear_stress_of_vortices_are_1_75_percent_small_and_q_3_5_as_the_kernel_says() {
    let bench = bench!(&vortices(
        "[\"velocity\", \"velocity_gradient\", \"vorticity\", \"q_criterion\", \"speed\", \"shear_stress\", \"strain_rate\"]",
    ));
    bench.done("run scene.toml -q --threads 1 --out a");
    let (piece, _) = sph_io::read_vtu(bench.path("a/fields/fluid_000000.vtu")).expect("a frame");
    let velocity = reals(&piece, "velocity");
    let speed = reals(&piece, "speed");
    for (u, speed) in velocity.chunks(3).zip(&speed) {
        assert!((u[0].hypot(u[1]) - speed).abs() <= 1e-15);
    }
    // Of the velocity itself it is told which of the forms of the vortices the scene has.
    let k = std::f64::consts::TAU;
    let [x, y] = [piece.points[7][0], piece.points[7][1]];
    let (u, v) = (velocity[21], velocity[22]);
    let forms = [
        [
            (k * x).sin() * (k * y).cos(),
            -(k * x).cos() * (k * y).sin(),
        ],
        [
            -(k * x).cos() * (k * y).sin(),
            (k * x).sin() * (k * y).cos(),
        ],
    ];
    let form = forms
        .iter()
        .position(|f| (f[0] - u).abs() + (f[1] - v).abs() < 1e-9);
    let form = form.unwrap_or_else(|| panic!("({u}, {v}) at ({x}, {y})"));
    // Both have |∇u| entries of the same kind; ω and Q follow by hand.
    let (vorticity, q, rate): (Plane, Plane, Plane) = match form {
        0 => (
            |x, y| 2.0 * x.sin() * y.sin(),
            |x, y| x.sin().powi(2) * y.sin().powi(2) - x.cos().powi(2) * y.cos().powi(2),
            |x, y| 2.0 * (x.cos() * y.cos()).abs(),
        ),
        _ => (
            |x, y| 2.0 * x.cos() * y.cos(),
            |x, y| x.cos().powi(2) * y.cos().powi(2) - x.sin().powi(2) * y.sin().powi(2),
            |x, y| 2.0 * (x.sin() * y.sin()).abs(),
        ),
    };
    let of_vorticity = error(&piece, "vorticity", |[x, y]| k * vorticity(k * x, k * y));
    let of_q = error(&piece, "q_criterion", |[x, y]| k * k * q(k * x, k * y));
    let of_stress = error(&piece, "shear_stress", |[x, y]| {
        0.01 * k * rate(k * x, k * y)
    });
    println!("vorticity {of_vorticity:.4}, Q {of_q:.4}, shear stress {of_stress:.4}");
    let (kh, ratio) = (k * 0.04, 5.0 / 9.0);
    let small = 2.0 * kh * kh * ratio / 4.0;
    close(of_vorticity, small, 0.02 * small, "vorticity");
    close(of_stress, small, 0.02 * small, "shear stress");
    close(of_q, small * (2.0 - small), 0.04 * small, "Q");
}

#[test]
fn a_scene_without_the_column_has_the_same_bits() {
    let bench = bench!(DAM_BREAK);
    let plain = bench.done("explain scene.toml").out;
    for name in [
        "vorticity",
        "velocity_gradient",
        "strain_rate",
        "speed",
        "shear_stress",
    ] {
        assert!(!plain.contains(name), "{name}");
    }
    let asked = "--set output.fields=['vorticity','shear_stress']";
    let with = bench.done(&format!("explain scene.toml {asked}")).out;
    with.says("vorticity | velocity_gradient | strain_rate | shear_stress");
    assert!(!with.contains("q_criterion"), "{with}");
    let short = "-q --threads 1 --set run.end=0.03";
    bench.done(&format!("run scene.toml {short} --out plain"));
    bench.done(&format!("run scene.toml {short} {asked} --out asked"));
    let told = bench.call("compare plain asked --json").out;
    let told: serde_json::Value = serde_json::from_str(&told).expect("JSON");
    for column in told["columns"].as_array().expect("columns") {
        assert_eq!(column["same"], true, "{column}");
    }
    let refused = bench.call("check scene.toml --set output.fields=['vortcity']");
    refused.says("did you mean `vorticity`?");
}
